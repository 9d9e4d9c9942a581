//! `cutlab edit`, `cutlab retarget` and `cutlab show --meets`, as a user has them.

use crate::bench::Bench;
use serde_json::Value;

/// A folder with a design to change, under several formats.
fn folder() -> Bench {
    let bench = Bench::new();
    bench.good(&["generate", "classic", "-q", "-o", "c.asc", "-o", "c.gem", "-o", "c.stl", "-o", "c.toml"]);
    bench
}

fn json(bench: &Bench, arguments: &[&str]) -> Value {
    let (out, said) = bench.ends(0, &[arguments, &["--json", "-q"]].concat());
    serde_json::from_str(&out).unwrap_or_else(|e| panic!("{arguments:?}: {e}: {said}"))
}

/// A tier of `edit --json` by its place.
fn tier<'v>(report: &'v Value, place: &str) -> &'v Value {
    let tiers = report["tiers"].as_array().expect("tiers");
    tiers.iter().find(|t| t["place"] == place).unwrap_or_else(|| panic!("{place}: {report}"))
}

fn measure(report: &Value, name: &str, when: &str) -> f64 {
    let measures = report["measures"].as_array().expect("measures");
    let found = measures.iter().find(|m| m["name"] == name).unwrap_or_else(|| panic!("{name}: {report}"));
    found[when].as_f64().unwrap_or_else(|| panic!("{name} {when}: {report}"))
}

fn angle(tier: &Value, when: &str) -> f64 {
    tier[when]["angle_deg"].as_f64().expect("an angle")
}

/// What was written has the angles, the table and the girdle that were asked for, whatever the format.
#[test]
fn what_is_asked_for_is_what_is_written() {
    let bench = folder();
    for file in ["c.asc", "c.gem", "c.toml", "classic"] {
        let output = if file == "classic" { "newest.toml".to_owned() } else { file.replace("c.", "new.") };
        let set = ["edit", file, "--set", "P1.angle+=0.5", "--set", "table-=2", "--set", "girdle=3"];
        let report = json(&bench, &[&set[..], &["-o", &output]].concat());
        let p1 = tier(&report, "P1");
        assert!((angle(p1, "after") - angle(p1, "before") - 0.5).abs() < 1e-9, "{file}: {p1}");
        assert_eq!(report["file"], output);
        let shown = &json(&bench, &["show", &output])[0];
        let table = shown["table_percent"].as_f64().expect("a table");
        assert!((table - (measure(&report, "table", "before") - 2.0)).abs() < 1e-5, "{file}: {table}");
        let girdle = shown["girdle_percent"].as_f64().expect("a girdle");
        assert!((girdle - 3.0).abs() < 1e-5, "{file}: {girdle}");
        let tiers = shown["tiers"].as_array().expect("tiers");
        let of_p1 = tiers.iter().find(|t| t["place"] == "P1").expect("a first tier of the pavilion");
        let written = of_p1["angle_deg"].as_f64().expect("an angle").abs();
        assert!((written - angle(p1, "after")).abs() < 1e-6, "{file}: {written}");
    }
}

/// The file's own form: what is not changed is not touched.
#[test]
fn all_else_stays_in_the_file() {
    let bench = Bench::new();
    bench.good(&["generate", "classic", "-q", "-o", "c.asc"]);
    let with_words = String::from_utf8(bench.read("c.asc")).expect("text") + "H a header\nF a footnote\n";
    std::fs::write(bench.path("w.asc"), &with_words).expect("writes");
    bench.good(&["edit", "w.asc", "--set", "P1.angle+=0.0", "-q", "-o", "same.asc"]);
    assert_eq!(String::from_utf8(bench.read("same.asc")).as_ref(), Ok(&with_words));
    let set = ["--set", "T1.depth+=1", "--keep", "depths", "-q"];
    bench.good(&[&["edit", "w.asc", "-o", "new.asc"], &set[..]].concat());
    let new = String::from_utf8(bench.read("new.asc")).expect("text");
    assert!(new.contains("H a header\n") && new.contains("F a footnote\n"), "{new}");
    let same = new.lines().zip(with_words.lines()).filter(|(a, b)| a == b).count();
    assert!(same + 1 == with_words.lines().count() && new.lines().count() == same + 1, "{new}");
    // through standard input and output as from file to file
    let mut piped = bench.command(&[&["edit", "-", "-o", "-", "--to", "asc"], &set[..]].concat());
    piped.stdin(std::fs::File::open(bench.path("w.asc")).expect("opens"));
    assert_eq!(String::from_utf8(piped.output().expect("runs").stdout).as_ref(), Ok(&new));
}

/// A family whose parameters alone are set stays one.
#[test]
fn a_family_stays_a_family() {
    let bench = Bench::new();
    let set = ["--set", "crown-angle=33", "--set", "table+=1"];
    bench.good(&[&["edit", "tolkowsky", "-q", "-o", "t.toml"], &set[..]].concat());
    let text = String::from_utf8(bench.read("t.toml")).expect("text");
    assert!(text.contains("family = \"round-brilliant\"") && text.contains("crown-angle = 33"), "{text}");
    assert!(text.contains("table = 54"), "{text}");
    let by_tier =
        ["edit", "tolkowsky", "--set", "crown-angle=33", "--set", "P1.angle+=1", "-q", "-o", "p.toml"];
    bench.good(&by_tier);
    assert!(!String::from_utf8(bench.read("p.toml")).expect("text").contains("family"));
}

/// Scores are paired, and what is significant is said.
#[test]
fn scores_before_and_after_are_paired() {
    let bench = folder();
    let set = ["edit", "c.asc", "--set", "pavilion.scale=0.8", "--score", "windowing,wlr", "--error", "0.02"];
    let report = json(&bench, &set);
    let of = |m: usize| &report["scores"][m];
    assert_eq!((of(0)["metric"].as_str(), of(1)["metric"].as_str()), (Some("windowing"), Some("wlr")));
    // quartz at 80 % of the tangent lets light through
    assert!(
        of(0)["difference"]["value"].as_f64().expect("a difference") > 0.1 && of(0)["significant"] == true
    );
    let none = ["edit", "c.asc", "--set", "P1.angle+=0", "--score", "wlr", "--error", "0.02"];
    let report = json(&bench, &none);
    assert_eq!(report["scores"][0]["difference"]["value"], 0.0);
    assert_eq!(report["scores"][0]["significant"], false);
    let (text, said) = bench.ends(0, &none);
    assert!(text.contains("not significant") && text.contains("nothing changed"), "{text}");
    assert!(said.contains("nothing is written"), "{said}");
    assert_eq!(bench.names(), ["c.asc", "c.gem", "c.stl", "c.toml"]);
}

/// Bad input: one line, exit code 2, nothing written.
#[test]
fn bad_settings_are_refused_in_one_line() {
    let bench = folder();
    let there = bench.names();
    for (set, words) in [
        ("pavilion-mian.angle=41", &["no tier is called", "did you mean 'pavilion-main'"][..]),
        ("C9.angle=30", &["no tier is called 'C9'", "did you mean 'C3'"]),
        ("P1.angle=95", &["cannot have an angle of 95°"]),
        ("P1.angle=-95", &["cannot have an angle"]),
        ("G1.angle=80", &["girdle", "vertical"]),
        ("T1.angle=2", &["table", "set table=PERCENT"]),
        ("P1.tilt=4", &["angle, index and depth, not 'tilt'"]),
        ("P1.angle", &["sets nothing"]),
        ("table=150", &["table cannot be 150"]),
        ("culet=2", &["no culet"]),
        ("crown.scale=0", &["crown.scale cannot be 0"]),
        ("crown-angle=34", &["crown-angle cannot be set"]),
        ("P1.depth=4", &["P1.depth+=NUMBER"]),
    ] {
        let (out, said) = bench.ends(2, &["edit", "c.asc", "--set", set, "-o", "new.asc"]);
        assert!(out.is_empty() && said.lines().count() == 1, "{set}: {out}{said}");
        assert!(words.iter().all(|word| said.contains(word)), "{set}: {said}");
    }
    for arguments in [
        &["edit", "c.asc"][..],
        &["edit", "c.asc", "--set", "table=54", "--keep", "all"],
        &["edit", "c.asc", "--set", "table=54", "-o", "new.xyz"],
        &["edit", "c.asc", "--set", "table=54", "--score", "brilliance"],
        &["edit", "c.asc", "--set", "table=54", "-o", "c.asc"],
        &["retarget", "c.asc"],
        &["retarget", "c.asc", "--ri", "0.9"],
        &["retarget", "c.asc", "--ri", "1.3", "--pavilion", "range"],
        &["retarget", "c.asc", "--ri", "1.76", "--pavilion", "95"],
        &["retarget", "c.asc", "--ri", "1.76", "--crown", "0"],
    ] {
        let (out, said) = bench.ends(2, arguments);
        assert!(out.is_empty() && said.lines().count() == 1, "{arguments:?}: {out}{said}");
    }
    assert_eq!(bench.names(), there);
    // what another command made is not replaced
    bench.good(&["edit", "c.asc", "--set", "table=54", "-q", "-o", "new.asc"]);
    bench.good(&["edit", "c.asc", "--set", "table=54", "-q", "-o", "new.asc"]);
    bench.ends(3, &["edit", "c.asc", "--set", "table=53.5", "-q", "-o", "new.asc"]);
    bench.good(&["edit", "c.asc", "--set", "table=53.5", "-q", "-o", "new.asc", "--force"]);
}

/// The formulas of the manual, from figures of its own; and the index that the file then states.
#[test]
fn a_design_is_made_for_another_index() {
    let bench = folder();
    let no_scores = ["--score", "spread", "--from", "1.54", "--ri", "1.76"];
    let run = |more: &[&str]| json(&bench, &[&["retarget", "c.asc"], &no_scores[..], more].concat());
    let critical = |n: f64| (1.0 / n).asin().to_degrees();
    let (c, new) = (critical(1.54), critical(1.76));
    let margin = ["--pavilion", "margin", "--crown", "prism"];
    let report = run(&[&margin[..], &["-o", "sapphire.asc"]].concat());
    let figures = &report["retarget"];
    let of = |key: &str, when: &str| figures[key][when].as_f64().expect("a figure");
    let (was, is) = (of("pavilion_angle_deg", "before"), of("pavilion_angle_deg", "after"));
    assert!((is - (was + new - c)).abs() < 1e-9, "{figures}");
    let ratio = is.to_radians().tan() / was.to_radians().tan();
    for tier in report["tiers"].as_array().expect("tiers") {
        let tangent = |when| angle(tier, when).to_radians().tan();
        let expected = match tier["zone"].as_str() {
            Some("pavilion") => ratio,
            Some("crown") => 0.54 / 0.76,
            _ => continue,
        };
        assert!((tangent("after") / tangent("before") - expected).abs() < 1e-9, "{tier}");
    }
    assert!(String::from_utf8(bench.read("sapphire.asc")).expect("text").contains("\nI 1.76"));
    let range = run(&["--pavilion", "range", "--crown", "keep"]);
    let after = range["retarget"]["pavilion_angle_deg"]["after"].as_f64().expect("an angle");
    let share = |p: f64, c: f64| (p - c) / (60.0 - c / 3.0 - c);
    assert!(
        (share(was, c) - share(after, new)).abs() < 1e-9 && range["retarget"]["crown_scale"] == 1.0,
        "{range}"
    );
    let set = run(&["--pavilion", "39.5", "--crown", "0.8"]);
    assert!((set["retarget"]["pavilion_angle_deg"]["after"].as_f64().expect("an angle") - 39.5).abs() < 1e-9);
    // a diamond's margin is more than quartz has
    let beyond = ["retarget", "round-brilliant", "--material", "quartz", "--pavilion", "margin"];
    let (_, said) = bench.ends(2, &beyond);
    assert!(said.contains("reflected at both sides") && said.contains("--pavilion"), "{said}");
}

/// Unless a rule is named they are all tried: what is taken is the best of them, and no worse than the design as it
/// is; by scores of the program's own.
#[test]
fn the_rules_that_score_best_are_taken() {
    let bench = folder();
    let iso = |stone: &str| {
        let tilted = ["--tilt", "0:10:10", "--tilt-axis", "0,90", "--exact", "--metrics", "iso"];
        let scored = json(&bench, &[&["score", stone, "--ri", "1.76"], &tilted[..]].concat());
        let rows = scored.as_array().expect("rows");
        rows.iter().map(|row| row["iso"].as_f64().expect("a score")).sum::<f64>() / rows.len() as f64
    };
    let as_it_is = iso("c.asc");
    let run = |more: &[&str]| {
        let base = ["retarget", "c.asc", "--from", "1.54", "--ri", "1.76", "--score", "spread"];
        json(&bench, &[&base[..], more].concat())["retarget"].clone()
    };
    let best = run(&["-o", "best.asc"]);
    let trials = best["trials"].as_array().expect("trials");
    let score = |trial: &Value| trial["score"].as_f64().expect("a score");
    let most = trials.iter().map(score).fold(0.0, f64::max);
    assert_eq!(trials.len(), 9, "{best}");
    assert!((iso("best.asc") - most).abs() < 0.2 && most > as_it_is + 1.0, "{most} {as_it_is}: {best}");
    for trial in trials {
        let rules = ["pavilion", "crown"].map(|rule| trial[rule].as_str().expect("a rule"));
        let file = format!("{}-{}.asc", rules[0], rules[1]);
        let one = run(&["--pavilion", rules[0], "--crown", rules[1], "-o", &file]);
        assert!(one.get("trials").is_none() && one["pavilion_rule"] == trial["pavilion"], "{one}");
        assert!((iso(&file) - score(trial)).abs() < 0.2, "{file}: {} {trial}", iso(&file));
    }
    // of one kind, beside a rule that is named
    let crowns = run(&["--pavilion", "best", "--crown", "0.9"]);
    assert_eq!(crowns["trials"].as_array().map(Vec::len), Some(3), "{crowns}");
    assert_eq!(crowns["crown_scale"], 0.9);
    let (text, _) = bench.ends(0, &["retarget", "c.asc", "--ri", "1.76", "--score", "spread"]);
    assert!(
        text.contains("pavilion margin") && text.contains(" *") && text.contains("10° of tilt"),
        "{text}"
    );
    // a rule that a stone cannot follow is passed over: a diamond's margin in quartz
    let passed = ["retarget", "round-brilliant", "--ri", "1.54", "--score", "spread"];
    let made = &json(&bench, &passed)["retarget"];
    let why = made["trials"][0]["why"].as_str().expect("why not");
    assert!(why.contains("reflected at both sides") && made["trials"][0]["score"].is_null(), "{made}");
}

/// The index that a family's design is for stays in its file, and is what it is then scored in.
#[test]
fn a_family_keeps_its_index() {
    let bench = Bench::new();
    bench.good(&["edit", "round-brilliant", "--set", "crown-angle=33", "--ri", "1.76", "-q", "-o", "f.toml"]);
    let text = String::from_utf8(bench.read("f.toml")).expect("text");
    assert!(text.contains("refractive-index = 1.76") && text.contains("family ="), "{text}");
    let keep = ["--pavilion", "keep", "--crown", "keep", "--score", "spread", "-q"];
    bench.good(&[&["retarget", "round-brilliant", "--ri", "1.62", "-o", "k.toml"], &keep[..]].concat());
    let text = String::from_utf8(bench.read("k.toml")).expect("text");
    assert!(text.contains("refractive-index = 1.62"), "{text}");
    assert!(json(&bench, &["show", "f.toml"])[0].to_string().contains("1.76"));
    // and changes with the file
    bench.good(&["edit", "f.toml", "--set", "table=55", "--ri", "1.54", "-q", "-o", "g.toml"]);
    let text = String::from_utf8(bench.read("g.toml")).expect("text");
    assert!(text.contains("refractive-index = 1.54") && text.contains("table = 55"), "{text}");
}

/// Every tier by its place, every meet once: the corners that a count of the solid's own has.
#[test]
fn the_meet_network_is_shown() {
    let bench = Bench::new();
    let shown = &json(&bench, &["show", "round-brilliant", "--meets"])[0]["meets"];
    let tiers = shown["tiers"].as_array().expect("tiers");
    let of = |zone: &str| tiers.iter().filter(|t| t["zone"] == zone).count();
    assert_eq!([of("table"), of("crown"), of("girdle"), of("pavilion")], [1, 3, 1, 2], "{shown}");
    let meets = shown["meets"].as_array().expect("meets");
    let corners: u64 = meets.iter().map(|m| m["corners"].as_u64().expect("a count")).sum();
    // at the point of the pavilion its eight mains meet, in one corner
    let point = &meets[0];
    assert!(
        point["corners"] == 1 && point["height_percent"].as_f64().expect("a height").abs() < 1e-6,
        "{point}"
    );
    assert_eq!(point["tiers"][0]["facets"], 8, "{point}");
    assert!(corners > 8 && meets.len() < 12, "{shown}");
    let (text, _) = bench.ends(0, &["show", "round-brilliant", "--meets"]);
    for word in ["outline", "girdle", "table", "culet", "P1", "C1", "set by meets"] {
        assert!(text.contains(word), "{word}: {text}");
    }
    // a mesh has no names: places stand for its tiers, and find them
    bench.good(&["generate", "classic", "-q", "-o", "c.stl"]);
    let (text, _) = bench.ends(0, &["show", "c.stl"]);
    assert!(text.contains("  P1  ") && text.contains("  C1  "), "{text}");
    let report = json(&bench, &["edit", "c.stl", "--set", "P1.angle+=0.2"]);
    let p1 = tier(&report, "P1");
    assert!((angle(p1, "after") - angle(p1, "before") - 0.2).abs() < 1e-6, "{p1}");
}
