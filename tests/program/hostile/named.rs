//! What a scene, a design, a table or an output's place names is a regular file, or is refused in one line:
//! no device, no pipe that nobody writes to, no folder. A stone on the command line may be a pipe.

use super::cutlab;
use super::limits::{RENDER, refused};
use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// A scene that names `name` as the cut, as a mesh, or as a panorama.
fn scene(what: &str, name: &str) -> String {
    let (mut cut, mut mesh, mut sky) = (String::new(), String::new(), String::new());
    match what {
        "cut" => cut = format!("cut = \"{name}\"\n"),
        "mesh" => mesh = format!("[[surface]]\nmesh = \"{name}\"\nreflectance = 0.5\n"),
        _ => sky = format!("panorama = \"{name}\"\n"),
    }
    format!(
        "unit = \"stone\"\n[camera]\nat = [0, -5, 5]\nfield = 30\n[[stone]]\n{cut}{mesh}[[light]]\nkind = \"dome\"\nradiance = 1\n{sky}"
    )
}

/// A folder with a pipe, a folder, a file of 20 GB that takes no room, and a link to each of them and to a
/// device.
fn traps() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let at = |name: &str| folder.path().join(name);
    let made = Command::new("mkfifo").arg(at("pipe")).status().expect("mkfifo starts");
    assert!(made.success());
    fs::create_dir(at("folder")).expect("made");
    File::create(at("huge")).expect("made").set_len(20 << 30).expect("sparse files are known here");
    for (to, link) in
        [("pipe", "to-pipe"), ("folder", "to-folder"), ("huge", "to-huge"), ("/dev/zero", "to-zero")]
    {
        std::os::unix::fs::symlink(to, at(link)).expect("linked");
    }
    folder
}

const TRAPS: [(&str, &str); 7] = [
    ("pipe", "it is not a regular file"),
    ("to-pipe", "it is not a regular file"),
    ("folder", "it is not a regular file"),
    ("to-folder", "it is not a regular file"),
    ("/dev/zero", "it is not a regular file"),
    ("to-zero", "it is not a regular file"),
    ("to-huge", "bytes in a"),
];

#[test]
fn scenes_name_regular_files() {
    let folder = traps();
    for what in ["cut", "mesh", "panorama"] {
        for (name, says) in TRAPS {
            // a cut is looked for from here, the others from the scene's folder: the same here
            let name =
                if what == "cut" && !name.starts_with('/') { format!("./{name}") } else { name.into() };
            fs::write(folder.path().join("s.toml"), scene(what, &name)).expect("written");
            refused(folder.path(), &format!("{RENDER} --allow-outside"), says);
            if name.ends_with("zero") {
                refused(folder.path(), RENDER, "is outside the scene's folder");
            }
        }
        fs::write(folder.path().join("s.toml"), scene(what, "./nowhere")).expect("written");
        refused(folder.path(), RENDER, "s.toml, line ");
    }
}

/// What a scene names lies in its folder or below, unless the user allows more.
#[test]
fn scenes_name_files_in_any_folder_if_they_may() {
    let folder = traps();
    let at = |name: &str| folder.path().join(name);
    let good = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/good/octahedron.obj");
    fs::copy(good, at("stone.obj")).expect("copied");
    let picture = image::Rgb32FImage::from_pixel(8, 4, image::Rgb([1.0, 0.5, 0.25]));
    picture.save(at("sky.exr")).expect("written");
    for (what, name) in [("cut", "stone.obj"), ("mesh", "stone.obj"), ("panorama", "sky.exr")] {
        for name in [format!("../{name}"), at(name).display().to_string()] {
            fs::write(at("folder/s.toml"), scene(what, &name)).expect("written");
            refused(&at("folder"), RENDER, "is outside the scene's folder");
            let out = cutlab(&at("folder"), &format!("{RENDER} --allow-outside -q --force -o p.png"));
            assert!(out.status.success(), "{what} {name}: {}", String::from_utf8_lossy(&out.stderr));
        }
    }
}

/// A small scene cannot ask for much by naming a file again and again, nor for places beyond `f32`.
#[test]
fn what_scenes_name_is_counted_together() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let at = |name: &str| folder.path().join(name);
    // 450,000 small triangles over a square, five times
    let mut text = String::new();
    (0..671 * 671).for_each(|i| text += &format!("v {} {} 0\n", i % 671, i / 671));
    (0..670 * 671)
        .filter(|i| i % 671 < 670)
        .for_each(|i| text += &format!("f {} {} {}\n", i + 1, i + 2, i + 672));
    fs::write(at("many.obj"), text).expect("written");
    let surface = "[[surface]]\nmesh = \"many.obj\"\nreflectance = 0.5\n";
    fs::write(at("s.toml"), scene("mesh", "many.obj") + &surface.repeat(5)).expect("written");
    refused(folder.path(), RENDER, "more than 2000000 triangles of all meshes in a scene");
    // one in its place over and over: the tree was never finished
    let faces = "f 1 2 3\n".repeat(300_000);
    fs::write(at("same.obj"), format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{faces}")).expect("written");
    fs::write(at("s.toml"), scene("mesh", "same.obj")).expect("written");
    refused(folder.path(), RENDER, "more than 1000 triangles of a scene's mesh with the same bounds");
    fs::write(at("far.obj"), "v 0 0 0\nv 1e300 0 0\nv 0 1 0\nf 1 2 3\n").expect("written");
    fs::write(at("s.toml"), scene("mesh", "far.obj")).expect("written");
    refused(folder.path(), RENDER, "far.obj has a corner beyond ±1e9");
}

#[test]
fn designs_include_regular_files() {
    let folder = traps();
    for (name, says) in [
        ("pipe", "it is not a regular file"),
        ("folder", "it is not a regular file"),
        ("huge", "bytes in a design"),
    ] {
        let pbrt = format!("WorldBegin\nInclude \"{name}\"\nWorldEnd\n");
        fs::write(folder.path().join("stone.pbrt"), pbrt).expect("written");
        ends_in_one_line(folder.path(), "show stone.pbrt", says);
        // a buffer is fetched where a mesh needs it
        let gltf = format!(
            "{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{{\"mesh\":0}}],\"meshes\":[{{\"primitives\":\
             [{{\"attributes\":{{\"POSITION\":0}}}}]}}],\"accessors\":[{{\"bufferView\":0,\"count\":3,\
             \"componentType\":5126,\"type\":\"VEC3\"}}],\"bufferViews\":[{{\"buffer\":0,\"byteLength\":36}}],\
             \"buffers\":[{{\"byteLength\":36,\"uri\":\"{name}\"}}]}}"
        );
        fs::write(folder.path().join("stone.gltf"), gltf).expect("written");
        ends_in_one_line(folder.path(), "show stone.gltf", says);
    }
}

/// Fails with one line that says `says`, in little time.
fn ends_in_one_line(folder: &Path, arguments: &str, says: &str) {
    let start = Instant::now();
    let out = cutlab(folder, arguments);
    let said = String::from_utf8_lossy(&out.stderr);
    assert!(matches!(out.status.code(), Some(2 | 3)), "{arguments}: {:?} {said}", out.status);
    assert_eq!(said.trim_end().lines().count(), 1, "{arguments}: {said}");
    assert!(said.contains(says), "{arguments}: '{said}' without '{says}'");
    assert!(start.elapsed() < Duration::from_secs(20), "{arguments}: {:?}", start.elapsed());
}

/// A stone that is named on the command line is read to the limit, whatever it is; only what nobody writes
/// to is waited for.
#[test]
fn a_stone_on_the_command_line_may_be_a_pipe() {
    let folder = traps();
    let stone = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/good/octahedron.obj");
    let mut writer =
        Command::new("cp").arg(&stone).arg(folder.path().join("pipe")).spawn().expect("cp starts");
    let shown = cutlab(folder.path(), "show ./pipe");
    assert!(shown.status.success(), "{}", String::from_utf8_lossy(&shown.stderr));
    assert!(writer.wait().expect("ends").success());
    let mut show = Command::new(env!("CARGO_BIN_EXE_cutlab"));
    let show = show.args(["show", "/dev/stdin"]).stdin(Stdio::from(File::open(&stone).expect("opens")));
    assert!(show.output().expect("starts").status.success());
    for (name, says) in
        [("/dev/zero", "bytes in a design"), ("./huge", "bytes in a design"), ("./folder", "")]
    {
        ends_in_one_line(folder.path(), &format!("show {name}"), says);
    }
}

/// What cutlab keeps beside an output, and the maps and tables that it reads back.
#[test]
fn pipes_in_the_places_of_its_own_files_are_not_waited_for() {
    let folder = traps();
    let pipe = |name: &str| {
        let made = Command::new("mkfifo").arg(folder.path().join(name)).status().expect("mkfifo starts");
        assert!(made.success());
    };
    pipe(".t.csv.progress");
    ends_in_one_line(
        folder.path(),
        "score -q octahedron --metrics weight_ratio -o t.csv",
        "is not a regular file",
    );
    pipe(".o.obj.partial");
    ends_in_one_line(folder.path(), "generate -q octahedron -o o.obj", "is not a regular file");
    let render =
        "render -q octahedron --width 8 --height 6 --spp 1 --photons 40 --nearest 5 -o p.png --photon-map";
    for (name, says) in [
        ("pipe", "it is not a regular file"),
        ("/dev/zero", "it is not a regular file"),
        ("huge", "bytes in a photon map"),
    ] {
        ends_in_one_line(folder.path(), &format!("{render} {name}"), says);
    }
    pipe("a.csv");
    pipe("b.csv.meta.json");
    fs::write(folder.path().join("b.csv"), "stone\n").expect("written");
    for part in ["a.csv", "b.csv"] {
        ends_in_one_line(folder.path(), &format!("merge {part} -o all.csv"), "it is not a regular file");
    }
    // what an import would write over is left alone
    let stone = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/good/octahedron.obj");
    fs::copy(stone, folder.path().join("stone.obj")).expect("copied");
    // (a pipe is a stream, into which an import writes: tests/program/streams.rs)
    std::os::unix::fs::symlink("huge", folder.path().join("huge.stl")).expect("linked");
    ends_in_one_line(folder.path(), "import stone.obj -o huge.stl", "exists");
}
