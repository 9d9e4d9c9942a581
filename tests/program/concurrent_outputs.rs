//! Ten processes at once on one output: each waits for the one before it, and every file is whole.

use crate::bench::Bench;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Runs `command` in ten processes of one folder, and alone in another: all end with `code`, and leave
/// the same files.
fn ten(name: &str, code: i32, command: &[&str], prepare: impl Fn(&Bench)) {
    let files = |at_once: usize| -> BTreeMap<PathBuf, Vec<u8>> {
        let bench = Bench::new();
        prepare(&bench);
        let children: Vec<_> = (0..at_once).map(|_| bench.start(command)).collect();
        let codes: Vec<_> = children.into_iter().map(|mut c| c.wait().expect("ends").code()).collect();
        assert_eq!(codes, vec![Some(code); at_once], "{name}");
        bench.files()
    };
    let (alone, together) = (files(1), files(10));
    assert_eq!(together.keys().collect::<Vec<_>>(), alone.keys().collect::<Vec<_>>(), "{name}");
    for (path, bytes) in alone {
        assert!(together[&path] == bytes, "{name}: {} has other bytes", path.display());
    }
}

fn designs(bench: &Bench) {
    for i in 0..8 {
        bench.good(&["generate", "--crown-angle", &(30 + i).to_string(), "-q", "-o", &format!("in/{i}.asc")]);
    }
    std::fs::write(bench.path("in/bad.asc"), "GemCad 5.0\ng 96 0.0\n").expect("writes");
}

const SMALL: [&str; 10] =
    ["--width", "24", "--height", "18", "--spp", "1", "--photons", "1000", "--nearest", "50"];

#[test]
fn tables() {
    let score = ["score", "in", "--metrics", "wlr", "--error", "0.02", "-q", "-o"];
    ten("score", 1, &[&score[..], &["t.csv"]].concat(), designs);
    let sweep = ["sweep", "cube", "--vary", "size=1:3:0.01", "--metrics", "spread", "-q"];
    ten("sweep", 0, &[&sweep[..], &["-o", "t.jsonl", "--plot", "m.svg"]].concat(), |_| ());
    let shards = |bench: &Bench| {
        for (shard, part) in [("1/2", "p1.csv"), ("2/2", "p2.csv")] {
            bench.good(&[&sweep[..], &["--shard", shard, "-o", part]].concat());
        }
    };
    ten("merge", 0, &["merge", "p1.csv", "p2.csv", "-o", "all.csv", "-q"], shards);
}

#[test]
fn designs_in_and_out() {
    ten("import", 1, &["import", "in", "-o", "out", "--to", "glb"], designs);
    ten("import over what is there", 1, &["import", "in", "-o", "out", "--to", "obj", "--force"], designs);
    ten("generate", 0, &["generate", "-o", "g.obj", "-o", "g.svg"], |_| ());
}

#[test]
#[ignore = "five seconds: .ci/run runs it"]
fn pictures() {
    let render = [&["render", "octahedron", "-q"], &SMALL[..]].concat();
    ten("photon map", 0, &[&render[..], &["--photon-map", "kept.map", "-o", "p.png"]].concat(), |_| ());
    let frames = [&render[..], &["--frames", "3", "--turn", "stone", "-o"]].concat();
    for output in ["a.gif", "a.apng", "f/%02d.png"] {
        ten(output, 0, &[&frames[..], &[output]].concat(), |_| ());
    }
}
