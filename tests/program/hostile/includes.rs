//! What a file includes lies in its own folder, is not without end, and belongs to it.

use super::cutlab;
use super::limits::refused;
use std::fs;
use std::path::Path;

const GOOD: &str = "tests/data/good";

/// A folder with a scene in `in/` that includes `name`, and a stone's mesh beside it and outside.
fn scene_including(name: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let at = |name: &str| folder.path().join(name);
    fs::create_dir_all(at("in/sub")).expect("made");
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join(GOOD).join("stone-mesh.inc");
    for copy in ["in/mesh.inc", "in/sub/mesh.inc", "outside.inc"] {
        fs::copy(&mesh, at(copy)).expect("copied");
    }
    fs::write(at("in/stone.pbrt"), format!("WorldBegin\nInclude \"{name}\"\nWorldEnd\n")).expect("written");
    folder
}

fn shown(folder: &Path) -> bool {
    cutlab(folder, "show in/stone.pbrt").status.success()
}

#[test]
fn only_files_in_the_folder_or_below_are_included() {
    for name in ["mesh.inc", "./mesh.inc", "sub/mesh.inc"] {
        assert!(shown(scene_including(name).path()), "{name}");
    }
    for name in [
        "../outside.inc",
        "sub/../../outside.inc",
        "/etc/passwd",
        "sub/../mesh.inc",
        "file:///etc/passwd",
        "..\\outside.inc",
        "C:\\x",
    ] {
        let folder = scene_including(name);
        refused(folder.path(), "show in/stone.pbrt", "line 2: expected a file in the scene's own folder");
    }
    let folder = scene_including("outside.inc");
    let absolute = folder.path().join("outside.inc").display().to_string();
    refused(scene_including(&absolute).path(), "show in/stone.pbrt", "the scene's own folder");
}

#[cfg(unix)]
#[test]
fn links_out_of_the_folder_are_not_followed() {
    use std::os::unix::fs::symlink;
    let folder = scene_including("link.inc");
    symlink("mesh.inc", folder.path().join("in/link.inc")).expect("linked");
    assert!(shown(folder.path()), "a link within the folder");
    let folder = scene_including("link.inc");
    symlink("../outside.inc", folder.path().join("in/link.inc")).expect("linked");
    refused(folder.path(), "show in/stone.pbrt", "the scene's own folder");
    let folder = scene_including("up/outside.inc");
    symlink("..", folder.path().join("in/up")).expect("linked");
    refused(folder.path(), "show in/stone.pbrt", "the scene's own folder");
}

#[test]
fn inclusion_ends() {
    let folder = scene_including("0.inc");
    let at = |name: &str| folder.path().join("in").join(name);
    // itself, and two that include each other
    fs::write(at("0.inc"), "Include \"0.inc\"").expect("written");
    refused(folder.path(), "show in/stone.pbrt", "more than 8 nested levels of Include");
    fs::write(at("0.inc"), "Include \"1.inc\" Include \"1.inc\"").expect("written");
    fs::write(at("1.inc"), "Include \"0.inc\" Include \"0.inc\"").expect("written");
    refused(folder.path(), "show in/stone.pbrt", "more than 8 nested levels of Include");
    // a chain of eight is followed, one of nine is not
    for i in 0..9 {
        fs::write(at(&format!("{i}.inc")), format!("Include \"{}.inc\"", i + 1)).expect("written");
    }
    fs::copy(at("mesh.inc"), at("7.inc")).expect("copied");
    assert!(shown(folder.path()));
    fs::write(at("7.inc"), "Include \"8.inc\"").expect("written");
    fs::copy(at("mesh.inc"), at("8.inc")).expect("copied");
    refused(folder.path(), "show in/stone.pbrt", "7.inc, line 1: more than 8 nested levels");
    // empty files again and again, and forty files that each include forty
    fs::write(at("0.inc"), "Include \"empty.inc\"\n".repeat(5000)).expect("written");
    fs::write(at("empty.inc"), "").expect("written");
    refused(folder.path(), "show in/stone.pbrt", "more than 1000 files included");
    fs::write(at("7.inc"), "").expect("written");
    for i in 0..7 {
        fs::write(at(&format!("{i}.inc")), format!("Include \"{}.inc\"\n", i + 1).repeat(40))
            .expect("written");
    }
    refused(folder.path(), "show in/stone.pbrt", "more than 1000 files included");
}

/// A table's progress belongs to what its stones include, too.
#[test]
fn what_is_included_is_part_of_a_tables_identity() {
    let folder = scene_including("mesh.inc");
    let study = || {
        let out = cutlab(folder.path(), "score -q in/stone.pbrt --metrics weight_ratio -o t.csv");
        assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
        let meta = fs::read(folder.path().join("t.csv.meta.json")).expect("was written");
        let meta: serde_json::Value = serde_json::from_slice(&meta).expect("JSON");
        meta["study"].as_str().expect("a digest").to_owned()
    };
    let mesh = folder.path().join("in/mesh.inc");
    let (before, again) = (study(), study());
    assert_eq!(before, again);
    let text = fs::read_to_string(&mesh).expect("is there");
    fs::write(&mesh, format!("Scale 1 1 1.25\n{text}")).expect("written");
    assert_ne!(study(), before, "another stone");
}
