//! What is committed under `reports/` is what the program makes: `tools/reports` makes it anew.

use crate::bench::{Bench, text};
use cutlab::advanced::trace::Isa;
use std::fs;
use std::path::{Path, PathBuf};

fn reports() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("reports")
}

fn committed(name: &str) -> String {
    fs::read_to_string(reports().join(name)).expect("is committed")
}

/// Prints the instruction set for `tools/reports`, which writes it into `reports/VERSION`.
#[test]
fn instruction_set() {
    println!("instruction set: {}", Isa::best().name());
}

/// Every page is dated by the version that made it, which is this one; none is without a maker.
#[test]
fn pages_are_of_this_version() {
    let version = format!("cutlab {}", env!("CARGO_PKG_VERSION"));
    assert!(committed("VERSION").starts_with(&version), "{}", committed("VERSION"));
    for page in ["gallery/README.md", "polarisation.md", "beams.md", "trace.md", "peers.md"] {
        let text = committed(page);
        let blocks = text.split("<!-- made by tools/reports: ").skip(1).collect::<Vec<_>>();
        assert!(!blocks.is_empty(), "{page} has no part that tools/reports makes");
        for block in blocks {
            let made = block.split_once("-->").expect("the marker ends").1;
            let made = made.split_once("<!-- end -->").expect("the part ends").0.trim();
            // benchmarks are filled in on a quiet machine
            let may_wait = ["beams.md", "trace.md", "peers.md"].contains(&page);
            assert!(
                may_wait && made.is_empty() || made.starts_with(&version),
                "{page}: made by another version"
            );
        }
    }
}

/// Every picture of the gallery stands in its page.
#[test]
fn the_gallery_names_its_pictures() {
    let page = committed("gallery/README.md");
    for entry in fs::read_dir(reports().join("gallery")).expect("is a folder") {
        let name = entry.expect("can be listed").file_name().into_string().expect("UTF-8");
        assert!(name == "README.md" || page.contains(&name), "{name} is in no row");
    }
}

/// A table beside the committed one: the same bytes on the instruction set that made it, elsewhere
/// the same within what instruction sets differ by.
fn same_table(name: &str, made: &str) {
    let old = committed(name);
    let isa = committed("VERSION").lines().nth(1).expect("a second line").to_owned();
    if isa == Isa::best().name() {
        assert_eq!(old, made, "{name} is not what the program makes: run tools/reports");
        return;
    }
    println!("made with {isa}: values are compared, not bytes");
    let [old, new] = [old.as_str(), made].map(rows);
    assert_eq!((old.len(), &old[0]), (new.len(), &new[0]), "{name}: run tools/reports");
    let heads = &old[0];
    for (old, new) in old[1..].iter().zip(&new[1..]) {
        for (c, value) in old.iter().enumerate().skip(1) {
            let [a, b] = [value, &new[c]].map(|x| x.parse::<f64>().unwrap_or(0.0));
            // an error is known to some percent
            let most = if heads[c].ends_with("_se") { 0.05 * a.abs() } else { 4.0 * error(old, c) };
            assert!((a - b).abs() <= most + 1e-9, "{name}: {} {a} and {b} in {old:?}", heads[c]);
        }
    }
}

fn rows(table: &str) -> Vec<Vec<String>> {
    let reader = csv::ReaderBuilder::new().has_headers(false).from_reader(table.as_bytes());
    let records = reader.into_records().map(|r| r.expect("a row"));
    records.map(|r| r.iter().map(str::to_owned).collect()).collect()
}

/// The standard error of a column: that of the next cell, where it is one; large where there is none.
fn error(row: &[String], column: usize) -> f64 {
    row.get(column + 1).and_then(|x| x.parse::<f64>().ok()).unwrap_or(f64::INFINITY)
}

/// [C] The reference stones of the report page, all their scores.
#[test]
#[ignore = "long"]
fn reference_stones_are_current() {
    let bench = Bench::new();
    let stones = cutlab::advanced::report::references::STONES.map(|(.., stone)| stone);
    let mut command = vec!["score"];
    command.extend(stones);
    command.extend(["--material", "diamond", "-q", "-o", "references.csv"]);
    bench.ends(0, &command);
    same_table(
        "../src/report/data/references.csv",
        &text(&fs::read(bench.path("references.csv")).expect("was written")),
    );
}

/// [C] The curve of the sweeps over the crown angle.
#[test]
#[ignore = "long"]
fn the_sweep_over_the_crown_is_current() {
    let bench = Bench::new();
    let command = "sweep round-brilliant --vary crown-angle=0:45:1 --metrics wlr --polarisation off \
                   --error 0.0004 -q -o crown.csv";
    bench.ends(0, &command.split_whitespace().collect::<Vec<_>>());
    same_table("sweeps/crown.csv", &text(&fs::read(bench.path("crown.csv")).expect("was written")));
}
