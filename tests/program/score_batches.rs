//! `cutlab score` over many stones: resumed after a kill, shared among machines, whole or not there.

use crate::bench::{Bench, text};
use std::time::{Duration, Instant};

/// Designs in folders, one of them bad, and notes beside them.
fn designs(bench: &Bench) {
    for (name, crown) in [("a.toml", "30"), ("deep/b.asc", "33"), ("c.gem", "36")] {
        let file = format!("in/{name}");
        bench.good(&["generate", "--crown-angle", crown, "-o", &file, "-q"]);
    }
    std::fs::write(bench.path("in/bad.asc"), "GemCad 5.0\ng 96 0.0\n").expect("writes");
    std::fs::write(bench.path("in/notes.md"), "# notes").expect("writes");
    // a file in the making, or what another system keeps beside a file
    std::fs::copy(bench.path("in/deep/b.asc"), bench.path("in/.b.asc")).expect("copies");
}

const SCORES: [&str; 2] = ["--metrics", "wlr,leakage"];

fn score<'a>(stones: &[&'a str], options: &[&'a str]) -> Vec<&'a str> {
    [&["score"], stones, &SCORES, options].concat()
}

#[test]
fn folders_and_patterns_are_taken_in_order_and_a_bad_stone_keeps_its_row() {
    let bench = Bench::new();
    designs(&bench);
    let (table, said) = bench.ends(1, &score(&["in"], &["--error", "0.01"]));
    let firsts: Vec<&str> = table.lines().map(|l| l.split(',').next().expect("a cell")).collect();
    assert_eq!(
        firsts,
        ["stone", "in/a.toml", "in/bad.asc", "in/c.gem", "in/deep/b.asc"],
        "no notes, nothing hidden"
    );
    assert!(said.contains("in/bad.asc") && said.lines().count() == 1, "{said}");
    let found =
        cutlab::expand_stones([bench.path("in")], cutlab::Limits::default()).expect("a folder of stones");
    let expected: Vec<std::path::PathBuf> = firsts[1..].iter().map(|name| bench.path(name)).collect();
    assert_eq!(found.iter().map(std::path::PathBuf::from).collect::<Vec<_>>(), expected);
    let bad: Vec<&str> = table.lines().nth(2).expect("its row").split(',').collect();
    assert!(bad[3].is_empty() && !bad[7].is_empty(), "{bad:?}");
    let (matched, _) = bench.ends(0, &score(&["in/*.[tg]*"], &["--error", "0.01"]));
    assert_eq!(matched.lines().count(), 3, "{matched}");
    assert!(bench.ends(2, &score(&["in/*.xyz"], &[])).1.contains("in/*.xyz"));
    assert!(bench.ends(2, &score(&["in/bad.asc"], &[])).1.contains("in/bad.asc"), "no input was good");
}

/// The stones of an outline alone, with what cannot be read; said, kept in the table's record, refused if none is.
#[test]
fn stones_are_chosen_by_their_outline() {
    let bench = Bench::new();
    designs(&bench);
    for cut in ["oval", "pear", "princess"] {
        bench.good(&["generate", cut, "-q", "-o", &format!("in/{cut}.asc")]);
    }
    let stones = |table: &str| -> Vec<String> {
        table.lines().skip(1).map(|l| l.split(',').next().expect("a cell").to_owned()).collect()
    };
    let ask = ["score", "in", "--metrics", "spread", "--outline"];
    let (table, said) = bench.ends(1, &[&ask[..], &["oval,pear"]].concat());
    assert_eq!(stones(&table), ["in/bad.asc", "in/oval.asc", "in/pear.asc"]);
    assert!(said.contains("of 7 stones 3 are oval or pear in outline"), "{said}");
    let best = ["Round", "--sort", "spread", "--top", "1", "-q", "-o", "round.csv"];
    bench.ends(2, &[&ask[..], &best].concat());
    assert_eq!(stones(&text(&bench.read("round.csv"))).len(), 1);
    assert!(text(&bench.read("round.csv.meta.json")).contains("--outline round"));
    let (_, said) = bench.ends(2, &["score", "tolkowsky", "--metrics", "spread", "--outline", "pear"]);
    assert!(said.contains("none of 1 stones is pear"), "{said}");
    let (_, said) = bench.ends(2, &["score", "tolkowsky", "--outline", "ovel"]);
    assert!(said.contains("no outline is called 'ovel': round, oval"), "{said}");
}

#[test]
fn every_form_has_the_same_numbers_and_a_sidecar_says_what_they_are() {
    let bench = Bench::new();
    for file in ["s.csv", "s.jsonl", "s.json"] {
        bench.good(&score(&["tolkowsky", "octahedron"], &["--error", "0.01", "-o", file]));
    }
    let csv = text(&bench.read("s.csv"));
    let wlr = csv.lines().nth(1).expect("a row").split(',').nth(3).expect("a cell").parse::<f64>();
    let lines: Vec<serde_json::Value> =
        text(&bench.read("s.jsonl")).lines().map(|l| serde_json::from_str(l).expect("JSON")).collect();
    let array: Vec<serde_json::Value> = serde_json::from_slice(&bench.read("s.json")).expect("JSON");
    assert_eq!(lines, array);
    assert_eq!((lines.len(), lines[0]["wlr"].as_f64()), (2, wlr.ok()));
    let meta: serde_json::Value = serde_json::from_slice(&bench.read("s.csv.meta.json")).expect("JSON");
    assert_eq!((&meta["version"], &meta["seed"]), (&env!("CARGO_PKG_VERSION").into(), &1.into()));
    assert!(meta["command"].as_str().is_some_and(|c| c.starts_with("cutlab score tolkowsky octahedron")));
    assert!(meta["samples"]["hemisphere"]["least"].as_u64().is_some_and(|n| n >= 1000), "{meta}");
    assert!(meta["metrics"][0]["definition"].as_str().is_some_and(|d| d.contains("dome")), "{meta}");
    assert!(bench.ends(2, &score(&["tolkowsky"], &["-o", "s.txt"])).1.contains(".csv"));
}

#[test]
fn tilts_are_rows() {
    let bench = Bench::new();
    let options = ["--tilt", "-10:10:10", "--tilt-axis", "90", "--error", "0.01"];
    let (table, _) = bench.ends(0, &score(&["tolkowsky", "octahedron"], &options));
    let rows: Vec<Vec<&str>> = table.lines().map(|l| l.split(',').collect()).collect();
    assert_eq!((rows.len(), rows[0][3]), (7, "tilt_deg"));
    let tilts: Vec<&str> = rows[1..].iter().map(|r| r[3]).collect();
    assert!(
        tilts.iter().take(3).zip(["-10", "0", "10"]).all(|(a, b)| a.parse::<f64>() == b.parse()),
        "{tilts:?}"
    );
    assert!(rows[1][4] != rows[2][4], "a tilted stone returns other light");
    let (plain, _) = bench.ends(0, &score(&["tolkowsky"], &["--error", "0.01"]));
    assert_eq!(plain.lines().nth(1).expect("a row").split(',').nth(3), Some(rows[2][4]), "0° is face-up");
}

/// Kills the command at moments spread over the time it takes until it has ended by itself, then
/// compares with an uninterrupted run. How many kills hit it at work.
fn survives(kills: u32, error: &str) -> u32 {
    let bench = Bench::new();
    designs(&bench);
    let stones = ["in", "tolkowsky", "octahedron", "cube", "asscher", "oval", "pear", "scan-dn"];
    let whole = score(&stones, &["--error", error, "-o", "whole.csv"]);
    let begun = Instant::now();
    bench.ends(1, &whole);
    let takes = begun.elapsed();
    let broken = score(&stones, &["--error", error, "-o", "broken.csv"]);
    let mut hits = 0;
    for k in 0..kills {
        // moments of an even sequence: early, late, and in between
        let share = (f64::from(k + 1) * 0.618_034).fract();
        if bench.kill_after(takes.mul_f64(share * 0.9), &broken) {
            hits += 1;
            assert!(!bench.exists("broken.csv") || bench.read("broken.csv") == bench.read("whole.csv"));
        } else {
            assert_eq!(bench.read("broken.csv"), bench.read("whole.csv"), "after kill {k}");
            std::fs::remove_file(bench.path("broken.csv")).expect("removes");
        }
    }
    bench.ends(1, &broken);
    assert_eq!(bench.read("broken.csv"), bench.read("whole.csv"));
    assert_eq!(bench.read("broken.csv.meta.json"), bench.read("whole.csv.meta.json"));
    let left = bench.names();
    assert_eq!(left, ["broken.csv", "broken.csv.meta.json", "in", "whole.csv", "whole.csv.meta.json"]);
    hits
}

#[test]
fn a_killed_batch_goes_on_where_it_was_and_ends_in_the_same_bytes() {
    let hits = survives(4, "0.001");
    assert!(hits > 0, "no kill came in time");
}

#[test]
fn progress_of_another_command_or_broken_is_set_aside_with_a_note() {
    let bench = Bench::new();
    let command = score(&["tolkowsky", "cube"], &["--error", "0.01", "-o", "s.csv"]);
    bench.good(&command);
    let whole = bench.read("s.csv");
    std::fs::remove_file(bench.path("s.csv")).expect("removes"); // a whole table is not made again
    std::fs::write(bench.path(".s.csv.progress"), "no such thing\n").expect("writes");
    assert!(bench.good(&command).contains("progress-set-aside"));
    assert_eq!(bench.read("s.csv"), whole);
    assert_eq!(bench.read(".s.csv.progress-set-aside"), b"no such thing\n");
    // an input that changed
    bench.good(&["generate", "-o", "x.toml", "-q"]);
    let long = score(&["cube", "x.toml", "tolkowsky"], &["--error", "0.00005", "-o", "t.csv"]);
    assert!(bench.kill_after(Duration::from_millis(1500), &long), "too quick to be killed");
    bench.good(&["generate", "--table", "60", "-o", "x.toml", "-q", "--force"]);
    let short = score(&["cube", "x.toml", "tolkowsky"], &["--error", "0.01", "-o", "t.csv"]);
    assert!(bench.good(&short).contains("another command or other inputs"));
}

#[test]
fn shards_merge_into_the_bytes_of_one_machine() {
    let bench = Bench::new();
    let stones = ["tolkowsky", "octahedron", "missing", "cube", "asscher"];
    for (whole, extension) in [("all.csv", "csv"), ("all.json", "json")] {
        bench.ends(1, &score(&stones, &["--error", "0.01", "-o", whole]));
        let parts: Vec<String> = (1..=3).map(|i| format!("p{i}.{extension}")).collect();
        for (i, part) in parts.iter().enumerate() {
            let shard = format!("{}/3", i + 1);
            let options = ["--error", "0.01", "--shard", &shard, "-o", part];
            // all that the third has is the missing stone
            bench.ends(if i == 2 { 2 } else { 0 }, &score(&stones, &options));
        }
        let of = |n: &[usize]| n.iter().map(|i| parts[*i].as_str()).collect::<Vec<_>>();
        let merge = |n: &[usize]| [&["merge"], &of(n)[..], &["-o", "m.csv"]].concat();
        let said = bench.ends(2, &merge(&[0, 2])).1;
        assert!(said.contains("shard 2/3 is missing: rows 2, 5 (2 of 5)"), "{said}");
        assert!(bench.ends(2, &merge(&[0, 0, 1, 2])).1.contains("both shard 1/3"));
        assert!(!bench.exists("m.csv"));
        let merged = format!("merged.{extension}");
        bench.ends(1, &["merge", &parts[2], &parts[0], &parts[1], "-o", &merged]);
        assert_eq!(bench.read(&merged), bench.read(whole));
        let sidecar = |table: &str| bench.read(&format!("{table}.meta.json"));
        assert_eq!(sidecar(&merged), sidecar(whole));
    }
    // a part of another command, and one that changed
    bench.good(&score(&stones, &["--error", "0.02", "--shard", "2/3", "-o", "other.csv"]));
    bench.ends(2, &score(&stones, &["--error", "0.01", "--shard", "3/3", "-o", "p3.csv"]));
    bench.good(&score(&stones, &["--error", "0.01", "--shard", "1/3", "-o", "p1.csv"]));
    let said = bench.ends(2, &["merge", "p1.csv", "other.csv", "p3.csv", "-o", "m.csv"]).1;
    assert!(said.contains("different tables"), "{said}");
    let mut bytes = bench.read("p1.csv");
    bytes[60] ^= 1;
    std::fs::write(bench.path("p1.csv"), bytes).expect("writes");
    assert!(bench.ends(2, &["merge", "p1.csv", "p3.csv", "-o", "m.csv"]).1.contains("checksum"));
}
