//! Plots of tables: title, ends of axes, colours, size, and what is drawn of a stone's material.

use crate::bench::{Bench, text};

/// A sweep of the round brilliant, quickly made.
fn sweep<'a>(stone: &'a str, options: &[&'a str]) -> Vec<&'a str> {
    [&["sweep", "-q", stone, "--metrics", "wlr", "--error", "0.02"], options].concat()
}

const CURVE: [&str; 2] = ["--vary", "crown-angle=30:38:2"];
const MAP: [&str; 4] = ["--vary", "crown-angle=30:38:4", "--vary", "pavilion-angle=40:42:1"];

fn drawn(bench: &Bench, name: &str) -> String {
    let svg = text(&bench.read(name));
    let tree = roxmltree::Document::parse(&svg).expect("a plot is XML");
    let words = tree.descendants().filter(|n| n.has_tag_name("text")).filter_map(|n| n.text());
    words.collect::<Vec<_>>().join("\n")
}

/// The grading envelopes are published for diamond: no other stone has them in its plots, whether its index
/// is asked for, its material is, or either stands in the STONE or on an axis.
#[test]
fn envelopes_are_drawn_for_diamond_alone() {
    let bench = Bench::new();
    let mut number = 0;
    let mut has = |stone: &str, options: &[&str]| {
        number += 1;
        let (table, plot) = (format!("{number}.csv"), format!("{number}.svg"));
        bench.good(&[&sweep(stone, options)[..], &["-o", &table, "--plot", &plot]].concat());
        let first = drawn(&bench, &plot).contains("envelope of");
        // the table's sidecar knows it too
        bench.good(&["plot", "-q", &table, "-o", "again.svg", "--force"]);
        assert_eq!(drawn(&bench, "again.svg").contains("envelope of"), first, "{stone} {options:?}");
        first
    };
    assert!(has("round-brilliant", &CURVE) && has("round-brilliant", &MAP));
    assert!(has("tolkowsky", &[&CURVE[..], &["--material", "diamond"]].concat()));
    assert!(has("round-brilliant", &[&CURVE[..], &["--ri", "2.417"]].concat()), "diamond by its index");
    for other in [["--material", "quartz"], ["--ri", "1.54"], ["--material", "ruby"]] {
        assert!(!has("round-brilliant", &[&CURVE[..], &other].concat()), "{other:?}");
        assert!(!has("round-brilliant", &[&MAP[..], &other].concat()), "{other:?}");
    }
    assert!(!has("round-brilliant:material=quartz", &CURVE));
    assert!(!has("round-brilliant", &["--vary", "crown-angle=30:38:4", "--vary", "ri=2.3:2.5:0.1"]));
    assert!(!has("oval", &CURVE), "an oval has none");
}

#[test]
fn title_and_ends_of_axes_are_what_was_asked_for() {
    let bench = Bench::new();
    let look =
        ["--title", "Crown <angles> & light", "--range", "wlr=0.1:0.5", "--range", "crown-angle=32:40"];
    let asked =
        [&sweep("round-brilliant", &CURVE)[..], &["-o", "c.csv", "--plot", "wlr.svg"], &look].concat();
    bench.good(&asked);
    let words = drawn(&bench, "wlr.svg");
    assert!(words.starts_with("Crown <angles> & light\n"), "{words}");
    let numbers: Vec<f64> = words.lines().filter_map(|w| w.parse().ok()).collect();
    let of = |low: f64, high: f64| {
        let within: Vec<f64> = numbers.iter().copied().filter(|x| (low..=high).contains(x)).collect();
        (within.first().copied(), within.last().copied())
    };
    assert_eq!(of(20.0, 50.0), (Some(32.0), Some(40.0)), "{words}");
    assert_eq!(of(0.0, 1.0), (Some(0.1), Some(0.5)), "{words}");
    let svg = text(&bench.read("wlr.svg"));
    let marks = svg.matches("<circle").count();
    assert_eq!(marks, 4, "the point at 30° is outside of the axis, 32° to 38° are within");

    // of a map: ends of both axes and of the colours, of which the bar beside it has the numbers
    bench.good(&[&sweep("round-brilliant", &MAP)[..], &["-o", "m.csv"]].concat());
    let plot = |file: &str, options: &[&str]| {
        bench.good(&[&["plot", "-q", "m.csv", "-o", file], options].concat());
        drawn(&bench, file)
    };
    let plain = plot("plain.svg", &[]);
    assert!(plain.starts_with("wlr of round-brilliant\n") && !plain.contains("0.90"), "{plain}");
    let wide = plot("wide.svg", &["--range", "wlr=0:1", "--range", "pavilion-angle=39:43", "--title", "T"]);
    assert!(wide.starts_with("T\n") && ["0.1", "0.9", "43.0"].iter().all(|n| wide.lines().any(|w| w == *n)));
    // nothing is known beyond the table: the coloured ground ends where it does
    let svg = text(&bench.read("wide.svg"));
    let tree = roxmltree::Document::parse(&svg).expect("XML");
    let clip = tree.descendants().find(|n| n.attribute("id") == Some("known")).expect("a clip");
    let height: f64 = clip
        .first_element_child()
        .and_then(|r| r.attribute("height"))
        .expect("a height")
        .parse()
        .expect("a number");
    let whole: f64 = tree
        .descendants()
        .find(|n| n.attribute("id") == Some("plot"))
        .and_then(|n| n.first_element_child()?.attribute("height")?.parse().ok())
        .expect("a height");
    assert!((height / whole - 0.5).abs() < 1e-3, "{height} of {whole}: 2° of 4°");

    // tilts: the option says tilt, the column is tilt_deg
    let tilted = ["score", "-q", "cube", "--metrics", "iso", "--error", "0.05", "--tilt", "-20:20:10"];
    let rest = ["-o", "t.csv", "--plot", "t.svg", "--range", "tilt=-40:40", "--range", "iso=0:100"];
    bench.good(&[&tilted[..], &rest].concat());
    let words = drawn(&bench, "t.svg");
    assert!(["−40", "40", "100"].iter().all(|n| words.lines().any(|w| w == *n)), "{words}");
}

#[test]
fn plots_are_of_the_size_and_colours_asked_for_and_pages_for_print() {
    let bench = Bench::new();
    bench.good(&[&sweep("round-brilliant", &MAP)[..], &["-o", "m.csv"]].concat());
    let plot = |file: &str, options: &[&str]| {
        bench.good(&[&["plot", "-q", "m.csv", "-o", file], options].concat());
        bench.read(file)
    };
    let width = |png: &[u8]| u32::from_be_bytes(png[16..20].try_into().expect("four bytes"));
    assert_eq!(width(&plot("a.png", &[])), 1600);
    assert_eq!(width(&plot("b.png", &["--pixels", "500"])), 500);
    let [viridis, greys] = ["viridis", "Greys"].map(|c| text(&plot(&format!("{c}.svg"), &["--colours", c])));
    assert_ne!(viridis, greys);
    let grey = |colour: &str| colour[1..3] == colour[3..5] && colour[3..5] == colour[5..7];
    let fills = |svg: &str| -> Vec<String> {
        let tree = roxmltree::Document::parse(svg).expect("XML");
        let rects = tree.descendants().filter(|n| n.has_tag_name("rect") && n.attribute("x") == Some("684"));
        rects.filter_map(|n| n.attribute("fill")).filter(|f| f.starts_with('#')).map(String::from).collect()
    };
    assert!(fills(&greys).len() > 3 && fills(&greys).iter().all(|c| grey(c)), "{:?}", fills(&greys));
    assert!(!fills(&viridis).iter().all(|c| grey(c)));

    let page = plot("m.pdf", &[]);
    assert!(page.starts_with(b"%PDF-"));
    let end = &page[page.len().saturating_sub(1024)..];
    assert!(end.windows(5).any(|w| w == b"%%EOF"), "readers look for the end in the last 1024 bytes");
    // the same command may replace it, another may not
    bench.good(&["plot", "-q", "m.csv", "-o", "m.pdf"]);
    let said = bench.ends(3, &["plot", "-q", "m.csv", "-o", "m.pdf", "--title", "x"]).1;
    assert!(said.contains("--force"), "{said}");
}

#[test]
fn looks_that_fit_no_plot_are_refused_before_the_work() {
    let bench = Bench::new();
    let out = ["-o", "t.csv", "--plot", "p.svg"];
    for (options, word) in [
        (&["--range", "fire_lit=0:1"][..], "crown-angle, wlr"),
        (&["--range", "wlr=1:0"], "FROM must be less"),
        (&["--range", "wlr"], "KEY=FROM:TO"),
        (&["--range", "wlr=0:1", "--range", "WLR=0:2"], "twice"),
        (&["--pixels", "0"], "whole number of pixels"),
        (&["--pixels", "640x480"], "640x480"),
        (&["--colours", "rainbow"], "viridis, magma"),
    ] {
        let line = [&sweep("round-brilliant", &CURVE)[..], &out, options].concat();
        let said = bench.ends(2, &line).1;
        assert!(said.contains(word), "{options:?}: {said}");
    }
    for option in
        [&["--title", "x"][..], &["--range", "wlr=0:1"], &["--pixels", "9"], &["--colours", "magma"]]
    {
        let line = [&sweep("round-brilliant", &CURVE)[..], &["-o", "t.csv"], option].concat();
        let said = bench.ends(2, &line).1;
        assert!(said.contains("--plot FILE"), "{option:?}: {said}");
    }
    assert!(bench.names().is_empty(), "{:?}", bench.names());
}
