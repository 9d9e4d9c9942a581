//! Closed meshes that are no convex stone: shown, and written as meshes, by the program itself.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A folder of its own for a test, and the program run in it.
struct Bench(tempfile::TempDir);

impl Bench {
    fn new() -> Bench {
        Bench(tempfile::tempdir().expect("a temporary folder"))
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn run(&self, arguments: &[&str]) -> Output {
        let mut program = Command::new(env!("CARGO_BIN_EXE_cutlab"));
        program.args(arguments).current_dir(self.0.path()).output().expect("the program starts")
    }

    fn good(&self, arguments: &[&str]) -> String {
        let out = self.run(arguments);
        assert_eq!(out.status.code(), Some(0), "{arguments:?}: {}", text(&out.stderr));
        text(&out.stdout)
    }

    /// Runs a command that must fail for want of good input; its line on standard error.
    fn bad(&self, arguments: &[&str]) -> String {
        let out = self.run(arguments);
        assert_eq!(out.status.code(), Some(2), "{arguments:?}: {}", text(&out.stderr));
        assert_eq!(text(&out.stderr).trim_end().lines().count(), 1, "{arguments:?}");
        text(&out.stderr)
    }
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

fn json(text: &str) -> serde_json::Value {
    serde_json::from_str(text).expect("JSON")
}

fn near(value: &serde_json::Value, expected: f64, tolerance: f64) -> bool {
    value.as_f64().is_some_and(|v| (v - expected).abs() <= tolerance)
}

#[test]
fn show_tells_what_it_can_of_a_mesh_with_a_dent() {
    let bench = Bench::new();
    let dented = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/bad/dented.obj");
    let dented = dented.display().to_string();
    let sheet = &json(&bench.good(&["show", "--json", &dented]))[0];
    assert_eq!((&sheet["closed"], &sheet["convex"]), (&true.into(), &false.into()), "{sheet}");
    assert!(sheet["facets"].as_u64().is_some_and(|n| n > 4) && sheet["box"].is_array(), "{sheet}");
    assert!(sheet["volume"].as_f64().is_some_and(|v| v > 0.0), "{sheet}");
    assert!(bench.good(&["show", &dented]).contains("convex          no"));
    assert!(bench.bad(&["score", &dented]).contains("not convex"));
}

#[test]
fn a_mesh_that_is_no_convex_stone_is_written_as_a_mesh() {
    let bench = Bench::new();
    let bad = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/bad");
    for (file, said, parts) in [("dented.obj", "not convex", 1), ("two-stones.obj", "2 separate closed", 2)] {
        let file = bad.join(file).display().to_string();
        let plain = json(&bench.good(&["show", "--json", &file]))[0].clone();
        for format in ["obj", "stl", "stl-text", "ply", "ply-text", "glb", "gltf", "cs580", "sc-tracer"] {
            let out = bench.run(&["import", &file, "-o", "x", "--to", format, "--force"]);
            assert_eq!(out.status.code(), Some(0), "{format}: {}", text(&out.stderr));
            assert!(text(&out.stderr).contains(said), "{format}: {}", text(&out.stderr));
            let written = std::fs::read_dir(bench.path("x")).expect("a folder").next().expect("a file");
            let written = written.expect("listed").path();
            let again = &json(&bench.good(&["show", "--json", &written.display().to_string()]))[0];
            assert_eq!((&again["parts"], &again["format"]), (&parts.into(), &format.into()), "{again}");
            for key in ["facets", "triangles", "closed", "convex"] {
                assert_eq!(plain[key], again[key], "{format}: {key}");
            }
            let volume = plain["volume"].as_f64().expect("a volume");
            assert!(near(&again["volume"], volume, 1e-6 * volume), "{format}: {again}");
            std::fs::remove_file(written).expect("removes");
        }
        assert!(bench.bad(&["import", &file, "-o", "x.asc"]).contains("try obj, stl"));
    }
    let open = bad.join("open.obj").display().to_string();
    assert!(bench.bad(&["import", &open, "-o", "x.obj"]).contains("3 edges are not shared"));
}
