//! The same command gives the same bytes on one, two and five threads, whatever it computes.

use crate::bench::Bench;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Exit code, standard output and all files of a command line on so many threads.
fn run(line: &str, threads: &str) -> (Option<i32>, Vec<u8>, BTreeMap<PathBuf, Vec<u8>>) {
    let bench = Bench::new();
    std::fs::write(bench.path("dented.obj"), DENTED).expect("writes");
    bench.good(&["generate", "-q", "tolkowsky", "-o", "in/a.asc", "-o", "in/b.gem", "-o", "in/c.stl"]);
    let arguments: Vec<&str> = line.split_whitespace().collect();
    let out = bench.command(&arguments).env("RAYON_NUM_THREADS", threads).output().expect("starts");
    let said = String::from_utf8_lossy(&out.stderr).into_owned();
    assert!(matches!(out.status.code(), Some(0 | 1)), "{line}: {said}");
    (out.status.code(), out.stdout, bench.files())
}

fn same_on_any_number_of_threads(lines: &[&str]) {
    same_on(&["2", "5"], lines);
}

/// The command lines do on so many threads what they do on one.
fn same_on(numbers: &[&str], lines: &[&str]) {
    for line in lines {
        let one = run(line, "1");
        let made = one.2.len();
        for threads in numbers {
            let several = run(line, threads);
            assert_eq!((several.0, several.2.len()), (one.0, made), "{line}");
            assert!(several.1 == one.1, "{line}: {threads} threads say something else");
            for (path, bytes) in &one.2 {
                assert!(several.2[path] == *bytes, "{line}: {} on {threads} threads", path.display());
            }
        }
    }
}

/// A tetrahedron with a notch: its base has a corner pushed inward.
const DENTED: &str = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nv 1 1 1\n\
    f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 5\nf 3 4 5\nf 4 2 5\n";

#[test]
#[ignore = "half a minute: .ci/run runs it"]
fn scores() {
    same_on_any_number_of_threads(&[
        "score in --error 0.02 -o t.csv",
        "score in --error 0.02 --json",
        "score tolkowsky cube --exact --error 0.02 --metrics wlr,aset_red,windowing,cos,dispersion_median",
        "score tolkowsky --tilt -20:20:10 --tilt-axis 45 --error 0.02 --metrics wlr,leakage -o t.jsonl",
        "score tolkowsky --polarisation off --error 0.02",
        "score tolkowsky --material ruby --size 6 --error 0.02",
        "score tolkowsky --observer 20 --seed 7 --metrics brightness,contrast --error 0.02",
        "score dented.obj --ri 1.76 --metrics wlr,leakage,brightness,aset_red --error 0.05 -o t.csv",
        "score dented.obj --material ruby --size 5 --metrics wlr,absorbed --error 0.05",
    ]);
}

#[test]
#[ignore = "half a minute: .ci/run runs it"]
fn studies() {
    same_on(
        &["5"],
        &[
            "sweep round-brilliant --vary crown-angle=30:38:4 --vary table=50:60:5 --metrics wlr,fire_streak \
         --error 0.02 -o t.csv --plot m.svg --plot c.png",
            "sweep oval --vary ri=1.5:2.4:0.1 --scatter 9 --metrics wlr --error 0.02 -o t.json",
            "compare tolkowsky octahedron --metrics wlr,leakage,fire_streak --error 0.02 --json",
            "validate --only leakage --json",
            "validate --only volume -o out",
            "import in -o out --to glb",
            "generate --facets 153 -o g.obj -o g.toml -o g.svg -o g.png -o g.glb -o g.gem",
            "show in/a.asc in/b.gem cube --json",
            "show tolkowsky --beams b.svg --diagram d.png",
        ],
    );
}

#[test]
#[ignore = "half a minute: .ci/run runs it"]
fn pictures() {
    let small = "-q --width 40 --height 30 --spp 4 --photons 3000 --nearest 50";
    let lines: Vec<String> = [
        "render --photon-map kept.map --passes -o p.png",
        "render -o p.exr",
        "render octahedron --scene cornell --bits 16 -o p.png",
        "render --scene spot --material ruby --size 6 --polarisation off -o p.png",
        "render octahedron --scene arrows --frames 3 --turn stone --rock -o a.gif",
        "render octahedron --frames 2 --turn light -o a.apng",
        "render --scene spot --glare -o glare.png",
        "render --scene office --progressive --rounds 3 -o rounds.exr",
    ]
    .iter()
    .map(|line| format!("{line} {small}"))
    .collect();
    same_on_any_number_of_threads(&lines.iter().map(String::as_str).collect::<Vec<_>>());
}

#[test]
#[ignore = "ten seconds: .ci/run runs it"]
fn a_report() {
    same_on(&["5"], &["report octahedron --width 96 --error 0.02 -o out"]);
}
