//! A command that is killed at random moments and started again until it ends leaves the bytes of
//! one that was never disturbed, and at no moment a part of a file.
//!
//! `CUTLAB_KILLS` is how many kills each command survives (10 if it is not set).

use crate::bench::Bench;
use std::collections::BTreeMap;
use std::hash::{BuildHasher, Hasher, RandomState};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

type Files = BTreeMap<PathBuf, Vec<u8>>;

/// A random fraction, another in every run.
fn chance() -> f64 {
    RandomState::new().build_hasher().finish() as f64 / u64::MAX as f64
}

fn hidden(path: &Path) -> bool {
    path.iter().any(|part| part.as_encoded_bytes().starts_with(b"."))
}

/// Waits until the folder holds more than it did, hidden files too, or `at_most` has passed.
fn something_appears(bench: &Bench, before: usize, at_most: Duration) {
    let begun = Instant::now();
    while begun.elapsed() < at_most && bench.names().len() <= before {
        std::thread::sleep(Duration::from_micros(300));
    }
}

/// Kills `command` at random moments and starts it again.
///
/// - `code`: what it ends with
/// - `prepare`: makes its inputs in a folder
/// - `expected`: how many files there are in the end
fn survives(name: &str, code: i32, command: &[&str], prepare: impl Fn(&Bench), expected: usize) {
    let kills: u32 = std::env::var("CUTLAB_KILLS").ok().and_then(|n| n.parse().ok()).unwrap_or(10);
    let whole = Bench::new();
    prepare(&whole);
    let inputs = whole.files();
    let begun = Instant::now();
    whole.ends(code, command);
    let takes = begun.elapsed();
    let files = whole.files();
    let made: Vec<&PathBuf> = files.keys().filter(|f| !inputs.contains_key(*f)).collect();
    assert_eq!(made.len(), expected, "{made:?}");
    assert!(made.iter().all(|f| !hidden(f)), "it leaves what is for itself alone: {made:?}");

    let (mut hits, mut ends, mut broken) = (0, 0, fresh(&prepare));
    let mut tries = 0;
    while hits < kills {
        tries += 1;
        assert!(tries < 20 * kills + 100, "{name}: {hits} kills of {tries} found it at work");
        let before = broken.names().len();
        let mut child = broken.start(command);
        if chance() < 0.5 {
            std::thread::sleep(takes.mul_f64(chance()));
        } else {
            // at the first sign of a file, or soon after
            something_appears(&broken, before, takes);
            std::thread::sleep(Duration::from_micros((chance() * 10_000.0) as u64));
        }
        let ended = child.try_wait().expect("can be asked").is_some();
        let _ = child.kill();
        let status = child.wait().expect("ends");
        if ended {
            assert_eq!(status.code(), Some(code), "{name} by itself, after {hits} kills");
            same(name, &broken.files(), &files);
            (ends, broken) = (ends + 1, fresh(&prepare));
            continue;
        }
        hits += 1;
        for (path, bytes) in broken.files().iter().filter(|(path, _)| !hidden(path)) {
            assert!(files.get(path) == Some(bytes), "{name}: {} is no whole file", path.display());
        }
    }
    broken.ends(code, command);
    same(name, &broken.files(), &files);
    println!("{name}: {hits} kills, {} times to the end", ends + 1);
}

fn fresh(prepare: &impl Fn(&Bench)) -> Bench {
    let bench = Bench::new();
    prepare(&bench);
    bench
}

fn same(name: &str, found: &Files, whole: &Files) {
    assert_eq!(found.keys().collect::<Vec<_>>(), whole.keys().collect::<Vec<_>>(), "{name}");
    for (path, bytes) in found {
        assert!(whole[path] == *bytes, "{name}: {} has other bytes", path.display());
    }
}

/// Designs in folders, one of them bad, and notes beside them.
fn designs(bench: &Bench) {
    for (name, crown) in [("a.toml", "30"), ("deep/b.asc", "33"), ("c.gem", "36"), ("d.stl", "34")] {
        bench.good(&["generate", "--crown-angle", crown, "-o", &format!("in/{name}"), "-q"]);
    }
    std::fs::write(bench.path("in/bad.asc"), "GemCad 5.0\ng 96 0.0\n").expect("writes");
    std::fs::write(bench.path("in/notes.md"), "# notes").expect("writes");
}

fn nothing(_: &Bench) {}

const GRID: [&str; 8] = [
    "--vary",
    "crown-angle=30:38:2",
    "--vary",
    "table=52:60:2",
    "--metrics",
    "wlr,fire_streak",
    "--error",
    "0.01",
];

const PICTURE: [&str; 10] =
    ["--width", "32", "--height", "24", "--spp", "4", "--photons", "2000", "--nearest", "50"];

#[test]
#[ignore = "ten kills: .ci/run runs it"]
fn a_score_of_a_folder() {
    let score =
        |output| ["score", "in", "tolkowsky", "--metrics", "wlr,contrast", "--error", "0.003", "-o", output];
    survives("score, CSV", 1, &score("s.csv"), designs, 2);
    survives("score, JSON lines", 1, &score("s.jsonl"), designs, 2);
}

#[test]
#[ignore = "ten kills: .ci/run runs it"]
fn a_sweep_with_plots() {
    let output = ["-o", "t.csv", "--plot", "wlr.svg", "--plot", "m.png"];
    survives("sweep", 0, &[&["sweep", "round-brilliant"], &GRID[..], &output].concat(), nothing, 5);
}

#[test]
#[ignore = "ten kills: .ci/run runs it"]
fn a_merge() {
    let shards = |bench: &Bench| {
        for (shard, part) in [("1/2", "p1.csv"), ("2/2", "p2.csv")] {
            let table = ["--vary", "size=1:3:0.01", "--metrics", "spread", "--shard", shard, "-o", part];
            bench.good(&[&["sweep", "cube"], &table[..]].concat());
        }
    };
    survives("merge", 0, &["merge", "p1.csv", "p2.csv", "-o", "all.csv"], shards, 2);
}

#[test]
#[ignore = "ten kills: .ci/run runs it"]
fn animations() {
    let render = [&["render", "octahedron", "--frames", "4", "--turn", "stone"], &PICTURE[..]].concat();
    survives("GIF", 0, &[&render[..], &["-o", "a.gif"]].concat(), nothing, 1);
    survives("APNG", 0, &[&render[..], &["-o", "a.apng"]].concat(), nothing, 1);
    survives("numbered frames", 0, &[&render[..], &["-o", "f/%02d.png", "--passes"]].concat(), nothing, 20);
}

#[test]
#[ignore = "ten kills: .ci/run runs it"]
fn a_photon_map_and_its_picture() {
    let render = [&["render"], &PICTURE[..], &["--photon-map", "kept.map", "-o", "p.png"]].concat();
    survives("photon map", 0, &render, nothing, 2);
}

/// Long enough for its state to be kept now and then.
#[test]
#[ignore = "ten kills: .ci/run runs it"]
fn a_progressive_picture() {
    let rounds = ["--progressive", "--rounds", "20", "-o", "p.exr"];
    let render = [&["render"], &PICTURE[..4], &["--photons", "2000", "--nearest", "50"], &rounds].concat();
    survives("progressive picture", 0, &render, nothing, 1);
}

#[test]
#[ignore = "ten kills: .ci/run runs it"]
fn designs_in_and_out() {
    survives("import", 1, &["import", "in", "-o", "out", "--to", "glb"], designs, 4);
    let files = ["-o", "g.obj", "-o", "g.toml", "-o", "g.svg", "-o", "g.png", "-o", "g.stl"];
    survives("generate", 0, &[&["generate"], &files[..]].concat(), nothing, 5);
}

/// Its files come all together, at its end.
#[test]
#[ignore = "ten kills: .ci/run runs it"]
fn a_report() {
    let report = ["report", "octahedron", "--width", "64", "--error", "0.1", "-o", "out"];
    survives("report", 0, &report, nothing, 10);
}
