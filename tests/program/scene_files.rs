//! Scene files: what they name is looked for beside them and not elsewhere, what is out of range is
//! refused with its line, meshes of every format are scenery, and viewers and turns show what they should.

use crate::bench::Bench;
use crate::room::{ROOM, SMALL, built, taken};
use cutlab::advanced::integrators::animation::{self, Turn};
use cutlab::advanced::limits::Limits;
use cutlab::advanced::scene::{Scene, SceneFile, SceneOverrides, preset};
use glam::Vec3;
use std::path::Path;

#[test]
fn what_is_out_of_range_is_refused_with_its_line() {
    built(ROOM).expect("is sound");
    for (from, to, says) in [
        ("reflectance = [0.5, 0.4, 0.3]", "reflectance = [-1, 0.5, 0.5]", "between 0 and 1"),
        ("reflectance = [0.5, 0.4, 0.3]", "reflectance = [2, 0.5, 0.5]", "between 0 and 1"),
        ("reflectance = [0.5, 0.4, 0.3]", "reflectance = 1.01", "between 0 and 1"),
        (
            "reflectance = [0.5, 0.4, 0.3]",
            "reflectance = { low = -0.1, high = 0.5, edge = 500 }",
            "between 0 and 1",
        ),
        (
            "reflectance = [0.5, 0.4, 0.3]",
            "reflectance = { low = 0.1, high = 1.5, edge = 9000 }",
            "between 0 and 1",
        ),
        ("u = [100, 0, 0]", "u = [1e-20, 0, 0]", "no area"),
        ("u = [100, 0, 0]", "u = [0, 50, 0]", "no area"),
        ("colour = [1, 0.9, 0.8]", "colour = [-1, -1, -1]", "colour"),
        ("colour = [1, 0.9, 0.8]", "colour = [1, -0.1, 1]", "colour"),
        ("colour = [1, 0.9, 0.8]", "colour = [0, 0, 0]", "colour"),
        ("picture = [16, 12]", "picture = [0, 0]", "pixels"),
        ("picture = [16, 12]", "picture = [16, 0]", "pixels"),
        ("picture = [16, 12]", "picture = [16, 20000]", "pixels"),
        ("side = 4", "side = 1e-12", "area"),
        ("kind = \"square\"", "kind = \"disc\"\nradius = 1e-12", "area"),
        ("kind = \"square\"", "kind = \"sphere\"\nradius = 1e-12", "area"),
        ("kind = \"square\"", "kind = \"spot\"\nradius = 1\ncone = 400", "cone"),
        ("side = 4\nradiance = 9", "side = 1e-5\npower = 1e9", "power"),
        ("at = [8, -8, 20]", "at = [8, -8, 20]\nto = [8, -8, 20]", "shines to"),
        ("at = [8, -8, 20]", "at = [0, 0, 3]", "stone 1"),
        ("at = [8, -8, 20]", "at = [0, 0, 2]", "stone 1"),
        ("at = [8, -8, 20]\nside = 4", "at = [0, -3.5, 3]\nto = [0, -3.5, 9]\nside = 4", "stone 1"),
        ("kind = \"square\"\nat = [8, -8, 20]", "kind = \"sphere\"\nradius = 1\nat = [0, 0, 3.5]", "stone 1"),
        ("at = [0, -36, 20]", "at = [1, 1, 2]", "camera stands inside stone 1"),
        ("at = [0, -36, 20]\nfield = 40", "at = [3.5, 0, 9]\nto = [3.5, 0, 0]\nwidth = 9", ""),
        ("at = [0, -36, 20]\nfield = 40", "at = [3.5, 0, 3]\nto = [3.5, 0, 0]\nwidth = 9", "inside stone 1"),
        ("size = 6", "size = 200", "camera stands inside stone 1"),
        ("size = 6", "radius = 1e-30", "radius"),
        ("field = 40", "field = 40\nexposure = 1e5", "exposure"),
        ("field = 40", "field = 0", "an angle from 0 to 175 degrees"),
        ("field = 40", "field-short = 180", "an angle from 0 to 150 degrees"),
        ("picture = [16, 12]", "picture = [16, 12]\ndepth = 0", "depth"),
    ] {
        let text = ROOM.replacen(from, to, 1);
        assert_ne!(text, ROOM, "{from}");
        match built(&text) {
            Ok(_) => assert!(says.is_empty(), "{to}: is taken"),
            Err(error) => {
                assert!(!says.is_empty() && error.starts_with("t.toml, line "), "{to}: {error}");
                assert!(error.contains(says) && error.lines().count() == 1, "{to}: {error}");
            }
        }
    }
}

#[test]
fn a_point_lies_in_a_stone_or_not() {
    for cut in ["cube", "round-brilliant", "octahedron"] {
        let scene = built(&ROOM.replace("\"cube\"", &format!("\"{cut}\""))).expect("is sound");
        let stone = &scene.stones[0];
        let (mut inside, mut outside) = (0, 0);
        for [x, y, z] in (0..1000).map(|i| [i % 10, i / 10 % 10, i / 100].map(|k| k as f32 - 4.5)) {
            let point = stone.position + Vec3::new(x, y, z) * stone.radius / 4.0;
            let local = stone.point_to_stone(point).as_dvec3() * stone.stone.unit + stone.stone.centre;
            let solid = &stone.stone.solid;
            let off = solid.faces.iter().map(|f| {
                let corner = |i: usize| solid.vertices[f.corners[i]];
                let normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalize();
                normal.dot(local - corner(0))
            });
            let off = off.fold(f64::NEG_INFINITY, f64::max);
            if off.abs() > 1e-4 {
                assert_eq!(stone.contains(point), off < 0.0, "{cut} {point}");
                if off < 0.0 { inside += 1 } else { outside += 1 }
            }
        }
        assert!(inside > 20 && outside > 300, "{cut}: {inside} {outside}");
    }
}

#[test]
fn files_are_found_beside_the_scene_and_nowhere_else() {
    let bench = Bench::new();
    std::fs::create_dir_all(bench.path("inner/below")).expect("makes");
    for name in ["inner/mine.toml", "inner/below/block.obj", "outer.asc", "outer.obj"] {
        bench.good(&["generate", "-q", "octahedron", "-o", name]);
    }
    std::fs::write(bench.path("secret.txt"), "root:x:0:0").expect("writes");
    let outer = bench.path("outer.asc");
    let scene = |cut: &str, mesh: &str| {
        let text = ROOM.replace("cut = \"cube\"", &format!("cut = '{cut}'"));
        let block = format!("[[surface]]\nmesh = '{mesh}'\nat = [9, 9, 3]\nreflectance = 0.5\n[[light]]");
        std::fs::write(bench.path("inner/s.toml"), text.replacen("[[light]]", &block, 1)).expect("writes");
    };
    let render = [&["render", "-q", "--scene", "inner/s.toml", "-o", "a.png"], &SMALL[..]].concat();
    let anywhere = [&render[..], &["--allow-outside"]].concat();
    scene("mine.toml", "below/block.obj");
    bench.good(&render);
    for (cut, mesh, key) in [
        ("../outer.asc", "below/block.obj", "cut"),
        (&*outer.display().to_string(), "below/block.obj", "cut"),
        ("mine.toml", "../outer.obj", "mesh"),
        ("mine.toml", "below/../../outer.obj", "mesh"),
    ] {
        scene(cut, mesh);
        let (_, problem) = bench.ends(2, &render);
        assert!(problem.contains(key) && problem.contains("--allow-outside"), "{cut} {mesh}: {problem}");
        bench.good(&anywhere);
    }
    scene("../secret.txt", "below/block.obj");
    assert!(!bench.ends(2, &render).1.contains("root"), "nothing of the file is told");
    scene("mine.toml", "../nothing.obj");
    assert!(bench.ends(2, &render).1.contains("--allow-outside"), "whether it is there is not told");
    scene("../nothing.asc", "below/block.obj");
    assert!(bench.ends(2, &render).1.contains("--allow-outside"));
    // a stone of the working folder is none of the scene's
    scene("outer.asc", "below/block.obj");
    assert!(bench.ends(2, &render).1.contains("outer.asc"));
    let text = ROOM.replace("kind = \"dome\"", "kind = \"dome\"\npanorama = \"../sky.hdr\"");
    std::fs::write(bench.path("inner/s.toml"), text).expect("writes");
    assert!(bench.ends(2, &render).1.contains("--allow-outside"));
}

#[cfg(unix)]
#[test]
fn a_link_leads_a_scene_nowhere_else() {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("inner")).expect("makes");
    bench.good(&["generate", "-q", "octahedron", "-o", "outer.asc"]);
    std::os::unix::fs::symlink("../outer.asc", bench.path("inner/link.asc")).expect("links");
    let text = ROOM.replace("cut = \"cube\"", "cut = \"link.asc\"");
    std::fs::write(bench.path("inner/s.toml"), text).expect("writes");
    let render = [&["render", "-q", "--scene", "inner/s.toml", "-o", "a.png"], &SMALL[..]].concat();
    assert!(bench.ends(2, &render).1.contains("--allow-outside"));
}

/// A block of any mesh format is the same block.
#[test]
fn meshes_of_every_format_are_scenery() {
    let bench = Bench::new();
    let bounds = |name: &str, format: &str| {
        bench.good(&["generate", "-q", "octahedron", "--to", format, "-o", name]);
        let block = format!("[[surface]]\nmesh = \"{name}\"\nreflectance = 0.5\n[[light]]");
        let text = ROOM.replacen("[[light]]", &block, 1);
        let folder = bench.path("");
        let file = SceneFile::parse("t", "t.toml", &text, &folder).expect("is sound");
        let scene = file.build(&SceneOverrides::default(), 1.0).expect(name);
        assert!(!scene.surfaces[1].backdrop && scene.surfaces[0].backdrop);
        scene.surfaces[1].bounds()
    };
    let (low, high) = bounds("b.obj", "obj");
    assert!((high - low).min_element() > 0.1);
    for (name, format) in [("b.stl", "stl"), ("t.stl", "stl-text"), ("b.ply", "ply"), ("t.ply", "ply-text")] {
        let (l, h) = bounds(name, format);
        assert!((l - low).length() + (h - high).length() < 1e-5, "{name}: {l} {h}");
    }
}

/// Flat colours that are at least a hundredth of a viewer's picture, and what all flat ones are together.
fn flat_colours(scene: &str) -> (Vec<&'static str>, f64) {
    let file = preset(scene).expect("in the catalogue").expect("is sound");
    let scene = file.build(&SceneOverrides::default(), 1.0).expect("is set up");
    assert!(scene.camera.flat);
    let film = taken(&scene, 96);
    let flat = [
        ("white", Vec3::ONE),
        ("black", Vec3::ZERO),
        ("red", Vec3::X),
        ("green", Vec3::Y),
        ("blue", Vec3::Z),
    ];
    let count = film.pixels.len() as f64;
    let shares = flat.map(|(name, colour)| {
        let near = film.pixels.iter().filter(|p| (p.display - colour).abs().max_element() < 0.05);
        (name, near.count() as f64 / count)
    });
    let names = shares.iter().filter(|(_, share)| *share >= 0.01).map(|(name, _)| *name).collect();
    (names, shares.iter().map(|(_, share)| share).sum())
}

#[test]
fn viewers_show_flat_colours() {
    for (scene, expected) in [
        ("ideal-scope", &["white", "black", "red"][..]),
        ("hearts", &["white", "black", "red"]),
        ("arrows", &["white", "black", "red"]),
        ("aset", &["black", "red", "green", "blue"]),
        ("dark-field", &["black"]), // its bright edges are thinner than a pixel here
    ] {
        let (names, share) = flat_colours(scene);
        assert_eq!(names, expected, "{scene}");
        assert!(share > 0.6, "{scene}: {share} of the picture is flat");
    }
}

#[test]
fn the_whole_piece_turns_and_the_room_does_not() {
    let bench = Bench::new();
    bench.good(&["generate", "-q", "cube", "-o", "block.obj"]);
    let block = "[[surface]]\nmesh = \"block.obj\"\nscale = 3\nat = [12, 0, 3]\nreflectance = 0.5\n\
        [[stone]]\ncut = \"octahedron\"\nsize = 4\nat = [0, 12, 5]\n[[light]]";
    let text = ROOM.replacen("[[light]]", block, 1);
    let file = SceneFile::parse("t", "t.toml", &text, &bench.path("")).expect("is sound");
    let rest = file.build(&SceneOverrides::default(), 1.0).expect("is set up");
    let middle = |scene: &Scene| {
        let (low, high) = scene.surfaces[1].bounds();
        0.5 * (low + high)
    };
    let centre = rest.stones[0].position;
    let half = animation::scene_at(&rest, Turn::All, false, 1, 2);
    let mirrored = |p: Vec3| Vec3::new(2.0 * centre.x - p.x, 2.0 * centre.y - p.y, p.z);
    assert!((middle(&half) - mirrored(middle(&rest))).length() < 1e-4);
    assert!((half.stones[1].position - mirrored(rest.stones[1].position)).length() < 1e-4);
    assert!((half.stones[0].position - centre).length() < 1e-4);
    assert_eq!(half.surfaces[0].bounds(), rest.surfaces[0].bounds());
    assert_eq!(format!("{:?}", half.lights), format!("{:?}", rest.lights));
    // rocked, nothing sinks into the table
    let rocked = animation::scene_at(&rest, Turn::All, true, 1, 4);
    let lowest =
        |scene: &Scene| scene.stones.iter().map(|s| s.lowest()).fold(scene.surfaces[1].lowest(), f32::min);
    assert!((lowest(&rocked) - lowest(&rest)).abs() < 1e-4);
    let between = |scene: &Scene| scene.stones[1].position.distance(middle(scene));
    assert!((between(&rocked) - between(&rest)).abs() < 0.2, "it stays one piece");
}

#[test]
fn daylight_takes_a_panorama_by_option() {
    let bench = Bench::new();
    let sky = image::Rgb32FImage::from_fn(32, 16, |_, y| {
        image::Rgb(if y < 8 { [0.4, 0.6, 1.0] } else { [0.2; 3] })
    });
    sky.save(bench.path("sky.hdr")).expect("writes");
    let render = |name: &'static str, extra: &[&'static str]| {
        let arguments = ["render", "-q", "cube", "--scene", "daylight", "-o", name];
        [&arguments[..], extra, &SMALL[..]].concat()
    };
    bench.good(&render("a.png", &["--hdr", "sky.hdr"]));
    let first = std::fs::read(bench.path("a.png")).expect("was written");
    std::fs::copy(bench.path("sky.hdr"), bench.path("panorama.hdr")).expect("copies");
    bench.good(&render("b.png", &[]));
    let pixels = |bytes: &[u8]| image::load_from_memory(bytes).expect("is a picture").to_rgb8();
    assert_eq!(pixels(&first), pixels(&std::fs::read(bench.path("b.png")).expect("was written")));
    assert!(bench.ends(2, &render("c.png", &["--hdr", "nothing.hdr"])).1.contains("nothing.hdr"));
    std::fs::remove_file(bench.path("panorama.hdr")).expect("is there");
    assert!(bench.ends(2, &render("c.png", &[])).1.contains("--hdr FILE"));
    std::fs::write(bench.path("text.hdr"), "no picture").expect("writes");
    assert!(
        bench.ends(2, &render("c.png", &["--hdr", "text.hdr"])).1.contains("neither a Radiance .hdr nor")
    );
}

/// Lines of every system, in scenes and in designs.
#[test]
fn toml_is_read_whatever_ends_its_lines() {
    let bench = Bench::new();
    let (design, _) = bench.ends(0, &["generate", "-q", "cube", "--to", "toml", "-o", "-"]);
    for (name, ends) in [("lf", "\n"), ("crlf", "\r\n"), ("cr", "\r")] {
        std::fs::write(bench.path(&format!("{name}.toml")), ROOM.replace('\n', ends)).expect("writes");
        SceneFile::open(&bench.path(&format!("{name}.toml")), Limits::default())
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        std::fs::write(bench.path(&format!("{name}-cube.toml")), design.replace('\n', ends)).expect("writes");
        bench.good(&["show", &format!("{name}-cube.toml")]);
    }
}

/// The grammar that the program prints is one that it takes.
#[test]
fn the_grammar_is_a_scene_but_for_its_files() {
    let bench = Bench::new();
    let (grammar, _) = bench.ends(0, &["list", "scene-grammar"]);
    let file = SceneFile::parse("g", "g.toml", &grammar, Path::new("")).expect("is a scene file");
    assert!(file.stone_count() == 1 && file.picture() == (640, 480));
    let (head, rest) = grammar.split_once("[[surface]]               # a mesh").expect("has a mesh");
    let (_, light) = rest.split_once("[[light]]").expect("has a light");
    built(&format!("{head}[[light]]{light}")).expect("is sound");
}
