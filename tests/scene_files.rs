//! Scene files: what they name is looked for beside them and not elsewhere, what is out of range is
//! refused with its line, meshes of every format are scenery, and viewers, turns and backgrounds show
//! what they should.

mod bench;

use bench::Bench;
use cutlab::photons::{self, Shots};
use cutlab::render::animation::{self, Turn};
use cutlab::render::{self, Curve, Maps, Tone, write};
use cutlab::scene::{Cast, Scene, SceneFile, preset};
use glam::{Vec3, Vec4};
use std::path::Path;

const SMALL: [&str; 8] = ["--width", "16", "--spp", "1", "--photons", "200", "--nearest", "10"];

const ROOM: &str = r#"unit = "mm"
picture = [16, 12]
[camera]
at = [0, -36, 20]
field = 40
[[stone]]
cut = "cube"
pose = "table-up"
size = 6
[[surface]]
corner = [-50, -50, 0]
u = [100, 0, 0]
v = [0, 100, 0]
reflectance = [0.5, 0.4, 0.3]
[[light]]
kind = "square"
at = [8, -8, 20]
side = 4
radiance = 9
colour = [1, 0.9, 0.8]
[[light]]
kind = "dome"
radiance = 0.1
"#;

fn built(text: &str) -> Result<Scene, String> {
    let file = SceneFile::parse("t", "t.toml", text, Path::new("")).map_err(|e| e.to_string())?;
    file.build(&Cast::default(), 4.0 / 3.0).map_err(|e| e.to_string())
}

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
        ("at = [8, -8, 20]", "at = [0, 0, 3]", "shines to"),
        ("at = [8, -8, 20]", "at = [0, 0, 2]", "stone 1"),
        ("at = [8, -8, 20]\nside = 4", "at = [0, -3.5, 3]\nto = [0, -3.5, 9]\nside = 4", "stone 1"),
        ("kind = \"square\"\nat = [8, -8, 20]", "kind = \"sphere\"\nradius = 1\nat = [0, 0, 3.5]", "stone 1"),
        ("at = [0, -36, 20]", "at = [1, 1, 2]", "camera stands inside stone 1"),
        ("at = [0, -36, 20]\nfield = 40", "at = [3.5, 0, 9]\nto = [3.5, 0, 0]\nwidth = 9", ""),
        ("at = [0, -36, 20]\nfield = 40", "at = [3.5, 0, 3]\nto = [3.5, 0, 0]\nwidth = 9", "inside stone 1"),
        ("size = 6", "size = 200", "camera stands inside stone 1"),
        ("size = 6", "radius = 1e-30", "radius"),
        ("field = 40", "field = 40\nexposure = 1e5", "exposure"),
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
        let scene = file.build(&Cast::default(), 1.0).expect(name);
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
    let scene = file.build(&Cast::default(), 1.0).expect("is set up");
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
        let near = film.pixels.iter().filter(|p| (p.shown - colour).abs().max_element() < 0.05);
        (name, near.count() as f64 / count)
    });
    let names = shares.iter().filter(|(_, share)| *share >= 0.01).map(|(name, _)| *name).collect();
    (names, shares.iter().map(|(_, share)| share).sum())
}

fn taken(scene: &Scene, side: u32) -> render::Film {
    let photons = photons::Settings { photons: 100, nearest: 10, seed: 1 };
    let maps = Maps::new(scene, Shots::shoot(scene, &photons), photons.nearest);
    let tone = Tone { curve: Curve::Linear, ..Tone::default() };
    let settings = render::Settings { width: side, height: side, rays: 9, round: 0, tone, seed: 1 };
    render::render(scene, &scene.camera, &maps, &settings, &|| ())
}

#[test]
fn viewers_show_flat_colours() {
    for (scene, expected) in [
        ("ideal-scope", &["white", "black", "red"][..]),
        ("hearts", &["white", "black", "red"]),
        ("arrows", &["white", "black", "red"]),
        ("aset", &["black", "red", "green", "blue"]),
        ("dark-field", &["white", "black"]),
    ] {
        let (names, share) = flat_colours(scene);
        assert_eq!(names, expected, "{scene}");
        assert!(share > 0.7, "{scene}: {share} of the picture is flat");
    }
}

/// A scene whose background is a dome of `radiance` alone.
fn before_a_sky(cut: &str, material: &str, radiance: f32) -> String {
    let stone = format!("cut = \"{cut}\"\nmaterial = \"{material}\"");
    let text =
        ROOM.replace("cut = \"cube\"", &stone).replace("radiance = 0.1", &format!("radiance = {radiance}"));
    let (head, rest) = text.split_once("[[surface]]").expect("has a floor");
    let (_, lights) = rest.split_once("[[light]]").expect("has a lamp");
    let (_, dome) = lights.split_once("[[light]]").expect("has a dome");
    format!("{head}[[light]]{dome}")
}

/// What is cut out and the background behind it are the whole picture, but for what the wavelengths of a
/// ray leave of a white sky.
#[test]
fn a_stone_before_its_own_background_is_the_picture() {
    const SKY: f32 = 0.4;
    let scene = built(&before_a_sky("round-brilliant", "diamond", SKY)).expect("is sound");
    let whole = taken(&scene, 48);
    let cut = taken(&Scene { cut_out: true, ..scene }, 48);
    let (mut clear, mut partly, mut opaque) = (0, 0, 0);
    let again = write::before(&cut, Vec3::splat(SKY));
    for ((a, b), c) in whole.pixels.iter().zip(&again).zip(&cut.pixels) {
        assert!(a.alpha > 0.9999);
        assert!((a.shown - *b).abs().max_element() < 0.03, "{} {b} at coverage {}", a.shown, c.alpha);
        match c.alpha {
            0.0 => clear += 1,
            x if x > 0.999 => opaque += 1,
            _ => partly += 1,
        }
    }
    assert!(clear > 500 && opaque > 100 && partly > 10, "{clear} {partly} {opaque}");
}

/// Edges have no halo: as straight colour they are the stone's own. A stone under a sky of its own
/// brightness that lets everything through has that brightness up to its edge.
#[test]
fn an_edge_has_the_colour_of_what_it_is_the_edge_of() {
    const SKY: f32 = 0.4;
    let scene = built(&before_a_sky("cube", "diamond", SKY)).expect("is sound");
    let film = taken(&Scene { cut_out: true, ..scene }, 48);
    let mut edges = 0;
    for (pixel, straight) in film.pixels.iter().zip(write::cut_out(&film)) {
        if pixel.alpha == 0.0 {
            assert_eq!(straight, Vec4::ZERO);
            continue;
        }
        edges += usize::from(pixel.alpha < 0.999);
        // a clear stone under an even sky is as bright as the sky
        assert!((straight.truncate() - SKY).abs().max_element() * straight.w < 0.02, "{straight}");
        assert!((straight.w - pixel.alpha).abs() < 1e-6);
    }
    assert!(edges > 10);
}

#[test]
fn floors_are_background_and_meshes_are_not() {
    let bench = Bench::new();
    bench.good(&["generate", "-q", "cube", "-o", "block.obj"]);
    let block =
        "[[surface]]\nmesh = \"block.obj\"\nscale = 0.5\nat = [10, 0, 3]\nreflectance = 0.5\n[[light]]";
    std::fs::write(bench.path("s.toml"), ROOM.replacen("[[light]]", block, 1)).expect("writes");
    let alpha = |name: &str, extra: &[&str]| {
        let arguments = [&["render", "-q", "--scene", "s.toml", "-o", name], extra, &SMALL[..]].concat();
        bench.good(&arguments);
        image::open(bench.path(name)).expect("is a picture").to_rgba8()
    };
    let through = alpha("a.png", &["--background", "transparent"]);
    let count =
        |bytes: std::ops::RangeInclusive<u8>| through.pixels().filter(|p| bytes.contains(&p.0[3])).count();
    assert!(count(0..=0) > 60, "floor and sky: {}", count(0..=0));
    assert!(count(255..=255) > 8, "stone and block: {}", count(255..=255));
    assert_eq!(through, alpha("a.webp", &["--background", "transparent"]));
    let white = alpha("w.png", &["--background", "white"]);
    for (a, b) in through.pixels().zip(white.pixels()) {
        assert!(a.0[3] > 0 || b.0 == [255; 4], "{b:?}");
        assert!(a.0[3] < 255 || a == b, "{a:?} {b:?}");
    }
    let blue = alpha("b.png", &["--background", "#1e90ff"]);
    assert_eq!(blue.get_pixel(0, 0).0, [0x1e, 0x90, 0xff, 255]);
    // an EXR has the coverage as its alpha
    bench.good(
        &[&["render", "-q", "--scene", "s.toml", "-o", "a.exr", "--background", "transparent"], &SMALL[..]]
            .concat(),
    );
    let exr = exr::prelude::read_first_flat_layer_from_file(bench.path("a.exr")).expect("is an EXR");
    let channel = exr.layer_data.channel_data.list.iter().find(|c| c.name.to_string() == "A");
    let alphas: Vec<f32> = channel.expect("has alpha").sample_data.values_as_f32().collect();
    for (a, p) in alphas.iter().zip(through.pixels()) {
        assert!((a * 255.0 - f32::from(p.0[3])).abs() <= 0.51, "{a} {p:?}");
    }
    // frames of an animated PNG keep it
    bench.good(
        &[
            &[
                "render",
                "-q",
                "--scene",
                "s.toml",
                "-o",
                "f.apng",
                "--frames",
                "2",
                "--background",
                "transparent",
            ],
            &SMALL[..],
        ]
        .concat(),
    );
    let file = std::fs::File::open(bench.path("f.apng")).expect("was written");
    let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().expect("is a PNG");
    assert_eq!(reader.info().animation_control.expect("moves").num_frames, 2);
    let mut bytes = vec![0; reader.output_buffer_size().expect("has a size")];
    let info = reader.next_frame(&mut bytes).expect("has a frame");
    assert_eq!((info.color_type, &bytes[..]), (png::ColorType::Rgba, &through.as_raw()[..]));
}

#[test]
fn the_whole_piece_turns_and_the_room_does_not() {
    let bench = Bench::new();
    bench.good(&["generate", "-q", "cube", "-o", "block.obj"]);
    let block = "[[surface]]\nmesh = \"block.obj\"\nscale = 3\nat = [12, 0, 3]\nreflectance = 0.5\n\
        [[stone]]\ncut = \"octahedron\"\nsize = 4\nat = [0, 12, 5]\n[[light]]";
    let text = ROOM.replacen("[[light]]", block, 1);
    let file = SceneFile::parse("t", "t.toml", &text, &bench.path("")).expect("is sound");
    let rest = file.build(&Cast::default(), 1.0).expect("is set up");
    let middle = |scene: &Scene| {
        let (low, high) = scene.surfaces[1].bounds();
        0.5 * (low + high)
    };
    let centre = rest.stones[0].position;
    let half = animation::at(&rest, Turn::All, false, 1, 2);
    let mirrored = |p: Vec3| Vec3::new(2.0 * centre.x - p.x, 2.0 * centre.y - p.y, p.z);
    assert!((middle(&half) - mirrored(middle(&rest))).length() < 1e-4);
    assert!((half.stones[1].position - mirrored(rest.stones[1].position)).length() < 1e-4);
    assert!((half.stones[0].position - centre).length() < 1e-4);
    assert_eq!(half.surfaces[0].bounds(), rest.surfaces[0].bounds());
    assert_eq!(format!("{:?}", half.lights), format!("{:?}", rest.lights));
    // rocked, nothing sinks into the table
    let rocked = animation::at(&rest, Turn::All, true, 1, 4);
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
    let render = |extra: &[&'static str]| {
        let arguments = ["render", "-q", "cube", "--scene", "daylight", "-o", "a.png"];
        [&arguments[..], extra, &SMALL[..]].concat()
    };
    bench.good(&render(&["--hdr", "sky.hdr"]));
    let first = std::fs::read(bench.path("a.png")).expect("was written");
    std::fs::copy(bench.path("sky.hdr"), bench.path("panorama.hdr")).expect("copies");
    bench.good(&render(&[]));
    let pixels = |bytes: &[u8]| image::load_from_memory(bytes).expect("is a picture").to_rgb8();
    assert_eq!(pixels(&first), pixels(&std::fs::read(bench.path("a.png")).expect("was written")));
    assert!(bench.ends(2, &render(&["--hdr", "nothing.hdr"])).1.contains("nothing.hdr"));
}

/// The grammar that the program prints is one that it takes.
#[test]
fn the_grammar_is_a_scene_but_for_its_files() {
    let bench = Bench::new();
    let (grammar, _) = bench.ends(0, &["list", "scene-grammar"]);
    let file = SceneFile::parse("g", "g.toml", &grammar, Path::new("")).expect("is a scene file");
    assert!(file.places() == 1 && file.picture() == (640, 480));
    let (head, rest) = grammar.split_once("[[surface]]               # a mesh").expect("has a mesh");
    let (_, light) = rest.split_once("[[light]]").expect("has a light");
    built(&format!("{head}[[light]]{light}")).expect("is sound");
}
