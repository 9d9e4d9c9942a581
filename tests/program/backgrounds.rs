//! `--background`: a stone that is cut out has right edges, keeps its coverage in every format that has
//! one, and stands before a colour as it is.

use crate::bench::Bench;
use crate::room::{ROOM, SMALL, built, taken};
use cutlab::advanced::integrators::image_io;
use glam::{Vec3, Vec4};

/// Luminance of linear sRGB. The wavelengths of a few rays leave colours some noise, luminance little.
fn luminance(colour: Vec3) -> f32 {
    colour.dot(Vec3::new(0.2126, 0.7152, 0.0722))
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
    let mut scene = built(&before_a_sky("round-brilliant", "diamond", SKY)).expect("is sound");
    let whole = taken(&scene, 48);
    scene.cut_out = true;
    let cut = taken(&scene, 48);
    let (mut clear, mut partly, mut opaque) = (0, 0, 0);
    let again = image_io::over_background(&cut, Vec3::splat(SKY));
    for ((a, b), c) in whole.pixels.iter().zip(&again).zip(&cut.pixels) {
        assert!(a.alpha > 0.9999);
        assert!(luminance(a.display - *b).abs() < 0.015, "{} {b} at coverage {}", a.display, c.alpha);
        match c.alpha {
            0.0 => clear += 1,
            x if x > 0.999 => opaque += 1,
            _ => partly += 1,
        }
    }
    assert!(clear > 500 && opaque > 20 && partly > 10, "{clear} {partly} {opaque}");
}

/// Edges have no halo: as straight colour they are the stone's own. A stone under a sky of its own
/// brightness that lets everything through has that brightness up to its edge.
#[test]
fn an_edge_has_the_colour_of_what_it_is_the_edge_of() {
    const SKY: f32 = 0.4;
    let mut scene = built(&before_a_sky("cube", "diamond", SKY)).expect("is sound");
    scene.cut_out = true;
    let film = taken(&scene, 48);
    let mut edges = 0;
    for (pixel, straight) in film.pixels.iter().zip(image_io::cut_out(&film)) {
        if pixel.alpha == 0.0 {
            assert_eq!(straight, Vec4::ZERO);
            continue;
        }
        edges += usize::from(pixel.alpha < 0.999);
        // a clear stone under an even sky is as bright as the sky
        let off = luminance(straight.truncate() - SKY);
        assert!(off.abs() * straight.w < 0.015, "{straight}");
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
