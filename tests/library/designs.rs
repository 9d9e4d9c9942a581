//! Design files: what GemCad's two forms and Gem Cut Studio's keep of a design, in both directions.

use cutlab::advanced::design::{Design, Facet, Gear, Tier};
use cutlab::advanced::formats::{self, Loaded};
use cutlab::advanced::geometry::Plane;
use cutlab::advanced::stone::Stone;
use glam::DVec3;
use std::path::Path;

/// The formats that hold tiers.
const DESIGN_FORMATS: [&str; 4] = ["cutlab", "gemcad", "gemcad-binary", "gem-cut-studio"];

fn good(name: &str) -> Loaded {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/good").join(name);
    formats::read(&path).unwrap_or_else(|error| panic!("{error}"))
}

fn back(design: &Design, format: &str) -> Loaded {
    let bytes = formats::encode(design, format).unwrap_or_else(|e| panic!("{e}"));
    formats::read_bytes("back", &bytes, None).unwrap_or_else(|e| panic!("{format}: {e}"))
}

/// The largest difference of two designs' planes, facet by facet: of their normals, and of their
/// distances from the middle in parts of the size, because each format has a frame of its own.
fn off(a: &Design, b: &Design) -> f64 {
    assert_eq!(a.facets().count(), b.facets().count());
    let frame = |d: &Design| {
        let solid = d.solid().expect("closed");
        (solid.volume_and_centre().1, solid.volume().cbrt())
    };
    let ((middle, size), (other_middle, other_size)) = (frame(a), frame(b));
    let gap = |(p, q): (&Facet, &Facet)| {
        let apart =
            p.plane.signed_distance(middle) / size - q.plane.signed_distance(other_middle) / other_size;
        p.plane.normal.distance(q.plane.normal).max(apart.abs())
    };
    a.facets().zip(b.facets()).map(gap).fold(0.0, f64::max)
}

/// The volume in parts of the cubed width, which no frame changes.
fn shape(design: &Design) -> f64 {
    let solid = design.solid().expect("closed");
    solid.volume() / solid.width().powi(3)
}

fn indices(tier: &Tier) -> Vec<f64> {
    tier.facets.iter().filter_map(|f| f.index).collect()
}

#[test]
fn the_binary_form_says_what_the_text_says() {
    let text = good("square.asc").design;
    for (name, format) in [
        ("square.gem", "gemcad-binary"),
        ("square-no-offset.gem", "gemcad-binary"),
        ("square-clockwise.gem", "gemcad-binary"),
        ("square.gcs", "gem-cut-studio"),
        ("square-by-corners.gcs", "gem-cut-studio"),
        ("square-by-index.gcs", "gem-cut-studio"),
    ] {
        let other = good(name);
        assert_eq!(other.format, format);
        let design = &other.design;
        assert!(off(&text, design) < 1e-14, "{name}: {:e}", off(&text, design));
        assert_eq!(design.refractive_index, Some(1.54));
        // in Gem Cut Studio symmetry is the state of the window, not of the design
        assert_eq!(design.symmetry, (format != "gem-cut-studio").then_some((4, true)), "{name}");
        for (a, b) in text.tiers.iter().zip(&design.tiers) {
            assert_eq!((&a.name, &a.instructions, a.angle_deg), (&b.name, &b.instructions, b.angle_deg));
            // a clockwise wheel that begins at the far side numbers the other way from half a turn on
            let turned = |i: f64| if name.contains("clockwise") { 48.0 - i } else { i };
            let teeth = |t: &Tier, to: &dyn Fn(f64) -> f64| -> Vec<f64> {
                indices(t).into_iter().map(|i| to(i).rem_euclid(96.0)).collect()
            };
            assert!(a.name == "T" || teeth(a, &|i| i) == teeth(b, &turned), "{name} {}", a.name);
        }
    }
    let binary = good("square.gem").design;
    assert_eq!(indices(&binary.tiers[1]), [96.0, 24.0, 48.0, 72.0]);
    let names: Vec<_> = binary.tiers[1].facets.iter().map(|f| f.name.as_str()).collect();
    assert_eq!(names, ["G", "1", "a", "F"]);
    assert_eq!(binary.headers, ["Square test stone", "written for these tests", "", "François’ 40°"]);
    assert_eq!(binary.footers, ["one footnote"]);
    let wild = good("square-no-offset.gem");
    assert!(wild.warnings[0].contains("preform"), "{:?}", wild.warnings);
    assert_eq!(wild.design.tiers.len(), 4);
    assert_eq!(good("square-clockwise.gem").design.gear, Gear { teeth: -96.0, offset: 48.0 });
}

#[test]
fn a_gcs_file_says_what_of_it_was_left_out() {
    let square = good("square.gcs");
    assert_eq!(square.design.headers, ["Square test stone", "written for these tests", "", "A. Cutter"]);
    let said = square.warnings.join("\n");
    assert!(said.contains("'guide': a guide") && said.contains("'hidden': a guide"), "{said}");
    assert_eq!(good("square-by-index.gcs").design.name, "François’ 40°");
    for name in ["empty.gcs", "empty.asc", "empty"] {
        let error = formats::read_bytes(name, b"", None).map(|i| i.format).expect_err("nothing");
        assert_eq!(error.to_string(), format!("{name}: the file is empty"));
    }
}

#[test]
fn tiers_names_and_texts_survive_in_every_design_format() {
    let mut design = good("square.asc").design;
    design.headers = ["One & <two>", "\"three\"", "vier °", "five"].map(String::from).into();
    design.name = design.headers[0].clone();
    design.footers = vec!["first".into(), "second".into()];
    design.gear = Gear { teeth: -96.0, offset: 48.0 };
    for tier in &mut design.tiers {
        let angle = tier.angle_deg.expect("an angle");
        for f in &mut tier.facets {
            f.index = f.index.map(|i| i - 0.5);
            f.plane.normal =
                cutlab::advanced::design::tiers::facet_normal(design.gear, angle, f.index.expect("an index"));
        }
    }
    design.tiers[1].instructions = "Cut to a point. ".repeat(60).trim().into();
    for format in DESIGN_FORMATS {
        let other = back(&design, format).design;
        assert!(off(&design, &other) < 1e-14, "{format}: {:e}", off(&design, &other));
        assert_eq!(other.headers, design.headers, "{format}");
        assert_eq!(other.footers, design.footers, "{format}");
        assert_eq!(other.name, design.name, "{format}");
        // Gem Cut Studio's file has the wheel's teeth; where they begin, and symmetry, are its window's state
        let is_gcs = format == "gem-cut-studio";
        let offset = if is_gcs { 0.0 } else { design.gear.offset };
        assert_eq!(other.gear, Gear { offset, ..design.gear }, "{format}");
        assert_eq!(other.symmetry, design.symmetry.filter(|_| !is_gcs), "{format}");
        let from_offset = |i: f64| if is_gcs { (i - design.gear.offset).rem_euclid(96.0) } else { i };
        assert_eq!(other.refractive_index, design.refractive_index, "{format}");
        for (a, b) in design.tiers.iter().zip(&other.tiers) {
            assert_eq!((&a.name, a.angle_deg), (&b.name, b.angle_deg), "{format}");
            let flat = a.angle_deg == Some(0.0);
            let meant: Vec<f64> = indices(a).into_iter().map(from_offset).collect();
            assert!(flat || meant == indices(b), "{format}: {meant:?} {:?}", indices(b));
            assert!(a.instructions.starts_with(&*b.instructions));
            assert!(a.instructions == b.instructions || format == "gemcad-binary", "{format}");
            let names = |t: &Tier| t.facets.iter().map(|f| f.name.clone()).collect::<Vec<_>>();
            assert!(is_gcs || names(a) == names(b), "{format}");
        }
    }
}

#[test]
fn gemcad_text_is_written_as_gemcad_reads_it() {
    let mut design = Stone::parse("round-brilliant").and_then(Stone::into_design).expect("a library cut");
    design.headers = (1..=6).map(|i| format!("header {i}")).collect();
    design.tiers[0].instructions = "a word ".repeat(120);
    for tier in &mut design.tiers {
        tier.facets.iter_mut().enumerate().for_each(|(i, f)| f.name = format!("a long name {i}"));
    }
    let bytes = formats::encode(&design, "asc").expect("is written");
    let text = String::from_utf8(bytes).expect("ASCII");
    assert!(text.split("\r\n").all(|line| line.len() < 512 && !line.contains('\n')));
    assert!(text.ends_with("\r\n"));
    let heads: Vec<_> = text.split("\r\n").filter(|l| l.starts_with("H ")).collect();
    assert_eq!(heads, ["H header 1", "H header 2", "H header 3", "H header 4 header 5 header 6"]);
    // instructions follow the indices, on lines that go on indented, as GemCad itself breaks them
    assert!(text.split("\r\n").any(|l| l.starts_with(" G a word a word")));
    assert!(text.split("\r\n").any(|l| l.starts_with(' ') && !l.starts_with(" G")));
    let other = back(&design, "gemcad").design;
    assert!(off(&design, &other) < 1e-9);
    assert_eq!(other.tiers[0].instructions, design.tiers[0].instructions.trim());
    assert_eq!(other.tiers[0].facets[3].name, "a-long-name-3");
    // what Windows-1252 cannot hold is UTF-8
    design.headers = vec!["α".into()];
    assert_eq!(back(&design, "gemcad").design.name, "α");
}

#[test]
fn a_mesh_gets_angles_and_indices_from_its_normals() {
    let mesh = good("octahedron.obj").design;
    assert!(mesh.facets().all(|f| f.index.is_none()));
    for format in DESIGN_FORMATS {
        let other = back(&mesh, format).design;
        assert!((shape(&other) / shape(&mesh) - 1.0).abs() < 1e-8, "{format}");
        if format != "cutlab" {
            let mut all: Vec<f64> = other.facets().filter_map(|f| f.index).collect();
            all.sort_by(f64::total_cmp);
            assert_eq!(all, [12.0, 12.0, 36.0, 36.0, 60.0, 60.0, 84.0, 84.0], "{format}");
        }
    }
}

#[test]
fn a_design_whose_origin_lies_outside_is_moved_for_gemcad() {
    let mut design = Stone::parse("octahedron").and_then(Stone::into_design).expect("a library cut");
    let before = shape(&design);
    for f in design.tiers.iter_mut().flat_map(|t| &mut t.facets) {
        f.plane = f.plane.moved(DVec3::new(0.0, 0.0, 100.0));
    }
    assert!(design.facets().any(|f| f.plane.distance < 0.0));
    for format in DESIGN_FORMATS {
        let after = shape(&back(&design, format).design);
        assert!((after / before - 1.0).abs() < 1e-8, "{format}");
    }
}

#[test]
fn table_and_culet_at_any_distance_keep_their_sides() {
    let mut design = Design::new("box");
    let gear = Gear::default();
    design.tiers = vec![
        Tier::new("G", gear, -90.0, 1.0, &[96.0, 24.0, 48.0, 72.0]),
        Tier::new("C", gear, -0.0, 0.5, &[96.0]),
        Tier::new("T", gear, 0.0, 0.0, &[96.0]),
    ];
    for format in DESIGN_FORMATS {
        let other = back(&design, format).design;
        let solid = other.solid().expect("closed");
        assert!((solid.volume() - 2.0).abs() < 1e-12, "{format}");
        let down = |p: &Plane| p.normal == DVec3::NEG_Z;
        assert_eq!(other.planes().iter().filter(|p| down(p)).count(), 1, "{format}");
    }
}
