//! `cutlab render` and its files: equal pictures are equal bytes, EXR layers add up, animations go on
//! where they stopped, scene files hold several stones, meshes and mirrors.

use exr::prelude::read_first_flat_layer_from_file;
use std::path::Path;

/// Runs the program in `folder`; its standard error if it fails.
fn cutlab(folder: &Path, arguments: &str) -> Result<(), String> {
    let out = std::process::Command::new(env!("CARGO_BIN_EXE_cutlab"))
        .args(arguments.split(' '))
        .current_dir(folder)
        .output()
        .expect("the program starts");
    if out.status.success() { Ok(()) } else { Err(String::from_utf8(out.stderr).expect("UTF-8")) }
}

const SMALL: &str = "render -q round-brilliant --width 32 --height 24 --spp 4 --photons 2000 --nearest 50";

#[test]
fn equal_pictures_are_equal_bytes_and_carry_their_command() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let read = |name: &str| std::fs::read(folder.path().join(name)).expect("was written");
    cutlab(folder.path(), &format!("{SMALL} -o a.png")).expect("renders");
    cutlab(folder.path(), &format!("{SMALL} --photon-map kept.map --output=sub/b.png")).expect("renders");
    assert_eq!(read("a.png"), read("sub/b.png"));
    let text = String::from_utf8_lossy(&read("a.png")).into_owned();
    let command = SMALL.replace("render -q", "render");
    assert!(text.contains("Command") && text.contains(&format!("cutlab {command}")));
    cutlab(folder.path(), &format!("{SMALL} --bits 16 -o deep.png")).expect("renders");
    assert_eq!(read("deep.png")[24], 16, "bits a channel in the header");
}

/// The request tells whether a file is the command's own: other words for the same replace it, another seed does not.
#[test]
fn a_picture_is_known_by_its_request() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for file in ["a.png", "a.exr", "a.jpg"] {
        cutlab(folder.path(), &format!("{SMALL} -o {file}")).expect("renders");
        cutlab(folder.path(), &format!("{SMALL} --seed 1 -o {file}")).expect("the same request");
        let error =
            cutlab(folder.path(), &format!("{SMALL} --seed 2 -o {file}")).expect_err("another request");
        assert!(error.contains("--force"), "{error}");
    }
}

#[test]
fn the_layers_of_an_exr_add_up_and_nothing_is_clamped() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    cutlab(folder.path(), &format!("{SMALL} -o a.exr")).expect("renders");
    let image = read_first_flat_layer_from_file(folder.path().join("a.exr")).expect("is an EXR");
    let channel = |name: &str| -> Vec<f32> {
        let list = &image.layer_data.channel_data.list;
        let found = list.iter().find(|c| c.name.to_string() == name).expect(name);
        found.sample_data.values_as_f32().collect()
    };
    let whole = channel("G");
    let passes: Vec<Vec<f32>> =
        ["direct", "caustic", "indirect", "stone"].iter().map(|p| channel(&format!("{p}.G"))).collect();
    for (i, value) in whole.iter().enumerate() {
        let sum: f32 = passes.iter().map(|p| p[i]).sum();
        assert!((sum - value).abs() <= 1e-5 * value.abs().max(1.0));
    }
    assert!(whole.iter().copied().fold(0.0, f32::max) > 1.0, "the lamp is in the stone");
    let (facets, depth) = (channel("facet.id"), channel("Z"));
    assert!(facets.contains(&0.0) && facets.iter().any(|f| *f > 0.0));
    assert!(depth.iter().all(|z| *z > 0.0));
}

#[test]
fn an_interrupted_animation_goes_on_at_the_missing_frame() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let at = |name: &str| folder.path().join(name);
    let render = format!("{SMALL} --scene arrows --frames 3 --turn stone --rock");
    cutlab(folder.path(), &format!("{render} -o f-%03d.png")).expect("renders");
    let frames: Vec<Vec<u8>> =
        (0..3).map(|i| std::fs::read(at(&format!("f-{i:03}.png"))).expect("was written")).collect();
    assert!(frames[0] != frames[1] && frames[1] != frames[2]);
    std::fs::remove_file(at("f-001.png")).expect("is there");
    let untouched = std::fs::metadata(at("f-000.png")).and_then(|m| m.modified()).expect("is there");
    cutlab(folder.path(), &format!("{render} -o f-%03d.png")).expect("renders");
    assert_eq!(std::fs::read(at("f-001.png")).expect("is there again"), frames[1]);
    assert_eq!(std::fs::metadata(at("f-000.png")).and_then(|m| m.modified()).expect("is there"), untouched);
    for (name, magic) in [("a.gif", &b"GIF89a"[..]), ("a.png", &b"\x89PNG"[..])] {
        cutlab(folder.path(), &format!("{render} -o {name}")).expect("renders");
        assert!(std::fs::read(at(name)).expect("was written").starts_with(magic));
        assert!(!at(&format!(".{name}.frames")).exists());
    }
    let refused = cutlab(folder.path(), &format!("{render} -o a.exr")).expect_err("no animation");
    assert!(refused.contains(".gif") && refused.lines().count() == 1, "{refused}");
}

#[test]
fn frames_of_another_stone_or_without_their_passes_are_made_anew() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let at = |name: &str| folder.path().join(name);
    let read = |name: &str| std::fs::read(at(name)).expect("was written");
    let render = "render -q x.toml --frames 2 --width 32 --height 24 --spp 1 --photons 500 --nearest 20";
    cutlab(folder.path(), "generate -q cube -o x.toml").expect("generates");
    cutlab(folder.path(), &format!("{render} -o f%d.png")).expect("renders");
    let of_cube = read("f0.png");
    cutlab(folder.path(), &format!("{render} -o f%d.png --passes")).expect("renders");
    assert_eq!(read("f0.png"), of_cube);
    assert!(at("f0-direct.png").exists() && at("f1-stone.png").exists(), "asked for later");
    cutlab(folder.path(), "generate -q octahedron -o x.toml --force").expect("generates");
    cutlab(folder.path(), &format!("{render} -o f%d.png")).expect("renders");
    cutlab(folder.path(), &format!("{render} -o g%d.png")).expect("renders");
    assert!(read("f0.png") != of_cube, "the file has another stone now");
    assert_eq!((read("f0.png"), read("f1.png")), (read("g0.png"), read("g1.png")));
}

/// A frame of a GIF that was read back is the one that was made.
#[test]
fn an_interrupted_gif_ends_in_the_same_bytes() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let at = |name: &str| folder.path().join(name);
    let render = format!("{SMALL} --frames 6 --turn stone -o a.gif");
    cutlab(folder.path(), &render).expect("renders");
    let whole = std::fs::read(at("a.gif")).expect("was written");
    std::fs::remove_file(at("a.gif")).expect("is there");
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_cutlab"))
        .args(render.split(' '))
        .current_dir(folder.path())
        .spawn()
        .expect("the program starts");
    while !at(".a.gif.frames/001.png").exists() && child.try_wait().expect("can be asked").is_none() {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    child.kill().expect("is killed");
    child.wait().expect("ends");
    assert!(!at("a.gif").exists() && at(".a.gif.frames/001.png").exists());
    cutlab(folder.path(), &render).expect("renders");
    assert_eq!(std::fs::read(at("a.gif")).expect("was written"), whole);
    assert!(!at(".a.gif.frames").exists());
}

#[test]
fn a_scene_file_holds_stones_meshes_and_mirrors() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    cutlab(folder.path(), "generate -q cube -o block.obj").expect("generates");
    let scene = r#"
about = "two stones, a block and a mirror"
unit = "mm"
[camera]
at = [0, -30, 20]
field = 40
[[stone]]
at = [-5, 0]
size = 6
[[stone]]
cut = "octahedron"
material = "ruby"
size = 5
at = [5, 0]
[[surface]]
corner = [-50, -50, 0]
u = [100, 0, 0]
v = [0, 100, 0]
reflectance = [0.5, 0.4, 0.3]
[[surface]]
corner = [-20, 12, 0]
u = [40, 0, 0]
v = [0, 0, 20]
mirror = true
reflectance = 0.9
[[surface]]
mesh = "block.obj"
at = [0, 6, 2]
reflectance = 0.6
[[light]]
kind = "sphere"
at = [8, -8, 20]
radius = 2
power = 9000
spectrum = "A"
[[light]]
kind = "dome"
radiance = 0.1
spectrum = "D65"
"#;
    std::fs::write(folder.path().join("two.toml"), scene).expect("written");
    let small = "--width 48 --height 36 --spp 4 --photons 2000 --nearest 50 --exposure auto";
    cutlab(folder.path(), &format!("render -q --scene two.toml {small} -o two.png")).expect("renders");
    let wrong = cutlab(folder.path(), "render --scene nothing.toml").expect_err("no such file");
    assert!(wrong.contains("nothing.toml"), "{wrong}");
    let three = cutlab(folder.path(), "render cube cube cube --scene two.toml").expect_err("too many");
    assert!(three.contains("2 stone"), "{three}");
}
