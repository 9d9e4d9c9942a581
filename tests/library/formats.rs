//! Formats: what is written reads back to the same planes, good files are read, bad ones are
//! refused in one line that says where and why, and no bytes at all make a reader panic.

use cutlab::advanced::design::{Design, LengthUnit};
use cutlab::advanced::formats::{self, FORMATS, Loaded};
use cutlab::advanced::geometry::Plane;
use cutlab::advanced::geometry::polyhedron::PlaneStatus;
use cutlab::advanced::stone::Stone;
use glam::{DMat3, DVec3};
use std::fs;
use std::path::{Path, PathBuf};

const STONES: [&str; 9] = [
    "round-brilliant",
    "round-brilliant:facets=73",
    "round-brilliant:culet=1",
    "round-brilliant:crown-angle=0",
    "octahedron",
    "original-brilliant",
    "tolkowsky",
    "prism:sides=3",
    "prism:sides=7",
];

fn data(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(folder);
    let mut files: Vec<_> = fs::read_dir(folder)
        .expect("tests/data is part of the package")
        .map(|e| e.expect("and can be listed").path())
        .collect();
    files.sort();
    files
}

fn good(name: &str) -> Loaded {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/good").join(name);
    formats::read(&path).unwrap_or_else(|error| panic!("{error}"))
}

/// Names and planes of the facets that bound the stone.
fn standing(design: &Design) -> Vec<(String, Plane)> {
    let solid = design.solid().expect("a closed stone");
    let facets =
        design.facets().zip(&solid.plane_status).filter(|(_, fate)| matches!(fate, PlaneStatus::Facet(_)));
    facets.map(|(f, _)| (f.name.clone(), f.plane)).collect()
}

/// The largest difference of a normal or of a distance from the stone's centre in parts of its size,
/// every facet matched with the one of the nearest normal: design formats have a size and an origin of
/// their own.
fn farthest(a: &Design, b: &Design) -> f64 {
    let frame = |d: &Design| {
        let solid = d.solid().expect("a closed stone");
        (solid.volume_and_centre().1, solid.volume().cbrt())
    };
    let ((middle, size), (other_middle, other_size)) = (frame(a), frame(b));
    let others = standing(b);
    let mut worst: f64 = 0.0;
    for (_, p) in standing(a) {
        let gap = |q: &Plane| q.normal.distance(p.normal);
        let (_, q) = others.iter().min_by(|(_, x), (_, y)| gap(x).total_cmp(&gap(y))).expect("a facet");
        let height = |p: &Plane, middle, size: f64| -p.signed_distance(middle) / size;
        let off = height(&p, middle, size) - height(q, other_middle, other_size);
        worst = worst.max(gap(q)).max(off.abs());
    }
    worst
}

#[test]
fn what_is_written_reads_back_to_the_same_planes() {
    for format in FORMATS.iter().filter(|f| f.write.is_some()) {
        let in_f32 = ["stl", "stl-text", "glb", "gltf", "sc-tracer", "cs580"].contains(&format.name);
        // GemCad text has ten significant digits
        let allowed = if in_f32 {
            1e-6
        } else if format.name == "gemcad" {
            1e-9
        } else {
            1e-12
        };
        for spec in STONES {
            let design = Stone::parse(spec).and_then(Stone::into_design).expect("a library stone");
            let bytes = formats::encode(&design, format.name).expect("every stone can be written");
            let back = formats::read_bytes("back", &bytes, None).unwrap_or_else(|e| panic!("{spec}: {e}"));
            assert_eq!(back.format, format.name);
            let (before, after) = (standing(&design), standing(&back.design));
            assert_eq!(before.len(), after.len(), "{spec} as {}", format.name);
            let off = farthest(&design, &back.design);
            println!("{spec} as {}: {off:.1e}", format.name);
            assert!(off <= allowed, "{spec} as {}: planes off by {off:e}", format.name);
            if ["obj", "glb", "gltf", "ply", "ply-text"].contains(&format.name) {
                let names = |f: Vec<(String, Plane)>| {
                    let mut names: Vec<_> = f.into_iter().map(|(n, _)| n).collect();
                    names.sort();
                    names
                };
                let own = names(before);
                assert!(own.iter().any(String::is_empty) || own == names(after), "{spec}: names are kept");
            }
        }
    }
}

#[test]
fn a_file_is_written_by_its_extension_and_read_by_its_bytes() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let design = Stone::parse("prism:sides=5").and_then(Stone::into_design).expect("a library stone");
    for format in FORMATS.iter().filter(|f| f.write.is_some()) {
        let path = folder.path().join("stone").with_extension(format.extensions[0]);
        formats::write(&design, &path).expect("is written");
        let misnamed = folder.path().join("stone.asc");
        fs::rename(&path, &misnamed).expect("is renamed");
        // of several formats with one extension the first is written
        let written =
            FORMATS.iter().find(|f| f.write.is_some() && f.extensions.contains(&format.extensions[0]));
        assert_eq!(Some(formats::read(&misnamed).expect("is read").format), written.map(|f| f.name));
    }
    let error = formats::write(&design, &folder.path().join("stone.doc")).expect_err("no such format");
    assert!(
        error.to_string().ends_with(
            "its extension must be one of toml, asc, gem, gcs, obj, stl, ply, glb, gltf; \
             cutlab generate also draws diagrams (.svg, .pdf, .png)"
        ),
        "{error}"
    );
}

#[test]
fn good_files_are_read() {
    for path in data("good") {
        let extension = path.extension().unwrap_or_default();
        if extension == "bin" {
            continue;
        }
        let stone = formats::read(&path).unwrap_or_else(|error| panic!("{error}"));
        assert!(stone.design.solid().expect("closed").volume() > 0.0, "{}", path.display());
    }
}

#[test]
fn bad_files_are_refused_with_the_line_they_expect() {
    for path in data("bad") {
        let bytes = fs::read(&path).expect("a test file");
        let text = String::from_utf8_lossy(&bytes);
        let (_, rest) = text.split_once("expect: ").expect("a bad file says what it expects");
        let expected = rest.split(['\n', '\r']).next().unwrap_or_default();
        let expected =
            if text.starts_with('{') { expected.split('"').next().unwrap_or_default() } else { expected };
        let error =
            formats::read(&path).map(|i| i.format).expect_err(&path.display().to_string()).to_string();
        assert!(error.contains(expected), "{error}\nexpected: {expected}");
        // a file that it refers to is named in its stead
        let named = error.contains(&path.display().to_string()) || expected == "cannot read";
        assert!(named && !error.contains('\n'), "{error}");
    }
}

#[test]
fn gemcad_text_is_understood_in_all_its_dialects() {
    let square = good("square.asc").design;
    assert_eq!(square.name, "Square test stone");
    assert_eq!((square.symmetry, square.refractive_index), (Some((4, true)), Some(1.54)));
    assert_eq!(square.footers, ["one footnote"]);
    let pavilion: Vec<_> = square.tiers[1].facets.iter().map(|f| f.name.as_str()).collect();
    assert_eq!(pavilion, ["G", "1", "a", "F"]);
    assert_eq!(square.tiers[1].instructions, "Cut to a point.");
    assert_eq!(square.tiers[2].instructions, "Level the girdle.");
    assert_eq!(square.tiers[2].facets.len(), 4);
    for name in ["square-old-mac.asc", "square-windows.asc", "square-no-gear-letter.asc", "square-loose.asc"]
    {
        let other = good(name);
        assert_eq!(other.design.planes(), square.planes(), "{name}");
        assert_eq!(other.format, "gemcad");
    }
    assert_eq!(good("square-windows.asc").design.headers[1], "François’ 40° stone");
    assert_eq!(good("square-loose.asc").warnings.len(), 1);
    assert!(farthest(&square, &good("square-clockwise.asc").design) < 1e-15);
    // a clockwise wheel is the mirror image, which its indices undo
    let wheel = good("square-clockwise.asc").design.gear;
    assert_eq!(wheel.teeth, -96.0);

    let culet = good("culet-by-distance.asc").design;
    assert_eq!(culet.tiers[2].facets[0].plane, Plane { normal: DVec3::NEG_Z, distance: 0.55 });
    assert_eq!(culet.tiers[4].facets[0].plane, Plane { normal: DVec3::Z, distance: 0.5 });
    let flat = good("culet-by-token.asc");
    assert_eq!(flat.design.tiers[1].facets[0].plane.normal, DVec3::NEG_Z);
    assert!(flat.warnings[0].contains("culet"), "{:?}", flat.warnings);
}

#[test]
fn meshes_come_back_as_facets() {
    let volume = |i: &Loaded| i.design.solid().expect("closed").volume();
    for (name, facets, expected) in [
        ("octahedron.obj", 8, 4.0 / 3.0),
        ("octahedron-text.stl", 8, 4.0 / 3.0),
        ("octahedron-binary.stl", 8, 4.0 / 3.0),
        ("octahedron-text.ply", 8, 4.0 / 3.0),
        ("octahedron-big.ply", 8, 4.0 / 3.0),
        // 4 m wide, as no stone is: its own numbers count
        ("octahedron.gltf", 8, 32.0 / 3.0),
        ("octahedron-beside.gltf", 8, 32.0 / 3.0),
        ("scene-full.asc", 8, 4.0 / 3.0),
        ("scene-no-token.asc", 8, 4.0 / 3.0),
        ("scene-no-emission.asc", 8, 4.0 / 3.0),
        ("cs580.asc", 8, 4.0 / 3.0),
        ("stone.pbrt", 8, 32.0 / 3.0),
        ("two-shapes.pbrt", 8, 4.0 / 3.0),
        ("list-from-0.txt", 8, 4.0 / 3.0),
        ("list-from-1.txt", 8, 4.0 / 3.0),
        ("list-letters-from-0.txt", 8, 4.0 / 3.0),
        ("cube-mixed-winding.obj", 6, 1.0),
        ("cube.toml", 6, 216.0),
    ] {
        let stone = good(name);
        assert_eq!(stone.design.facets().count(), facets, "{name}");
        assert!((volume(&stone) / expected - 1.0).abs() < 1e-6, "{name}: {}", volume(&stone));
    }
    assert!(good("octahedron.obj").design.facets().any(|f| f.name == "facet 5"));
    let scene = good("octahedron.gltf");
    assert!(scene.warnings[0].contains("points or lines"), "{:?}", scene.warnings);
    assert!(scene.warnings[1].contains("4.000 m wide"), "{:?}", scene.warnings);
    assert_eq!(scene.design.unit, LengthUnit::Free);
    assert!(good("two-shapes.pbrt").warnings[0].contains("one of 2 shapes"));
}

#[test]
fn an_obj_keeps_its_groups_and_only_the_normals_it_states() {
    let odd = good("octahedron-odd.obj");
    assert_eq!(odd.design.facets().count(), 8);
    assert!((odd.design.solid().expect("closed").volume() * 0.75 - 1.0).abs() < 1e-12);
    let mut names: Vec<_> = odd.design.facets().map(|f| f.name.as_str()).collect();
    names.sort_unstable();
    assert_eq!(names, ["", "", "", "a b", "a b", "a b", "c", "c"]);
    // a normal that the file states for one corner of a facet is none of the facet's
    let off = |p: &Plane| (p.normal.abs() - DVec3::splat(3f64.sqrt().recip())).abs().max_element();
    assert!(standing(&odd.design).iter().all(|(_, p)| off(p) < 1e-12));
}

/// The tilted stone as The Perfect Diamond is known to store it: each facet fanned into
/// quadrilaterals whose triangular ones are degenerate, wound inward, to six decimals.
fn perfect_diamond(design: &Design) -> (String, String) {
    let tilt = DMat3::from_rotation_x(0.6) * DMat3::from_rotation_y(-0.3);
    let solid = design.clone().turned(tilt).solid().expect("a closed stone");
    let points: String =
        solid.vertices.iter().map(|v| format!("{:.6} {:.6} {:.6}\n", v.x, v.y, v.z)).collect();
    let (mut indices, mut rows) = (String::new(), String::new());
    for face in &solid.faces {
        let c: Vec<_> = face.corners.iter().rev().collect();
        for i in (1..c.len() - 1).step_by(2) {
            let (a, b, d) = (c[0], c[i], c[i + 1]);
            match c.get(i + 2) {
                Some(e) => indices += &format!("{a} {b} {d} {d} {e} {a}\n"),
                None => indices += &format!("{a} {b} {a} {b} {d} {a}\n"),
            }
            let e = c.get(i + 2).unwrap_or(&a);
            rows += &format!("{} {} {} {}\n", a + 1, b + 1, d + 1, *e + 1);
        }
    }
    let scene = format!(
        "WorldBegin\nShape \"trianglemesh\" \"point P\" [ {points} ]\n\"integer indices\" [ {indices} ]\nWorldEnd\n"
    );
    (scene, points + &rows)
}

#[test]
fn the_perfect_diamond_stands_up_again_in_both_forms() {
    let design = Stone::parse("original-brilliant").and_then(Stone::into_design).expect("a library stone");
    let (scene, list) = perfect_diamond(&design);
    let before = design.solid().expect("closed");
    for (text, format) in [(scene, "perfect-diamond"), (list, "perfect-diamond-list")] {
        let stone = formats::read_bytes("data", text.as_bytes(), None).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(stone.format, format);
        let solid = stone.design.solid().expect("closed");
        assert_eq!(solid.faces.len(), 73);
        assert!((solid.volume() / before.volume() - 1.0).abs() < 1e-5);
        assert!((solid.width() / before.width() - 1.0).abs() < 1e-5);
        let table = &stone.design.tiers.iter().find(|t| t.name == "table").expect("a table").facets;
        assert!(table.len() == 1 && table[0].plane.normal.distance(DVec3::Z) < 1e-12);
        assert!(stone.warnings.iter().any(|w| w.contains("unverified")));
    }
}

#[test]
fn stones_are_named_in_one_grammar() {
    assert_eq!(Stone::parse("round-brilliant").expect("a library cut").format(), "library");
    let stone_of = |spec: &str| Stone::parse(spec).map(|i| i.facets());
    assert!(stone_of("prism:sides=9,").is_ok_and(|n| n == 11));
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/good/square.asc");
    assert_eq!(Stone::parse(file.display().to_string()).expect("a file").format(), "gemcad");
    for (spec, said) in [
        ("round-briliant", "no cut and no file is called 'round-briliant'; did you mean 'round-brilliant'?"),
        ("round-briliant:table=55", "did you mean 'round-brilliant'?"),
        ("round-brilliant:table", "at 'table': a parameter is written as key=number"),
        ("round-brilliant:table=wide", "at 'table=wide': a number is needed"),
        ("round-brilliant:table=55,table=56", "at 'table=56': table is given twice"),
        ("round-brilliant:tabel=55", "tabel"),
        ("octahedron:facets=9", "8"),
        ("", "no cut and no file is called ''"),
        ("no/such/file.asc", "there is no file 'no/such/file.asc'"),
    ] {
        let error = Stone::parse(spec).map(|i| i.format()).expect_err(spec).to_string();
        assert!(error.contains(said) && !error.contains('\n'), "{error}");
    }
}

#[test]
fn a_folder_and_a_missing_file_are_errors_of_one_line() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for path in [folder.path().to_owned(), folder.path().join("none.obj")] {
        let error = formats::read(&path).map(|i| i.format).expect_err("cannot be read").to_string();
        assert!(error.starts_with("cannot read ") && !error.contains('\n'), "{error}");
    }
}

#[test]
fn what_would_fill_the_memory_or_the_day_is_refused() {
    let wheel = format!("GemCad 5.0\ng 96 0\na 42 1{}\n", " 3".repeat(20_000));
    let faces = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{}", "f 1 2 3\n".repeat(600_000));
    let corners = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nf{}", " 1 2 3".repeat(1_400_000));
    let continued = format!("o x\nv 0 0 0\nf 1 1 {}2", "\\\n".repeat(1_000_000));
    let toml = format!("name = \"x\"\n[[tier]]\nindices = [{}]\n", "1,".repeat(3_000_000));
    // each node holds the next one twice: 2^60 visits if one followed them all
    let nodes: Vec<_> = (0..60).map(|i| format!("{{\"children\":[{0},{0}]}}", i + 1)).collect();
    let gltf = format!(
        "{{\"asset\":{{\"version\":\"2.0\"}},\"scene\":0,\"scenes\":[{{\"nodes\":[0]}}],\"nodes\":[{},{{}}]}}",
        nodes.join(",")
    );
    let nested = format!("<GemCutStudio>{}", "<a>".repeat(400_000));
    let wide = format!("<GemCutStudio>{}", "<a/>".repeat(600_000));
    let many: String = (0..200_000).map(|i| format!(" a{i}=''")).collect();
    let spaces: String = (0..20_000).map(|i| format!("<a xmlns:a{i}='u{i}'>")).collect();
    for (text, said) in [
        (nested, "opened but never closed"),
        (wide, "x: more than 500000 XML elements and texts"),
        (format!("<GemCutStudio{many}>"), "line 1: more than 100 attributes of an XML element"),
        (format!("<GemCutStudio>{spaces}"), "more than 100 attributes of an XML element, or namespaces"),
        (wheel, "line 3: more than 10000 facets"),
        (faces, "more than 500000 faces of a mesh"),
        (corners, "line 4: more than 4000000 corners of all faces"),
        (continued, "line 3: expected a corner from 1 to 1 as in 3, 3/1 or 3//2, found '2'"),
        (toml, "more than 4194304 bytes in a TOML design"),
        (gltf, "expected a tree of nodes, found a node twice"),
    ] {
        let error = formats::read_bytes("x", text.as_bytes(), None).map(|i| i.format).expect_err(said);
        assert!(error.to_string().contains(said), "{error}");
    }
}

/// Every small good file, and every writer's octahedron.
fn samples() -> Vec<(String, Vec<u8>)> {
    let mut samples: Vec<_> = data("good")
        .into_iter()
        .map(|path| (path.display().to_string(), fs::read(&path).expect("a test file")))
        .collect();
    let octahedron = Stone::parse("octahedron").and_then(Stone::into_design).expect("a library cut");
    for format in FORMATS.iter().filter(|f| f.write.is_some()) {
        let bytes = formats::encode(&octahedron, format.name).expect("can be written");
        samples.push((format!("octahedron as {}", format.name), bytes));
    }
    samples
}

fn is_read_or_refused_in_a_line(name: &str, bytes: &[u8]) {
    if let Err(error) = formats::read_bytes(name, bytes, None) {
        assert!(!error.to_string().contains('\n'), "{error}");
    }
}

#[test]
fn every_beginning_of_every_file_is_read_or_refused() {
    for (name, bytes) in samples() {
        for end in 0..bytes.len() {
            is_read_or_refused_in_a_line(&name, &bytes[..end]);
        }
    }
}

#[test]
fn damaged_files_are_read_or_refused() {
    let mut state: u64 = 0x0063_7574_6c61_6221;
    let mut draw = |below: usize| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as usize % below
    };
    for (name, bytes) in samples() {
        for _ in 0..300 {
            let mut damaged = bytes.clone();
            for _ in 0..1 + draw(4) {
                let at = draw(damaged.len());
                let junk = [0, 255, b'9', b'-', b'0', b' ', b'\n', b'"', b'e', draw(256) as u8];
                damaged[at] = junk[draw(junk.len())];
            }
            is_read_or_refused_in_a_line(&name, &damaged);
        }
    }
}
