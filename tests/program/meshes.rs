//! Meshes: what is written has no gap and no triangle without area; closed meshes that are no convex
//! stone are shown, and written as meshes.

use cutlab::advanced::design::{Facet, Tier, library};
use cutlab::advanced::formats::MeshExport;
use cutlab::advanced::geometry::Plane;
use glam::DVec3;
use std::collections::HashMap;
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
}

/// Its sums of power add up; scores that ask for the strongest path, or the solid, have no value.
#[test]
fn a_mesh_with_a_dent_is_scored_as_far_as_it_can_be() {
    let bench = Bench::new();
    let bad = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/bad");
    let dented = bad.join("dented.obj").display().to_string();
    let table = bench.good(&["score", &dented, "--size", "5", "--material", "ruby"]);
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let heads = reader.headers().expect("a header").clone();
    let row = reader.records().next().expect("a row").expect("a row");
    let cell = |name: &str| heads.iter().position(|h| h == name).map_or("", |i| &row[i]);
    let number = |name: &str| cell(name).parse::<f64>().unwrap_or(f64::NAN);
    let sum: f64 = ["light_return", "glare", "leakage", "absorbed", "lost"].map(number).iter().sum();
    assert!((sum - 1.0).abs() < 1e-6, "{table}");
    assert!(number("absorbed") > 0.0 && number("brightness") > 0.0 && number("wlr_se") > 0.0, "{table}");
    assert_eq!(cell("facets").parse().ok(), Some(8), "{table}");
    for name in ["leakage_strongest", "windowing", "extinction", "iso", "weight_ratio"] {
        assert_eq!(cell(name), "", "{name}: {table}");
    }
    assert!(cell("error").contains("left out: not known for stones that are not convex"), "{table}");
    let out = bench.run(&["score", &dented, "--metrics", "iso,windowing"]);
    assert_eq!(out.status.code(), Some(2));
    assert!(text(&out.stderr).contains("none of the scores asked for"), "{}", text(&out.stderr));
    let two = bad.join("two-stones.obj").display().to_string();
    let out = bench.run(&["score", &two, "--metrics", "wlr"]);
    assert_eq!(out.status.code(), Some(2));
    assert!(text(&out.stderr).contains("2 separate closed"), "{}", text(&out.stderr));
}

/// Pages show proportions, a cutting diagram and a scene, which only convex stones have: a mesh with a dent is
/// refused before anything is made, in one line that says what takes it.
#[test]
fn a_page_of_a_mesh_with_a_dent_is_refused_with_what_takes_it() {
    let bench = Bench::new();
    let dented = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/bad/dented.obj");
    let dented = dented.display().to_string();
    for (command, what) in [
        (["report", &dented, "-o", "out"].as_slice(), "a report needs one"),
        (["compare", "tolkowsky", &dented, "-o", "out"].as_slice(), "a comparison needs one"),
    ] {
        let said = bench.bad(command);
        assert_eq!(said.lines().count(), 1, "{said}");
        assert!(
            said.contains("not convex") && said.contains(what) && said.contains("cutlab score"),
            "{said}"
        );
        assert!(!bench.path("out").exists(), "nothing is made");
    }
}

#[test]
fn a_mesh_that_is_no_convex_stone_is_written_as_a_mesh() {
    let bench = Bench::new();
    let bad = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/bad");
    for (file, said, parts) in [("dented.obj", "not convex", 1), ("two-stones.obj", "2 separate closed", 2)] {
        let file = bad.join(file).display().to_string();
        let plain = json(&bench.good(&["show", "--json", &file]))[0].clone();
        // glTF's unit is the metre: a stone of unknown size is written 6.5 mm wide
        bench.good(&["import", &file, "--size", "6.5", "-o", "sized.obj", "--force"]);
        let sized = json(&bench.good(&["show", "--json", "sized.obj"]))[0].clone();
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
            let of_its_size = if format.starts_with("gl") { &sized } else { &plain };
            let volume = of_its_size["volume"].as_f64().expect("a volume");
            assert!(near(&again["volume"], volume, 1e-6 * volume), "{format}: {again}");
            std::fs::remove_file(written).expect("removes");
        }
        assert!(bench.bad(&["import", &file, "-o", "x.asc"]).contains("try obj, stl"));
    }
    let open = bad.join("open.obj").display().to_string();
    assert!(bench.bad(&["import", &open, "-o", "x.obj"]).contains("3 edges are not shared"));
}

/// What `tools/check_meshes.py` asks of an independent reader, of the surface that is written.
fn assert_sound(what: &str, surface: &MeshExport) {
    let mut edges: HashMap<(usize, usize), usize> = HashMap::new();
    for (facet, t) in &surface.triangles {
        let [a, b, c] = t.map(|i| surface.vertices[i].as_vec3());
        let area = (b - a).cross(c - a);
        assert!(area.length() > 0.0, "{what}: a triangle without area in f32");
        assert!(area.as_dvec3().dot(surface.facets[*facet].1) > 0.0, "{what}: a triangle faces inward");
        (0..3).for_each(|i| *edges.entry((t[i], t[(i + 1) % 3])).or_default() += 1);
    }
    for (&(a, b), &times) in &edges {
        assert!(times == 1 && edges.get(&(b, a)) == Some(&1), "{what}: edge {a}–{b}");
    }
    let corners = surface.polygons.iter().map(|(_, p)| p.len()).sum::<usize>();
    let triangles: usize = surface.polygons.iter().map(|(_, p)| p.len() - 2).sum();
    assert_eq!(triangles, surface.triangles.len(), "{what}");
    // V − E + F
    assert_eq!(surface.vertices.len() + surface.polygons.len(), corners / 2 + 2, "{what}");
}

#[test]
fn what_is_written_of_every_cut_has_no_gap_and_no_empty_triangle() {
    let drawn = library::names()
        .filter(|n| cutlab::advanced::stone::Stone::parse(format!("{n}:length-to-width=2")).is_ok());
    let specs = library::names().map(String::from).chain(drawn.map(|n| format!("{n}:length-to-width=2")));
    for spec in specs {
        let design = cutlab::advanced::stone::Stone::parse(&spec)
            .and_then(cutlab::advanced::stone::Stone::into_design)
            .unwrap_or_else(|e| panic!("{e}"));
        let facets = design.facets().count();
        let surface = MeshExport::from_design(&design, None).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(surface.facets.len(), facets, "{spec}: a facet is too small to be written");
        let corners = design.solid().expect("closed").vertices.len();
        assert_eq!(surface.vertices.len(), corners, "{spec}: facets miss the corner they should meet in");
        assert_sound(&spec, &surface);
    }
}

/// A table whose distance has nine decimals passes the point of a pyramid 1e-9 below it: no corner
/// of the four that it cuts is as far from the next as `f32` can tell.
#[test]
fn corners_that_nearly_meet_are_written_as_one() {
    let mut design = cutlab::advanced::stone::Stone::parse("octahedron")
        .and_then(cutlab::advanced::stone::Stone::into_design)
        .expect("a library cut");
    let top = design.solid().expect("closed").bounds().1.z;
    let plane = Plane { normal: DVec3::Z, distance: top * (1.0 - 1e-9) };
    let facet = Facet { name: "table".into(), index: None, plane };
    let (name, instructions) = ("table".to_string(), String::new());
    design.tiers.push(Tier { name, angle_deg: Some(0.0), instructions, facets: vec![facet] });
    assert_eq!(design.solid().expect("closed").faces.len(), 9);
    let surface = MeshExport::from_design(&design, None).expect("is written");
    assert_eq!((surface.polygons.len(), surface.vertices.len()), (8, 6));
    assert_sound("octahedron", &surface);
}
