//! `cutlab sweep`: grids, scattered points, shards, plots.

use crate::bench::{Bench, text};
use std::time::{Duration, Instant};

fn sweep<'a>(options: &[&'a str]) -> Vec<&'a str> {
    [&["sweep", "round-brilliant", "--metrics", "wlr", "--polarisation", "off"], options].concat()
}

fn column(table: &str, name: &str) -> Vec<Option<f64>> {
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let at = reader.headers().expect("a head").iter().position(|h| h == name).expect("the column");
    reader.records().map(|r| r.expect("a row")[at].parse().ok()).collect()
}

const GRID: [&str; 4] = ["--vary", "crown-angle=20:44:8", "--vary", "pavilion-angle=39:43:2"];

#[test]
fn a_grid_has_a_row_a_point_and_points_that_cannot_be_cut_say_why() {
    let bench = Bench::new();
    let (table, said) = bench
        .ends(1, &sweep(&["--vary", "crown-angle=10:70:30", "--vary", "table=50:60:10", "--error", "0.01"]));
    assert_eq!(table.lines().next(), Some("crown-angle,table,facets,wlr,wlr_se,error"));
    let crowns: Vec<f64> = column(&table, "crown-angle").into_iter().flatten().collect();
    let tables: Vec<f64> = column(&table, "table").into_iter().flatten().collect();
    assert_eq!(crowns, [10.0, 10.0, 40.0, 40.0, 70.0, 70.0]);
    assert_eq!(tables, [50.0, 60.0, 50.0, 60.0, 50.0, 60.0]);
    let wlr = column(&table, "wlr");
    assert!(wlr[0].is_some() && wlr.iter().any(Option::is_none), "{table}");
    assert!(said.contains("round-brilliant:crown-angle=70"), "{said}");
    // a point is the stone it says
    let (alone, _) = bench.ends(
        0,
        &[
            "score",
            "round-brilliant:crown-angle=40,table=60",
            "--metrics",
            "wlr",
            "--polarisation",
            "off",
            "--error",
            "0.01",
        ],
    );
    assert_eq!(column(&alone, "wlr")[0], wlr[3]);
}

#[test]
fn what_cannot_be_swept_or_drawn_is_refused_before_anything_is_scored() {
    let bench = Bench::new();
    for (options, word) in [
        (&["--vary", "crown=30:38:1"][..], "crown-angle"),
        (&["--vary", "table=30:38"], "FROM:TO:STEP"),
        (&["--vary", "table=30:38:-1"], "leads away"),
        (&["--vary", "table=50:60:5", "--vary", "table=50:60:5"], "twice"),
        (&["--vary", "ri=1.5:2:0.1", "--ri", "2"], "ri"),
        (&["--vary", "table=50:60:5", "--plot", "x.jpg", "-o", "t.csv"], ".svg"),
        (&["--vary", "table=50:60:5", "--plot", "x.svg"], "-o"),
    ] {
        let said = bench.ends(2, &sweep(options)).1;
        assert!(said.contains(word), "{options:?}: {said}");
    }
    assert!(bench.names().is_empty(), "{:?}", bench.names());
    let said = bench.ends(2, &["sweep", "classic", "--vary", "table=50:60:5"]).1;
    assert!(said.contains("size, ri"), "{said}");
    // size and index every stone has
    let (table, _) = bench
        .ends(0, &["sweep", "classic", "--vary", "ri=1.5:1.9:0.4", "--metrics", "wlr", "--error", "0.01"]);
    let wlr = column(&table, "wlr");
    assert!(wlr[0] != wlr[1], "{wlr:?}");
}

#[test]
fn shards_of_a_sweep_merge_and_a_killed_sweep_goes_on() {
    let bench = Bench::new();
    let all = |extra: &[&'static str]| sweep(&[&GRID[..], &["--error", "0.001"], extra].concat());
    let begun = Instant::now();
    bench.good(&all(&["-o", "whole.csv"]));
    let takes = begun.elapsed();
    bench.good(&all(&["-o", "p1.csv", "--shard", "1/2"]));
    let second = all(&["-o", "p2.csv", "--shard", "2/2"]);
    for share in [0.1, 0.3, 0.45] {
        bench.kill_after(takes.mul_f64(share), &second);
    }
    bench.good(&second);
    bench.good(&["merge", "p*.csv", "-o", "merged.csv"]);
    assert_eq!(text(&bench.read("merged.csv")), text(&bench.read("whole.csv")));
}

/// The error of the difference of two neighbours, from runs of many seeds, is less than the error
/// of either: the points of a sweep share their random numbers.
#[test]
fn differences_between_points_are_sharper_than_their_values() {
    let bench = Bench::new();
    let runs: Vec<(f64, f64)> = (1..=12)
        .map(|seed| {
            let seed = seed.to_string();
            let near = ["--vary", "pavilion-angle=40.5:40.51:0.01", "--error", "0.01", "--seed", &seed];
            let wlr = column(&bench.ends(0, &sweep(&near)).0, "wlr");
            (wlr[0].expect("a value"), wlr[1].expect("a value"))
        })
        .collect();
    let spread = |of: &dyn Fn(&(f64, f64)) -> f64| {
        let mean = runs.iter().map(of).sum::<f64>() / runs.len() as f64;
        (runs.iter().map(|r| (of(r) - mean).powi(2)).sum::<f64>() / (runs.len() - 1) as f64).sqrt()
    };
    let (value, difference) = (spread(&|r| r.0), spread(&|r| r.1 - r.0));
    println!("value ± {value:.1e}, difference ± {difference:.1e}");
    assert!(difference < 0.5 * value, "{difference} and {value}");
}

#[test]
fn plots_are_drawn_with_what_they_must_show() {
    let bench = Bench::new();
    bench.good(&sweep(
        &[&GRID[..], &["--error", "0.005", "-o", "m.csv", "--plot", "wlr.svg", "--plot", "m.png"]].concat(),
    ));
    let map = text(&bench.read("wlr.svg"));
    for word in
        ["crown angle (°)", "pavilion angle (°)", "envelope of Excellent", "tolkowsky", "reference", "wlr of"]
    {
        assert!(map.contains(word), "{word}");
    }
    roxmltree::Document::parse(&map).expect("the map is XML");
    assert!(bench.read("m.png").starts_with(b"\x89PNG"));
    bench.good(&[
        "sweep",
        "round-brilliant",
        "--vary",
        "crown-angle=20:44:4",
        "--metrics",
        "wlr,fire_streak",
        "--error",
        "0.05",
        "-o",
        "c.jsonl",
        "--plot",
        "c.svg",
    ]);
    for metric in ["wlr", "fire_streak"] {
        let curve = text(&bench.read(&format!("c-{metric}.svg")));
        assert!(
            curve.contains("crown angle (°)") && curve.contains(metric) && curve.contains("fill-opacity")
        );
        roxmltree::Document::parse(&curve).expect("the curve is XML");
    }
}

#[test]
fn scattered_points_fill_their_ranges_and_more_include_the_fewer() {
    let bench = Bench::new();
    let scatter = |n: &'static str| {
        let options =
            ["--vary", "crown-angle=28:40:1", "--vary", "table=50:65:1", "--scatter", n, "--error", "0.01"];
        bench.ends(0, &sweep(&options)).0
    };
    let (few, more) = (scatter("5"), scatter("9"));
    assert!(more.starts_with(&few) && more.lines().count() == 10);
    assert!(column(&more, "table").iter().flatten().all(|t| (50.0..=65.0).contains(t)));
    let options =
        ["--vary", "crown-angle=28:40:1", "--vary", "table=50:65:1", "--scatter", "30", "--error", "0.01"];
    bench.good(&sweep(&[&options[..], &["-o", "s.csv", "--plot", "wlr.svg"]].concat()));
    assert!(text(&bench.read("wlr.svg")).contains("natural neighbours"));
}

#[test]
fn a_killed_sweep_leaves_no_plot_without_its_table() {
    let bench = Bench::new();
    let command = sweep(&[&GRID[..], &["--error", "0.0003", "-o", "t.csv", "--plot", "wlr.svg"]].concat());
    assert!(bench.kill_after(Duration::from_millis(150), &command));
    assert!(!bench.exists("t.csv"));
    bench.good(&command);
    assert_eq!(bench.names(), ["t.csv", "t.csv.meta.json", "wlr.svg"]);
}
