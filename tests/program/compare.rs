//! `cutlab compare`: paired differences and what they are worth.

use crate::bench;
use crate::bench::Bench;
use crate::brilliants::{SEED, diamond, named, plan, subject};
use cutlab::advanced::scoring::comparison::{SIGNIFICANT, compare};
use cutlab::advanced::scoring::score::score;

/// The difference of two stones is that of long runs of each, and sharper than their errors.
#[test]
fn differences_are_right_and_sharper_than_the_scores() {
    let subjects = ["reference", "57"].map(|n| subject(n, &named(n), diamond()));
    let plan = plan(&["wlr", "leakage"], 1 << 16);
    let compared = compare(&subjects, &plan, &|| ());
    let long = plan.samples(1 << 20).seed(SEED + 9);
    let [a, b] = [0, 1].map(|i| score(&subjects[i], &long).scores);
    for m in 0..2 {
        let (a, b) = (a[m].expect("applies"), b[m].expect("applies"));
        let d = compared.differences[0][m].expect("applies");
        let off = (d.value - (b.value - a.value)).abs();
        // two comparisons at 3.9 errors
        assert!(off < 3.9 * d.error.hypot(a.error).hypot(b.error), "{d:?}, {a:?}, {b:?}");
        let apart = compared.rows[0].scores[m].expect("applies").error;
        assert!(d.error < 1.5 * apart, "paired: {} and {apart}", d.error);
    }
}

/// Of a stone and itself turned about its axis no more differences are significant than Student's
/// law has it: P(|t| > 3) = .0053 with 31 degrees of freedom; of 60, two have P = .04, three .004.
#[test]
fn equal_stones_rarely_differ() {
    let still = named("reference");
    let mut found = 0;
    for run in 0..20 {
        let angle = 0.01 + 0.03 * f64::from(run);
        let turned = still.clone().turned(glam::DMat3::from_rotation_z(angle));
        let subjects = [subject("a", &still, diamond()), subject("b", &turned, diamond())];
        let plan = plan(&["wlr", "leakage", "glare"], 1 << 13).seed(SEED + run as u64);
        let compared = compare(&subjects, &plan, &|| ());
        found += (0..3).filter(|m| compared.is_significant(0, *m) == Some(true)).count();
    }
    println!("{found} of 60 beyond {SIGNIFICANT} errors");
    assert!(found <= 2, "{found}");
}

#[test]
fn the_command_shows_scores_beside_each_other() {
    let bench = Bench::new();
    let (table, _) = bench.ends(
        0,
        &[
            "compare",
            "round-brilliant",
            "tolkowsky",
            "scan-dn",
            "--metrics",
            "wlr,spread",
            "--error",
            "0.002",
        ],
    );
    assert!(table.contains("tolkowsky less round-brilliant") && table.contains("wlr"), "{table}");
    let (json, _) = bench
        .ends(0, &["compare", "tolkowsky", "octahedron", "--metrics", "wlr", "--error", "0.002", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(json[0]["differences"][0]["significant"], true, "{json}");
    assert_eq!(bench.ends(2, &["compare", "tolkowsky"]).0, "");
    assert!(bench.ends(2, &["compare", "tolkowsky", "missing"]).1.contains("missing"));
}

#[test]
#[ignore = "two stones, ten seconds: .ci/run runs it"]
fn the_page_has_both_stones_and_needs_nothing_beside_it() {
    let bench = Bench::new();
    bench.good(&[
        "compare",
        "tolkowsky",
        "octahedron",
        "--metrics",
        "wlr,leakage",
        "--error",
        "0.002",
        "--width",
        "160",
        "-o",
        "out",
    ]);
    let page = String::from_utf8(bench.read("out/index.html")).expect("UTF-8");
    assert_eq!(page.matches("data:image/png;base64,").count(), 10);
    assert!(page.contains("tilt (°)") && page.contains("octahedron less tolkowsky"));
    assert!(!page.contains("src=\"http") && !page.contains("href=\"http"));
}

const QUICK: [&str; 4] = ["--metrics", "wlr,spread", "--error", "0.01"];

/// One design in two materials: each stands in its column's head, its file's row and its entry.
#[test]
fn materials_stand_beside_the_stones_in_every_form() {
    let bench = Bench::new();
    bench.good(&["generate", "-q", "classic", "-o", "D.asc"]);
    let compare = |options: &[&str]| {
        let stones = ["compare", "-q", "D.asc:material=quartz", "D.asc:material=topaz"];
        bench.ends(0, &[&stones[..], &QUICK, options].concat()).0
    };
    let shown = compare(&["-o", "c.md"]);
    assert!(shown.contains("(quartz)") && shown.contains("(topaz)"), "{shown}");
    let markdown = bench::text(&bench.read("c.md"));
    for word in ["(quartz)", "| wlr |", "| weight |", "| table |", "| --- |"] {
        assert!(markdown.contains(word), "{word}: {markdown}");
    }
    let rows: serde_json::Value = serde_json::from_str(&compare(&["--json"])).expect("JSON");
    assert_eq!(rows[0]["scores"][1]["material"], "topaz");
    compare(&["-o", "c.csv"]);
    compare(&["-o", "c.json"]);
    let table: serde_json::Value = serde_json::from_slice(&bench.read("c.json")).expect("JSON");
    let find = |metric: &str, material: &str| {
        let all = table.as_array().expect("rows");
        all.iter().find(|r| r["metric"] == metric && r["material"] == material).expect("its row").clone()
    };
    let (quartz, topaz) = (find("wlr", "quartz"), find("wlr", "topaz"));
    let number = |v: &serde_json::Value| v.as_f64().expect("a number");
    let less = number(&topaz["value"]) - number(&quartz["value"]);
    assert!((number(&topaz["difference"]) - less).abs() < 1e-6 && topaz["significant"] == "yes", "{topaz}");
    assert!(quartz["difference"].is_null() && quartz["significant"].is_null(), "{quartz}");
    let weight = number(&find("weight", "topaz")["value"]) / number(&find("weight", "quartz")["value"]);
    assert!((weight - 3.53 / 2.65).abs() < 0.03, "{weight}");
    let csv = bench::text(&bench.read("c.csv"));
    assert_eq!(csv.lines().count(), 1 + table.as_array().map_or(0, Vec::len));
    assert_eq!(compare(&["-o", "-"]), csv);
    // again by the same command; by another only with --force
    compare(&["-o", "c.csv"]);
    let other = ["compare", "cube", "octahedron", "--metrics", "spread", "-o", "c.csv"];
    assert!(bench.ends(3, &other).1.contains("--force"));
    assert!(bench.ends(2, &["compare", "cube"]).1.contains("two stones"));
}

/// As many stones as a folder holds: each has a line of a width that can be read.
#[test]
fn many_stones_have_a_line_each() {
    let bench = Bench::new();
    for i in 0..12 {
        let file = format!("designs/a-name-that-is-longer-than-others-{i}.obj");
        bench.good(&["generate", "-q", "--table", &format!("{}", 50 + i), "-o", &file]);
    }
    let command = [&["compare", "-q", "designs"], &QUICK[..]].concat();
    let (shown, _) = bench.ends(0, &command);
    assert_eq!(shown.lines().filter(|l| l.starts_with("designs/")).count(), 12, "{shown}");
    assert!(shown.lines().all(|l| l.chars().count() < 160), "{shown}");
}

/// Which values are the better stands in every form, and what the weight is by where only an index is known.
#[test]
fn the_better_values_are_named_and_weights_have_their_reason() {
    let bench = Bench::new();
    let stones =
        ["compare", "-q", "cube", "octahedron", "--metrics", "wlr,leakage,contrast", "--error", "0.05"];
    let compare = |options: &[&str]| bench.ends(0, &[&stones[..], options].concat()).0;
    let shown = compare(&[]);
    let last = |name: &str| {
        let line = shown.lines().find(|l| l.starts_with(name)).expect("a line");
        line.split_whitespace().last().expect("words").to_owned()
    };
    assert!(shown.lines().next().is_some_and(|head| head.ends_with("better")), "{shown}");
    assert_eq!((last("wlr").as_str(), last("leakage").as_str()), ("more", "less"), "{shown}");
    assert!(!["more", "less"].contains(&last("contrast").as_str()), "{shown}");
    let entries: serde_json::Value = serde_json::from_str(&compare(&["--json"])).expect("JSON");
    let said: Vec<_> = entries.as_array().expect("a list").iter().map(|e| e["better"].as_str()).collect();
    assert_eq!(said, [Some("more"), Some("less"), None]);
    compare(&["-o", "c.json"]);
    let table: serde_json::Value = serde_json::from_slice(&bench.read("c.json")).expect("JSON");
    let of = |name: &str| {
        let rows = table.as_array().expect("rows");
        rows.iter().find(|r| r["metric"] == name).expect("its row")["better"].clone()
    };
    assert_eq!(
        (of("wlr"), of("leakage"), of("weight")),
        ("more".into(), "less".into(), serde_json::Value::Null)
    );
    let several = ["compare", "-q", "cube", "prism", "octahedron", "tetrahedron", "bipyramid"];
    let rest = ["--metrics", "spread,leakage,weight_ratio", "--error", "0.05"];
    let (many, _) = bench.ends(0, &[&several[..], &rest].concat());
    assert!(many.contains("more is better: spread\nless is better: leakage\n"), "{many}");

    // 1.544 is quartz's index, 3.5 no known material's
    let weights = |ri: &str| {
        let line = ["compare", "cube", "octahedron", "--metrics", "spread", "--size", "8", "--ri", ri];
        let (shown, _) = bench.ends(0, &line);
        let row = shown.lines().find(|l| l.starts_with("weight ")).expect("a line").to_owned();
        (row, shown)
    };
    let (row, shown) = weights("1.544");
    let cube: f64 = row.split_whitespace().nth(1).and_then(|w| w.parse().ok()).expect("a weight");
    assert!((cube - 512.0 * 2.65 / 200.0).abs() < 0.02, "{row}");
    assert!(shown.contains("weight of cube: n = 1.544 is nearest to quartz"), "{shown}");
    let (row, shown) = weights("3.5");
    assert_eq!(row.split_whitespace().nth(1), Some("–"), "{row}");
    assert!(shown.contains("weight of octahedron: no material of n = 3.5 is known"), "{shown}");
    let score = ["score", "cube", "--metrics", "spread", "--size", "8", "--proportions"];
    let (table, said) = bench.ends(0, &[&score[..], &["--ri", "1.544"]].concat());
    assert!(table.contains(",quartz,") && said.contains("n = 1.544 is nearest to quartz"), "{table}{said}");
    let (table, said) = bench.ends(0, &[&score[..], &["--ri", "3.5"]].concat());
    let head = table.lines().next().expect("a head").split(',').position(|c| c == "carats").expect("there");
    assert_eq!(table.lines().nth(1).and_then(|row| row.split(',').nth(head)), Some(""), "{table}");
    assert!(said.contains("no material of n = 3.5 is known"), "{said}");
}

/// A cell that is empty has its reason beside it, and standard output holds one thing.
#[test]
fn what_a_table_leaves_out_has_its_reason_and_json_stands_alone() {
    let bench = Bench::new();
    let stones = ["compare", "-q", "octahedron", "cube", "--ri", "1.9", "--metrics", "fire_streak,spread"];
    let table = |options: &[&str]| -> Vec<serde_json::Value> {
        let (shown, _) = bench.ends(0, &[&stones[..], &["--error", "0.05"], options].concat());
        serde_json::from_str(&shown).expect("JSON alone")
    };
    let rows = table(&["-o", "-", "--json"]);
    assert!(rows.iter().all(|row| row["value"].is_null() == row["left_out"].is_string()), "{rows:?}");
    let why = |metric: &str| {
        let row = rows.iter().find(|row| row["metric"] == metric).expect("a row");
        row["left_out"].as_str().unwrap_or_default().to_owned()
    };
    assert!(why("fire_streak").contains("dispersion") && why("table").contains("no table"), "{rows:?}");
    assert_eq!(why("spread"), "");
}

/// A table belongs to what the files hold that it names: stones, and a material of one's own.
#[test]
fn a_table_belongs_to_what_its_files_hold() {
    let bench = Bench::new();
    let stone = |crown: &str| {
        bench.good(&["generate", "-q", "--force", "--crown-angle", crown, "-o", "a.asc"]);
    };
    let material = |n: f64| {
        std::fs::write(bench.path("m.toml"), format!("name = \"m\"\n[index]\nn-d = {n}\n")).expect("writes");
    };
    let made = || {
        let stones = ["compare", "-q", "a.asc", "cube:material=m.toml", "-o", "c.csv"];
        bench.good(&[&stones[..], &QUICK].concat());
        let meta: serde_json::Value = serde_json::from_slice(&bench.read("c.csv.meta.json")).expect("JSON");
        (meta["study"].to_string(), meta["command"].to_string(), bench::text(&bench.read("c.csv")))
    };
    stone("34");
    material(1.6);
    let first = made();
    assert_eq!(made(), first);
    stone("36");
    let second = made();
    material(1.7);
    let third = made();
    for (before, after) in [(&first, &second), (&second, &third)] {
        assert_ne!(before.0, after.0, "the study is of the files");
        assert_eq!(before.1, after.1, "the command is the same");
        assert_ne!(before.2, after.2, "the table is made anew");
    }
}

/// A comparison from the library is that of the command, and ends when it is asked to.
#[test]
fn the_library_compares_as_the_command_does() {
    struct Stop;
    impl cutlab::Progress for Stop {
        fn is_cancelled(&self) -> bool {
            true
        }
    }
    let bench = Bench::new();
    let (printed, _) = bench.ends(0, &[&["compare", "tolkowsky", "cube", "-o", "-"], &QUICK[..]].concat());
    let scores = cutlab::ScoreRequest::new(["wlr", "spread"]).error(0.01);
    let request = cutlab::ComparisonTable::new(["tolkowsky", "cube"], scores);
    let compared = request.run(&()).expect("two stones");
    let table = compared.table(cutlab::advanced::batch::table::TableFormat::Csv).expect("a table");
    assert_eq!(bench::text(&table), printed);
    let kind = |request: &cutlab::ComparisonTable, progress: &dyn cutlab::Progress| {
        cutlab::Error::from(request.run(progress).expect_err("no comparison")).kind()
    };
    assert_eq!(kind(&request, &Stop), cutlab::ErrorKind::Cancelled);
    let scores = request.scores.clone();
    let alone = cutlab::ComparisonTable::new(["cube"], scores.clone());
    assert_eq!(kind(&alone, &()), cutlab::ErrorKind::Invalid);
    let missing = cutlab::ComparisonTable::new(["nowhere/*.asc"], scores);
    assert_eq!(kind(&missing, &()), cutlab::ErrorKind::NotFound);
}
