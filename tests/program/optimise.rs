//! `cutlab optimise`, as a user has it.

use crate::bench::Bench;
use serde_json::Value;
use std::time::Duration;

const SMALL: [&str; 6] = ["--maximise", "iso", "--evaluations", "25", "--tilt", "0,10"];

/// A folder with a design to make better.
fn folder() -> Bench {
    let bench = Bench::new();
    bench.good(&["generate", "classic", "-q", "-o", "c.asc"]);
    bench
}

fn optimise<'a>(more: &[&'a str]) -> Vec<&'a str> {
    ["optimise", "c.asc", "-q"].iter().chain(&SMALL).chain(more).copied().collect()
}

#[test]
fn the_best_design_is_better_and_scores_as_it_says() {
    let bench = folder();
    let (out, said) = bench.ends(0, &optimise(&["--json", "-o", "best.asc"]));
    let found: Value = serde_json::from_str(&out).unwrap_or_else(|e| panic!("{e}: {said}"));
    let gain = &found["finalists"][0]["objectives"]["iso@0,10"];
    assert!(gain["gain"]["value"].as_f64().expect("a gain") > 1.0 && gain["significant"] == true, "{gain}");
    let score = |tilt: &str| {
        let arguments =
            ["score", "best.asc", "--metrics", "iso", "--exact", "--tilt", tilt, "--json", "-q", "-o", "-"];
        let (out, said) = bench.ends(0, &arguments);
        let rows: Value = serde_json::from_str(&out).unwrap_or_else(|e| panic!("{e}: {said}"));
        rows[0]["iso"].as_f64().unwrap_or_else(|| panic!("{rows}"))
    };
    let (value, mean) = (gain["value"]["value"].as_f64().expect("a score"), 0.5 * (score("0") + score("10")));
    assert!((value - mean).abs() < 1e-6, "{value} {mean}");
}

#[test]
fn the_same_command_gives_the_same_files_on_any_number_of_threads_and_after_a_kill() {
    let bench = folder();
    bench.good(&optimise(&["-o", "one/b.asc", "--threads", "1", "--keep-best", "3", "--front", "one.csv"]));
    bench.good(&optimise(&["-o", "two/b.asc", "--threads", "2", "--keep-best", "3", "--front", "two.csv"]));
    for kill in [40, 80, 160] {
        let arguments = optimise(&["-o", "three/b.asc", "--keep-best", "3", "--front", "three.csv"]);
        bench.kill_after(Duration::from_millis(kill), &arguments);
    }
    bench.good(&optimise(&["-o", "three/b.asc", "--keep-best", "3", "--front", "three.csv"]));
    for other in ["two", "three"] {
        for file in ["b.asc", "b-2.asc", "b-3.asc"] {
            assert_eq!(
                bench.read(&format!("one/{file}")),
                bench.read(&format!("{other}/{file}")),
                "{other} {file}"
            );
        }
        assert_eq!(bench.read("one.csv"), bench.read(&format!("{other}.csv")));
    }
    assert!(!bench.exists("three/.b.asc.progress"));
    // the same command replaces its own files, another does not
    bench.good(&optimise(&["-o", "one/b.asc", "--keep-best", "3", "--front", "one.csv"]));
    let (_, said) = bench.ends(3, &optimise(&["-o", "one/b.asc", "--seed", "2"]));
    assert!(said.contains("--force"), "{said}");
}

/// With a tolerance both gains are said, and what was searched is named by it.
#[test]
fn a_design_is_made_better_for_stones_cut_with_errors() {
    let bench = folder();
    let tolerant = ["--tolerance", "0.2", "--worst"];
    let (out, _) = bench.ends(0, &optimise(&[&tolerant[..], &["--front", "f.csv"]].concat()));
    let name = "iso@0,10 (worst) worst within ± 0.2°";
    assert!(out.contains(name) && out.lines().any(|l| l.trim().starts_with("iso@0,10 (worst) ")), "{out}");
    let head = String::from_utf8(bench.read("f.csv")).expect("text");
    assert!(head.lines().next().is_some_and(|line| line.ends_with(&format!("\"{name}\""))), "{head}");
    let (out, _) = bench.ends(0, &optimise(&[&tolerant[..], &["--json"]].concat()));
    let found: Value = serde_json::from_str(&out).expect("JSON");
    let of = |key: &str| found["finalists"][0][key]["iso@0,10 (worst)"]["value"]["value"].as_f64();
    let (within, drawn) = (of("within_tolerance").expect("a score"), of("objectives").expect("a score"));
    assert!(within < drawn, "the worst of eight stones is below the stone as drawn: {found}");
    let (_, said) = bench.ends(2, &optimise(&["--tolerance", "-1"]));
    assert!(said.contains("number of degrees"), "{said}");
}

#[test]
fn several_objectives_give_a_front() {
    let bench = folder();
    let front =
        ["optimise", "c.asc", "-q", "--maximise", "iso", "--maximise", "weight_ratio", "--evaluations", "30"];
    bench.good(&[&front[..], &["-o", "front"]].concat());
    let table = bench.read("front/front.csv");
    let mut rows = csv::Reader::from_reader(&table[..]);
    assert_eq!(
        rows.headers().expect("a head").iter().collect::<Vec<_>>(),
        ["candidate", "crown.scale", "pavilion.scale", "iso", "weight_ratio"]
    );
    let values: Vec<(f64, f64)> = rows
        .records()
        .map(|row| row.expect("a row"))
        .map(|row| (row[3].parse().expect("a number"), row[4].parse().expect("a number")))
        .collect();
    assert!(values.len() > 2, "{values:?}");
    assert!(values.windows(2).all(|w| w[0].0 > w[1].0 && w[0].1 < w[1].1), "no front: {values:?}");
    assert!(bench.exists("front/best-2.asc"));
}

/// The page is one of the files: the same on any number of threads and after kills, replaced by its own command
/// alone.
#[test]
fn a_folder_has_a_page() {
    let bench = folder();
    let command = |output: &str| [&optimise(&["--width", "64"])[..], &["-o", output]].concat().join(" ");
    let run = |output: &str, threads: &str| {
        let line = command(output);
        let words: Vec<&str> = line.split(' ').chain(["--threads", threads]).collect();
        bench.good(&words);
    };
    run("one", "1");
    run("two", "2");
    let line = command("three");
    let words: Vec<&str> = line.split(' ').collect();
    let mut kills = 0;
    for wait in [300, 600, 900, 1200, 1500] {
        kills += usize::from(bench.kill_after(Duration::from_millis(wait), &words));
        if let Some(page) = bench.exists("three/index.html").then(|| bench.read("three/index.html")) {
            assert_eq!(page, bench.read("one/index.html"), "a page is whole or not there");
        }
    }
    println!("{kills} of 5 kills came in time");
    run("three", "2");
    let files = bench.files();
    let of = |folder: &str| -> Vec<(String, &Vec<u8>)> {
        let inside = files.iter().filter_map(|(path, bytes)| Some((path.strip_prefix(folder).ok()?, bytes)));
        inside.map(|(path, bytes)| (path.display().to_string(), bytes)).collect()
    };
    let names = |folder: &str| of(folder).into_iter().map(|(name, _)| name).collect::<Vec<_>>();
    assert_eq!(names("one"), ["best.asc", "best.asc.meta.json", "front.csv", "index.html"]);
    for other in ["two", "three"] {
        assert_eq!(names("one"), names(other));
        for ((name, bytes), (_, others)) in of("one").iter().zip(of(other)) {
            // the files are named with their folder
            assert!(name.ends_with(".meta.json") || **bytes == *others, "{other}/{name}");
        }
    }
    let (out, _) = bench.ends(0, &[&words[..], &["--json"]].concat());
    let said: Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!(said["files"], serde_json::json!(["three/front.csv", "three/best.asc", "three/index.html"]));
    // the same command replaces its page; another search or size of pictures does not
    for other in [&["--seed", "2"][..], &["--width", "80"]] {
        let words = [&optimise(&["-o", "one"])[..], other].concat();
        let (_, said) = bench.ends(3, &words);
        assert!(said.contains("--force"), "{said}");
    }
    let (_, said) = bench.ends(2, &optimise(&["-o", "b.asc", "--width", "80"]));
    assert!(said.contains("-o FOLDER"), "{said}");
}

#[test]
fn what_cannot_be_is_one_line_and_writes_nothing() {
    let bench = folder();
    for (arguments, output, said) in [
        (&["--maximise", "isso"][..], "b.asc", "did you mean 'iso'"),
        (&[], "b.asc", "nothing to make better"),
        (&["--maximise", "iso", "--vary", "Q1.angle"], "b.asc", "no tier is called 'Q1'"),
        (&["--maximise", "iso", "--vary", "P1.angle=42:41"], "b.asc", "is no range"),
        (&["--maximise", "iso", "--at-least", "weight_ratio=2"], "b.asc", "breaks a bound"),
        (&["--maximise", "fire_streak"], "b.asc", "no dispersion is known"),
        (&["--maximise", "iso", "--method", "nsga-ii"], "b.asc", "nsga-ii is not a method for 1 objectives"),
        (&["--maximise", "iso"], "front.xyz", "xyz"),
    ] {
        let all = [&["optimise", "c.asc", "--evaluations", "5", "-o", output], arguments].concat();
        let (_, heard) = bench.ends(2, &all);
        assert!(heard.contains(said) && heard.trim().lines().count() == 1, "{arguments:?}: {heard}");
        assert_eq!(bench.names(), ["c.asc"], "{arguments:?}");
    }
}

#[test]
fn what_a_material_s_file_holds_belongs_to_the_command() {
    let bench = folder();
    let write = |index: f64| {
        let text = format!("name = \"mine\"\n[index]\ncauchy = [{index}, 0.0087, 1e-4]\n");
        std::fs::write(bench.path("mine.toml"), text).expect("can be written");
    };
    let command = optimise(&["--material", "mine.toml", "-o", "b.asc"]);
    write(1.6);
    bench.good(&command);
    bench.good(&command);
    write(1.7);
    let (_, said) = bench.ends(3, &command);
    assert!(said.contains("--force"), "{said}");
}
