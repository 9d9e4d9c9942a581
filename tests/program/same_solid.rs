//! One solid, one answer: what is measured on a stone is the same whatever file it came in, and names
//! and weights are those of the stone.

use cutlab::advanced::design::families::{self, facet_summary};
use cutlab::advanced::design::measured_tiers;
use cutlab::advanced::design::proportions::{self, Proportions};
use cutlab::advanced::design::{Design, library};
use cutlab::advanced::formats::{self, FORMATS};
use cutlab::advanced::stone::Stone;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

fn cut(spec: &str) -> Design {
    Stone::parse(spec).and_then(Stone::into_design).unwrap_or_else(|e| panic!("{e}"))
}

/// Every measure with its name, lengths in parts of the width, and how far a file's digits may move it.
fn measures(p: &Proportions) -> Vec<(&'static str, f64, f64)> {
    let none = f64::NEG_INFINITY;
    let mut all = vec![
        ("facets", p.facets as f64, 0.0),
        ("length", p.length / p.width, 1e-5),
        ("table", p.table_percent.unwrap_or(none), 0.01),
        ("crown angle", p.crown_angle_deg.unwrap_or(none), 0.005),
        ("pavilion angle", p.pavilion_angle_deg.unwrap_or(none), 0.005),
        ("crown height", p.crown_height_percent, 0.01),
        ("pavilion depth", p.pavilion_depth_percent, 0.01),
        ("girdle", p.girdle_percent, 0.01),
        ("depth", p.depth_percent, 0.01),
        ("culet", p.culet_percent, 0.01),
        ("volume", p.volume / p.width.powi(3), 1e-5),
        ("surface", p.surface / p.width.powi(2), 1e-4),
        ("W", p.ratios.w / p.width, 1e-5),
        ("L/W", p.ratios.l_w, 1e-5),
        ("T/W", p.ratios.t_w.unwrap_or(none), 1e-4),
        ("P/W", p.ratios.p_w, 1e-4),
        ("C/W", p.ratios.c_w, 1e-4),
        ("H/W", p.ratios.h_w, 1e-4),
        ("order", p.symmetry.order as f64, 0.0),
        ("mirror", f64::from(u8::from(p.symmetry.mirror)), 0.0),
    ];
    if let Some(b) = p.brilliant {
        all.extend([("star", b.star_percent, 0.05), ("lower half", b.lower_half_percent, 0.05)]);
    }
    all.extend(p.by_zone.iter().map(|(zone, n)| (*zone, *n as f64, 0.0)));
    all
}

#[test]
fn every_cut_measures_alike_in_every_format() {
    let mut wrong = Vec::new();
    for name in library::names() {
        let design = cut(name);
        let before = proportions::of_design(&design).expect("closed");
        // angles in tenths of a degree, off the steps of stated angles, with numbers of facets
        let tiers = |d: &Design| -> Vec<(i64, usize)> {
            let tiers = measured_tiers::tiers(d, &d.solid().expect("closed"));
            let tenths = |angle: f64| (10.0 * (angle + 0.013)).round() as i64;
            let mut all: Vec<_> = tiers.iter().map(|t| (tenths(t.angle_deg), t.facets.len())).collect();
            all.sort_unstable();
            all
        };
        for format in FORMATS.iter().filter(|f| f.write.is_some()) {
            let bytes = formats::encode(&design, format.name).expect("is written");
            let back =
                formats::read_bytes("x", &bytes, None).unwrap_or_else(|e| panic!("{name}: {e}")).design;
            let after = proportions::of_design(&back).expect("closed");
            let (a, b) = (measures(&before), measures(&after));
            if a.len() != b.len() {
                wrong.push(format!("{name} as {}: brilliant or not", format.name));
            }
            for ((what, a, within), (_, b, _)) in a.iter().zip(&b) {
                if a != b && (a - b).abs() > *within {
                    wrong.push(format!("{name} as {}: {what} {a} became {b}", format.name));
                }
            }
            let (a, b) = (tiers(&design), tiers(&back));
            if a != b {
                wrong.push(format!("{name} as {}: tiers {a:?} became {b:?}", format.name));
            }
        }
    }
    assert!(wrong.is_empty(), "{} differ:\n{}", wrong.len(), wrong.join("\n"));
}

/// Extents follow the planes alone: what `show` says of them differs between formats by no more than their
/// digits, ten in text, seven in an STL; glTF says its lengths in metres, all of them.
#[test]
fn extents_differ_by_the_digits_of_a_format_alone() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for name in ["rose-cut", "barion-oval", "old-mine", "oval", "pear", "first-stone", "tolkowsky"] {
        let mut first: Option<[f64; 4]> = None;
        for (extension, within) in [
            ("toml", 0.0),
            ("asc", 3e-8),
            ("gem", 1e-12),
            ("gcs", 1e-12),
            ("obj", 1e-12),
            ("stl", 2e-6),
            ("glb", 2e-6),
        ] {
            let file = folder.path().join(format!("{name}.{extension}")).display().to_string();
            let run = |arguments: &[&str]| {
                let out = Command::new(env!("CARGO_BIN_EXE_cutlab")).args(arguments).output().expect("runs");
                assert!(out.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&out.stderr));
                out.stdout
            };
            run(&["generate", "-q", name, "-o", &file]);
            let sheet: serde_json::Value =
                serde_json::from_slice(&run(&["show", "-q", "--json", &file])).expect("JSON");
            let number = |value: &serde_json::Value| value.as_f64().expect("a number");
            let (sheet, ratios) = (&sheet[0], &sheet[0]["ratios"]);
            let width = number(&sheet["width"]);
            let sizes = [
                number(&sheet["length"]) / width,
                number(&ratios["w"]) / width,
                number(&ratios["l_w"]),
                number(&ratios["vol_w3"]),
            ];
            let before = first.get_or_insert(sizes);
            for (a, b) in sizes.iter().zip(before) {
                assert!((a / *b - 1.0).abs() <= within, "{name}.{extension}: {a} was {b}");
            }
        }
    }
}

/// The main angles of a fancy outline are those across its width, which its parameters are.
#[test]
fn the_main_angles_are_those_across_the_width() {
    for name in ["oval", "cushion", "marquise", "pear", "round-brilliant"] {
        for (crown, pavilion, length) in [(35.0, 41.0, 1.3), (31.5, 38.25, 1.7), (38.0, 43.0, 2.1)] {
            let mut values: BTreeMap<String, f64> =
                [("crown-angle".into(), crown), ("pavilion-angle".into(), pavilion)].into();
            if name != "round-brilliant" {
                values.insert("length-to-width".into(), length);
            }
            let design =
                library::design(name, &values).expect("a cut").unwrap_or_else(|e| panic!("{name}: {e}"));
            let p = proportions::of_design(&design).expect("closed");
            let (c, d) = (p.crown_angle_deg.expect("a crown"), p.pavilion_angle_deg.expect("a pavilion"));
            assert!((c - crown).abs() < 1e-6 && (d - pavilion).abs() < 1e-6, "{name} {length}: {c} {d}");
        }
    }
}

/// Turned about its axis the stone has the same angles: no axis of the file's is preferred.
#[test]
fn main_angles_do_not_depend_on_how_the_stone_is_turned() {
    for name in library::names() {
        let design = cut(name);
        let before = proportions::of_design(&design).expect("closed");
        for turn in [0.1, 0.7, 1.9] {
            let turned = design.clone().turned(glam::DMat3::from_rotation_z(turn));
            let after = proportions::of_design(&turned).expect("closed");
            for (a, b) in [
                (before.crown_angle_deg, after.crown_angle_deg),
                (before.pavilion_angle_deg, after.pavilion_angle_deg),
            ] {
                let same = a.zip(b).map_or(a == b, |(a, b)| (a - b).abs() < 1e-6);
                assert!(same, "{name} turned by {turn}: {a:?} {b:?}");
            }
        }
    }
}

#[test]
fn facets_of_one_name_on_both_sides_are_counted_apart() {
    let mut design = cut("classic");
    for tier in &mut design.tiers {
        tier.name = match &*tier.name {
            "table" => "T".into(),
            "girdle" => "G1".into(),
            "pavilion break" | "crown break" => "1".into(),
            _ => "2".into(),
        };
    }
    let (said, total) = facet_summary(&design).expect("closed");
    assert_eq!(total, 73);
    assert_eq!(
        said,
        "16 × \"1\" on the pavilion + 16 × \"G1\" + 8 × \"2\" on the pavilion + 16 × \"1\" on the crown + \
         16 × \"2\" on the crown + 1 × \"T\""
    );
    design.tiers.iter_mut().for_each(|t| t.name.clear());
    let (said, _) = facet_summary(&design).expect("closed");
    assert_eq!(said, "24 unnamed on the pavilion + 16 unnamed on the girdle + 33 unnamed on the crown");
    let (said, _) = facet_summary(&cut("round-brilliant")).expect("closed");
    assert!(said.starts_with("8 pavilion main + 16 lower half + 96 girdle"), "{said}");
}

#[test]
fn a_brilliant_can_be_given_as_a_grading_report_has_it() {
    let made = |spec: &str| proportions::of_design(&cut(spec)).expect("closed");
    let p = made("round-brilliant:depth=61.5,crown-height=15,pavilion-depth=43");
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-9, "{a} {b}");
    near(p.depth_percent, 61.5);
    near(p.crown_height_percent, 15.0);
    near(p.pavilion_depth_percent, 43.0);
    near(p.girdle_percent, 3.5);
    near(p.table_percent.expect("a table"), 56.0);
    // tan of the crown angle is its height over half of what the table leaves
    near(p.crown_angle_deg.expect("a crown"), (15.0f64 / 22.0).atan().to_degrees());
    // the table from angle and height
    near(
        made("round-brilliant:crown-angle=34,crown-height=14").table_percent.expect("a table"),
        100.0 - 28.0 / 34f64.to_radians().tan(),
    );
    // depth alone sets the girdle; with that given, the pavilion
    let p = made("round-brilliant:depth=60");
    near(p.depth_percent, 60.0);
    near(p.crown_angle_deg.expect("a crown"), 34.0);
    let p = made("round-brilliant:depth=60,girdle=2.5,culet=2");
    near(p.depth_percent, 60.0);
    near(p.girdle_percent, 2.5);
    let p = made("round-brilliant:depth=60,girdle=2.5,pavilion-angle=41");
    near(p.depth_percent, 60.0);
    near(p.pavilion_angle_deg.expect("a pavilion"), 41.0);
    // a height replaces what a cut of the library states
    near(made("tolkowsky:pavilion-depth=44").pavilion_depth_percent, 44.0);
    near(made("tolkowsky:pavilion-depth=44").table_percent.expect("a table"), 53.0);
    for name in ["oval", "cushion", "marquise", "pear"] {
        let p = made(&format!("{name}:crown-height=16,pavilion-depth=42"));
        assert!((p.crown_height_percent - 16.0).abs() < 0.1, "{name}: {}", p.crown_height_percent);
        assert!((p.pavilion_depth_percent - 42.0).abs() < 0.1, "{name}: {}", p.pavilion_depth_percent);
    }
    for (spec, said) in [
        ("round-brilliant:pavilion-depth=43,pavilion-angle=41", "pavilion-depth and pavilion-angle"),
        ("round-brilliant:table=56,crown-angle=34,crown-height=15", "leave one out"),
        ("round-brilliant:depth=50", "leaves no girdle"),
        ("round-brilliant:depth=60,girdle=3,pavilion-depth=43,crown-height=15", "leave one out"),
        ("round-brilliant:crown-height=-3", "crown-height = -3% is out of range"),
        ("prism:depth=60", "has no parameter 'depth'"),
        ("emerald:crown-height=15", "has no parameter 'crown-height'"),
        ("round-brilliant:crown-angle=34,crown-angle=35", "crown-angle is given twice"),
    ] {
        let error = Stone::parse(spec).map(|i| i.format()).expect_err(spec).to_string();
        assert!(error.contains(said), "{spec}: {error}");
    }
    assert!(families::family("step-cut").expect("a family").heights.is_empty());
}

/// A folder to work in.
struct Bench(tempfile::TempDir);

impl Bench {
    fn new() -> Bench {
        Bench(tempfile::tempdir().expect("a temporary folder"))
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn run(&self, arguments: &[&str]) -> (String, String) {
        let mut command = Command::new(env!("CARGO_BIN_EXE_cutlab"));
        let out = command.current_dir(self.0.path()).args(arguments).output().expect("runs");
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
        assert!(out.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&out.stderr));
        (text(out.stdout), text(out.stderr))
    }

    fn sheet(&self, arguments: &[&str]) -> serde_json::Value {
        let mut all = vec!["show", "--json"];
        all.extend(arguments);
        let (out, _) = self.run(&all);
        serde_json::from_str::<serde_json::Value>(&out).expect("JSON")[0].take()
    }
}

#[test]
fn show_says_the_same_of_every_file_of_a_stone() {
    let bench = Bench::new();
    for name in ["oval", "tolkowsky", "emerald", "princess"] {
        let own = bench.sheet(&[name, "--size", "7"]);
        let weighed = |sheet: &serde_json::Value| sheet["carats"].as_f64().expect("a weight");
        for extension in ["toml", "asc", "gem", "gcs", "obj", "stl", "ply", "glb", "gltf"] {
            let file = format!("{name}.{extension}");
            bench.run(&["-q", "generate", name, "-o", &file]);
            let sheet = bench.sheet(&[&file, "--size", "7"]);
            assert!((weighed(&sheet) / weighed(&own) - 1.0).abs() < 1e-5, "{file}");
            assert_eq!(sheet["weighed_as"], "diamond", "{file}");
            for key in ["crown_angle_deg", "pavilion_angle_deg", "table_percent", "girdle_percent"] {
                let (a, b) = (own[key].as_f64().expect(key), sheet[key].as_f64().expect(key));
                assert!((a - b).abs() < 0.01, "{file}: {key} {a} {b}");
            }
            assert_eq!(sheet["symmetry"]["order"], own["symmetry"]["order"], "{file}");
            assert_eq!(sheet["proportion_envelope"], own["proportion_envelope"], "{file}");
            let names = sheet["tiers"].as_array().expect("tiers").iter().flat_map(|t| t["facets"].as_array());
            assert!(names.flatten().all(|n| n != ""), "{file}: {}", sheet["tiers"]);
            // angles with their numbers of facets; a table has any
            let tiers = |sheet: &serde_json::Value| {
                let mut counts: BTreeMap<i64, usize> = BTreeMap::new();
                for tier in sheet["tiers"].as_array().expect("tiers") {
                    let angle = tier["angle_deg"].as_f64().expect("an angle");
                    let key = if angle.abs() > 89.9 { 9000 } else { (100.0 * angle).round() as i64 };
                    *counts.entry(key).or_default() += tier["facets"].as_array().expect("facets").len();
                }
                counts
            };
            assert_eq!(tiers(&sheet), tiers(&own), "{file}");
        }
    }
}

#[test]
fn a_stone_is_weighed_as_what_it_is_made_of() {
    let bench = Bench::new();
    let classic = bench.sheet(&["classic", "--size", "8"]);
    // a design for 1.54 is of quartz, not of diamond
    assert_eq!(classic["weighed_as"], "quartz");
    assert!((classic["carats"].as_f64().expect("a weight") - 1.697).abs() < 0.002, "{}", classic["carats"]);
    let asked = bench.sheet(&["classic", "--size", "8", "--material", "quartz"]);
    assert_eq!(asked["carats"], classic["carats"]);
    let (text, _) = bench.run(&["show", "classic", "--size", "8"]);
    assert!(text.contains("ct in quartz") && !text.contains("in diamond"), "{text}");
    let unknown = bench.sheet(&["round-brilliant", "--ri", "1.33"]);
    assert!(unknown["carats"].is_null() && unknown["weighed_as"].is_null());
    assert!(unknown["weight_note"].as_str().expect("a reason").contains("--material"), "{unknown}");
    // proportions are graded for diamonds alone
    let graded = |arguments: &[&str]| bench.run(arguments).0.contains("proportion envelope");
    assert!(graded(&["show", "tolkowsky"]) && graded(&["show", "tolkowsky", "--ri", "2.417"]));
    for arguments in
        [&["show", "tolkowsky", "--material", "quartz"][..], &["show", "tolkowsky", "--ri", "1.54"]]
    {
        assert!(!graded(arguments), "{arguments:?}");
    }
    let excellent = "round-brilliant:pavilion-angle=40.8";
    assert_eq!(bench.sheet(&[excellent])["proportion_envelope"], "Excellent");
    assert!(bench.sheet(&[excellent, "--material", "quartz"])["proportion_envelope"].is_null());
}

#[test]
fn a_stone_can_be_made_by_its_weight() {
    let bench = Bench::new();
    for (stone, material, density) in
        [("tolkowsky", None, 3.52), ("oval", Some("ruby"), 4.0), ("classic", None, 2.65)]
    {
        let mut arguments = vec![stone, "--carat", "1.5"];
        arguments.extend(material.iter().flat_map(|m| ["--material", m]));
        let sheet = bench.sheet(&arguments);
        assert!((sheet["carats"].as_f64().expect("a weight") - 1.5).abs() < 1e-9, "{sheet}");
        let volume = sheet["volume_mm3"].as_f64().expect("a volume");
        assert!((volume * density / 200.0 / 1.5 - 1.0).abs() < 0.01, "{volume}");
        let file = format!("{stone}.stl");
        let mut made = vec!["generate", stone, "--carat", "1.5", "-o", file.as_str()];
        made.extend(material.iter().flat_map(|m| ["--material", m]));
        let (_, said) = bench.run(&made);
        let stl = formats::read(&bench.path(&file)).expect("is read").design;
        let written = stl.solid().expect("closed").volume();
        assert!((written / volume - 1.0).abs() < 1e-4, "{stone}: {written} {volume}");
        assert!(said.contains("1.5 ct"), "{said}");
    }
}

#[test]
fn the_librarys_own_files_are_printed_by_the_program() {
    let bench = Bench::new();
    let (text, _) = bench.run(&["list", "cuts", "classic"]);
    assert!(text.contains("meets = \"pavilion break@3"), "{text}");
    std::fs::write(bench.path("mine.toml"), &text).expect("writes");
    let own = formats::read(&bench.path("mine.toml")).expect("is read").design;
    assert_eq!(own.planes(), cut("classic").planes());
    for name in library::names() {
        let (text, _) = bench.run(&["list", "cuts", name]);
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("cuts").join(name).with_extension("toml");
        assert_eq!(text.trim_end(), std::fs::read_to_string(file).expect("reads").trim_end(), "{name}");
    }
}
