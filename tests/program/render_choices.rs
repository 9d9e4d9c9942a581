//! `cutlab render` and its options: what cannot go together or has no effect is refused before any file
//! is made, names of frames and default names say what they should, and nothing is left beside a picture.

use crate::bench::{Bench, text};

const TINY: [&str; 8] = ["--width", "8", "--spp", "1", "--photons", "100", "--nearest", "10"];

fn render<'a>(arguments: &[&'a str]) -> Vec<&'a str> {
    [&["render", "cube"], arguments, &TINY[..]].concat()
}

#[test]
fn options_that_cannot_go_together_are_one_sentence_and_leave_no_file() {
    for (arguments, says) in [
        // names of frames
        (&["--frames", "2", "-o", "%99999999999d.png"][..], "%03d"),
        (&["--frames", "2", "-o", "f%0d.png"], "%03d"),
        (&["--frames", "2", "-o", "f%x.png"], "%03d"),
        (&["--frames", "2", "-o", "f%-3d.png"], "%03d"),
        (&["--frames", "2", "-o", "f%d-%d.png"], "%03d"),
        (&["--frames", "2", "-o", "f%d.gif"], "%03d"),
        (&["-o", "f%03d.png"], "--frames"),
        // light that is kept and moves
        (&["--photon-map", "m.map", "--frames", "2", "--turn", "stone", "-o", "p.gif"], "--photon-map"),
        (&["--photon-map", "m.map", "--frames", "2", "--turn", "light", "-o", "p.gif"], "--photon-map"),
        (&["--photon-map", "m.map", "--frames", "2", "--turn", "all", "-o", "f%d.png"], "--photon-map"),
        (&["--photon-map", "m.png", "-o", "m.png"], "one file"),
        // without effect
        (&["--rock", "-o", "a.png"], "--frames"),
        (&["--turn", "stone", "-o", "a.png"], "--frames"),
        (&["--fps", "24", "-o", "a.png"], "--frames"),
        (&["--fps", "24", "--frames", "2", "-o", "f%d.png"], "--fps"),
        (&["--fps", "100", "--frames", "2", "-o", "a.gif"], "50"),
        (&["--bits", "16", "-o", "a.exr"], "--bits"),
        (&["--bits", "8", "-o", "a.exr"], "--bits"),
        (&["--exposure", "1", "-o", "a.exr"], "--exposure"),
        (&["--tone", "linear", "-o", "a.exr"], "--tone"),
        (&["--glare", "-o", "a.exr"], "--glare"),
        (&["--bits", "16", "-o", "a.jpg"], "--bits"),
        (&["--bits", "16", "--frames", "2", "-o", "a.gif"], "--bits"),
        (&["--bits", "16", "--frames", "2", "-o", "a.mp4"], "--bits"),
        (&["--hdr", "x.hdr", "-o", "a.png"], "--hdr"),
        // transparency
        (&["--background", "transparent", "-o", "a.jpg"], "transparen"),
        (&["--background", "transparent", "--frames", "2", "-o", "a.gif"], "transparen"),
        (&["--background", "transparent", "--frames", "2", "-o", "a.mp4"], "transparen"),
        (&["--background", "white", "-o", "a.exr"], "transparent"),
        (&["--background", "mauve", "-o", "a.png"], "#1e90ff"),
        // extensions and sizes
        (&["-o", "a.mp4"], "--frames"),
        (&["-o", "a.gif"], "--frames"),
        (&["--frames", "2", "-o", "a.jpg"], ".mp4"),
        (&["--frames", "2", "--passes", "-o", "a.mp4"], "%03d"),
        (&["--frames", "2", "--height", "33", "-o", "a.mp4"], "34"),
        (&["--frames", "2", "-o", "-"], "standard output"),
        // a number that became a STONE; after --glare it is glare's
        (&["8", "--glare", "-o", "a.png"], "--glare=8"),
    ] {
        let bench = Bench::new();
        let arguments = render(arguments);
        let (said, problem) = bench.ends(2, &arguments);
        assert!(said.is_empty() && problem.lines().count() == 1, "{arguments:?}: {said}{problem}");
        assert!(problem.contains(says), "{arguments:?}: {problem}");
        assert_eq!(bench.names(), Vec::<String>::new(), "{arguments:?}");
    }
}

#[test]
fn options_about_stones_are_refused_where_there_is_none() {
    let bench = Bench::new();
    let scene = "unit = \"mm\"\n[camera]\nat = [0, -9, 9]\nto = [0, 0, 0]\nfield = 30\n\
        [[surface]]\ncorner = [-9, -9, 0]\nu = [18, 0, 0]\nv = [0, 18, 0]\nreflectance = 0.5\n\
        [[light]]\nkind = \"dome\"\nradiance = 1\n";
    std::fs::write(bench.path("bare.toml"), scene).expect("writes");
    for option in [&["--material", "quartz"][..], &["--ri", "1.5"], &["--size", "3"], &["--pose", "lying"]] {
        let arguments = [&["render", "--scene", "bare.toml", "-o", "a.png"], option, &TINY[..]].concat();
        let (_, problem) = bench.ends(2, &arguments);
        assert!(problem.contains(option[0]) && problem.contains("no stone"), "{problem}");
    }
    bench.good(&[&["render", "-q", "--scene", "bare.toml", "-o", "a.png"], &TINY[..]].concat());
}

#[test]
fn a_picture_on_standard_output_is_nothing_else() {
    let bench = Bench::new();
    bench.good(&render(&["-q", "-o", "a.png"]));
    let whole = std::fs::read(bench.path("a.png")).expect("was written");
    for extra in [&["-o", "-", "-q"][..], &["-o", "-", "--json"]] {
        let out = bench.run(&render(extra));
        assert!(out.status.success(), "{}", text(&out.stderr));
        assert_eq!(out.stdout, whole, "{extra:?}");
    }
}

#[test]
fn json_names_every_frame_made_now_or_before() {
    let bench = Bench::new();
    for (name, extra, expected) in [
        ("f%d.png", &[][..], "f0.png f1.png f2.png"),
        ("g%02d.png", &["--passes"], "g00-direct.png g00-caustic.png g00-indirect.png g00-stone.png g00.png"),
    ] {
        let arguments = render(&[&["--frames", "3", "--json", "-o", name], extra].concat());
        let names = |said: &str| serde_json::from_str::<Vec<String>>(said).expect("is JSON");
        let first = names(&bench.ends(0, &arguments).0);
        assert!(first.join(" ").starts_with(expected), "{first:?}");
        assert_eq!(names(&bench.ends(0, &arguments).0), first, "all are there already");
        std::fs::remove_file(bench.path(&first[0])).expect("is there");
        assert_eq!(names(&bench.ends(0, &arguments).0), first, "one was missing");
    }
}

#[test]
fn nothing_of_a_start_that_was_killed_stays_beside_a_picture() {
    for (output, arguments) in [
        ("p.png", &["-o", "p.png"][..]),
        ("p.png", &["-o", "p.png", "--progressive", "--rounds", "2"]),
        ("p.png", &["-o", "p.png", "--frames", "2"]),
        ("p.exr", &["-o", "p.exr"]),
        ("p.jpg", &["-o", "p.jpg"]),
    ] {
        let bench = Bench::new();
        let left = |extension: &str| bench.path(&format!(".{output}.{extension}"));
        std::fs::write(left("kept"), "of rounds").expect("writes");
        std::fs::write(left("lock"), "").expect("writes");
        std::fs::create_dir(left("frames")).expect("makes");
        std::fs::write(left("frames").join("000.png"), "a frame").expect("writes");
        bench.good(&render(&[&["-q"], arguments].concat()));
        assert_eq!(bench.names(), [output], "{arguments:?}");
    }
    let bench = Bench::new();
    std::fs::write(bench.path(".f1.png.kept"), "of rounds").expect("writes");
    bench.good(&render(&["-q", "-o", "f%d.png", "--frames", "2"]));
    assert_eq!(bench.names(), ["f0.png", "f1.png"]);
}

#[test]
fn an_animation_that_fails_leaves_no_lock() {
    let bench = Bench::new();
    let arguments = ["render", "--scene", "daylight", "--frames", "2", "-o", "a.gif", "--spp", "1", "-q"];
    assert!(bench.ends(2, &arguments).1.contains("panorama"));
    std::fs::create_dir(bench.path("d.gif")).expect("makes");
    bench.ends(3, &render(&["-q", "--frames", "2", "-o", "d.gif"]));
    let hidden: Vec<String> = bench.names().into_iter().filter(|n| n.ends_with(".lock")).collect();
    assert_eq!(hidden, Vec::<String>::new());
}

#[test]
fn default_names_tell_pictures_apart() {
    let bench = Bench::new();
    bench.good(&["generate", "-q", "cube", "-o", "a.obj"]);
    for (arguments, name) in [
        (&["round-brilliant:table=60"][..], "round-brilliant-table60-table.png"),
        (&["round-brilliant:table=50"], "round-brilliant-table50-table.png"),
        (&["cube", "--material", "quartz"], "cube-quartz-table.png"),
        (&["cube", "--material", "topaz"], "cube-topaz-table.png"),
        (&["cube", "--ri", "1.54"], "cube-n1.54-table.png"),
        (&["cube", "--size", "8"], "cube-8mm-table.png"),
        (&["--scene", "arrows"], "round-brilliant-arrows.png"),
        (&["cube", "--scene", "arrows", "--frames", "1"], "cube-arrows.gif"),
        (&["a.obj:material=topaz"], "a-materialtopaz-table.png"),
        (&["a.obj:ri=1.6"], "a-ri1.6-table.png"),
    ] {
        bench.good(&[&["render", "-q"], arguments, &TINY[..]].concat());
        assert!(bench.path(name).exists(), "{arguments:?}: {:?}", bench.names());
    }
    assert_eq!(bench.names().len(), 11);
}

/// Names that are not UTF-8 stay as they are, in every file that a picture has.
#[cfg(unix)]
#[test]
fn names_of_pictures_keep_their_bytes() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let bench = Bench::new();
    bench.good(&["generate", "-q", "cube", "-o", "a.obj"]);
    let [stone, picture, pass] =
        [&b"b\xff.obj"[..], b"b\xff-table.png", b"b\xff-table-caustic.png"].map(OsStr::from_bytes);
    let top = bench.path("");
    if std::fs::copy(bench.path("a.obj"), top.join(stone)).is_err() {
        return; // a file system that takes no such names
    }
    let made = bench.command(&["render", "-q", "--passes"]).arg(stone).args(TINY).output().expect("starts");
    assert!(made.status.success(), "{made:?}");
    assert!(top.join(picture).exists() && top.join(pass).exists(), "{:?}", std::fs::read_dir(&top));
}

#[test]
fn a_png_tells_its_program() {
    let bench = Bench::new();
    bench.good(&render(&["-q", "-o", "a.png"]));
    let bytes = std::fs::read(bench.path("a.png")).expect("was written");
    let reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("is a PNG");
    let texts = &reader.info().utf8_text;
    let software = texts.iter().find(|t| t.keyword == "Software").expect("is there");
    let version = concat!("cutlab ", env!("CARGO_PKG_VERSION"));
    assert_eq!(software.get_text().expect("is text"), version);
}

/// Pictures of the kinds that browsers show beside PNG: those of the PNG, JPEG within what it loses.
#[test]
fn jpeg_and_webp_show_what_the_png_shows() {
    let bench = Bench::new();
    let open = |name: &str| image::open(bench.path(name)).expect("is a picture").to_rgba8();
    let larger = ["--width", "64", "--spp", "4"];
    for name in ["a.png", "a.jpg", "a.webp"] {
        let arguments = ["render", "-q", "cube", "--photons", "500", "-o", name];
        bench.good(&[&arguments[..], &larger].concat());
    }
    let plain = open("a.png");
    assert_eq!(open("a.webp"), plain);
    let jpeg = open("a.jpg");
    let off: f64 = plain.iter().zip(jpeg.iter()).map(|(a, b)| f64::from(a.abs_diff(*b)).powi(2)).sum();
    let rms = (off / plain.len() as f64).sqrt();
    assert!(rms < 8.0, "{rms}");
}

#[test]
#[ignore = "half a minute: .ci/run runs it"]
fn long_work_in_a_pipe_tells_how_far_it_is() {
    let bench = Bench::new();
    let long = ["render", "cube", "--progressive", "--time", "33s", "--width", "40", "-o", "a.png"];
    let said = bench.good(&long);
    let told = said.lines().filter(|l| l.contains("round ") && l.contains("so far")).count();
    assert_eq!(told, 1, "{said}");
    assert!(said.contains("noise ") && said.contains("about ") && said.contains(" left"), "{said}");
    let short = ["render", "cube", "--progressive", "--rounds", "9", "--width", "40", "-o", "b.png"];
    assert_eq!(bench.good(&[&short[..], &["-q"]].concat()), "");
}

/// Without a stop of its own it ends at 2 % of noise, or after 100 rounds.
#[test]
fn a_progressive_picture_ends_by_itself() {
    let bench = Bench::new();
    let tiny = ["--width", "8", "--height", "6", "--photons", "50", "--nearest", "5", "-o", "a.png"];
    let said = bench.good(&[&["render", "cube", "--progressive"], &tiny[..]].concat());
    let told: Vec<f64> = said
        .lines()
        .find(|line| line.contains(" rounds, noise "))
        .map(|line| line.split([' ', ',']).filter_map(|word| word.parse().ok()).collect())
        .unwrap_or_default();
    let &[rounds, noise] = &told[..] else { panic!("{said}") };
    assert!((8.0..=100.0).contains(&rounds) && (noise <= 2.0 || rounds == 100.0), "{said}");
}
