//! Files that once took for ever: time and memory grow with a file no faster than the file does.

use super::cutlab;
use super::limits::refused;
use std::fmt::Write;
use std::fs;
use std::time::{Duration, Instant};

const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

fn shown_in_seconds(what: &str, name: &str, bytes: impl AsRef<[u8]>) -> String {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join(name), bytes).expect("written");
    let start = Instant::now();
    let out = cutlab(folder.path(), &format!("show {name}"));
    assert!(out.status.code().is_some_and(|c| c < 4), "{what}: {:?}", out.status);
    assert!(start.elapsed() < Duration::from_secs(20), "{what}: {:?}", start.elapsed());
    String::from_utf8_lossy(&out.stdout).into_owned() + &String::from_utf8_lossy(&out.stderr)
}

/// Corners that no face has, far away: all fell into one cell of the welder, and each was compared with all.
#[test]
fn unused_corners_far_away_cost_nothing() {
    let mut text = TETRAHEDRON.to_owned();
    for i in 0..300_000 {
        let _ = writeln!(text, "v {0}e300 {0}e300 {0}e300", 1.0 + f64::from(i) * 1e-6);
    }
    let said = shown_in_seconds("unused corners", "far.obj", text);
    assert!(said.contains("4 facets") || said.contains('4'), "{said}");
}

/// A mesh so far from the origin that all its corners fell into one cell.
#[test]
fn meshes_far_from_the_origin_are_welded_in_seconds() {
    let mut text = String::new();
    for i in 0..100_000u32 {
        let at = |k: u32| 1e30 + f64::from(i * 3 + k) * 1e20;
        let _ = writeln!(text, "v {0} {1} {0}\nv {1} {0} {1}\nv {0} {0} {1}", at(1), at(2));
    }
    (0..100_000).for_each(|i| text += &format!("f {} {} {}\n", 3 * i + 1, 3 * i + 2, 3 * i + 3));
    shown_in_seconds("a far mesh", "far.obj", text);
}

/// An outline that runs out and back: its spikes were taken off one by one from the front of a list.
#[test]
fn an_outline_of_spikes_is_cleared_in_seconds() {
    const N: usize = 400_000;
    let mut text = TETRAHEDRON.to_owned();
    (0..N).for_each(|i| text += &format!("v {i} {} 7\n", i % 3));
    text.push('f');
    // a, b, c … x y z … c, b: the ring closes on its own way back
    (0..N).chain((1..N - 2).rev()).for_each(|i| text += &format!(" {}", i + 5));
    text.push('\n');
    shown_in_seconds("spikes", "spikes.obj", text);
}

/// A mesh of many primitives without triangles, shown by many nodes.
#[test]
fn many_nodes_of_many_empty_primitives_are_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let list = |of: &str, n: usize| vec![of; n].join(",");
    let nodes: String = list("{\"mesh\":0}", 5000);
    let primitives = list("{\"attributes\":{\"POSITION\":0},\"mode\":0}", 5000);
    let gltf = format!(
        "{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{nodes}],\"meshes\":[{{\"primitives\":[{primitives}]}}],\
         \"accessors\":[{{\"bufferView\":0,\"count\":1,\"componentType\":5126,\"type\":\"VEC3\"}}],\
         \"bufferViews\":[{{\"buffer\":0,\"byteLength\":12}}],\"buffers\":[{{\"byteLength\":12,\
         \"uri\":\"data:application/octet-stream;base64,AAAAAAAAAAAAAAAA\"}}]}}"
    );
    fs::write(folder.path().join("many.gltf"), gltf).expect("written");
    refused(folder.path(), "show many.gltf", "more than 500000 faces of a mesh");
}

/// A table of thousands of corners: its extent was measured along every two of them, corner by corner.
#[test]
fn a_table_of_thousands_of_corners_is_measured_in_seconds() {
    let tier = |angle: &str, n: u32| {
        format!("[[tier]]\nangle = {angle}\ndistance = 1\nindices = [0]\nrepeat = {n}\n")
    };
    let text = tier("90", 3000) + &tier("0", 1) + &tier("-0.0", 1);
    let said = shown_in_seconds("a table", "prism.toml", text);
    assert!(said.contains("3002"), "{said}");
}

/// A text of other things: a remark on every line came to fifty times the file.
#[test]
fn remarks_on_lines_that_are_not_understood_come_to_an_end() {
    let text = "GemCad 5.0\ng 96 0\n".to_owned() + &"?\n".repeat(200_000);
    let tiers = "a 45 1 12 36 60 84\na -45 1 12 36 60 84\n";
    let said = shown_in_seconds("remarks", "text.asc", text + tiers);
    assert!(said.lines().count() < 100 && said.contains("more lines like these"), "{}", said.lines().count());
}

/// Words that a terminal would obey are shown escaped.
#[test]
fn what_files_say_is_told_without_control_characters() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let name = "evil\u{1b}[2J.asc";
    fs::write(folder.path().join(name), "GemCad 5.0\ng 96 0\na \u{1b}[2J\n").expect("written");
    let out = cutlab(folder.path(), &format!("show {name}"));
    assert!(!out.stderr.contains(&0x1b), "{:?}", String::from_utf8_lossy(&out.stderr));
}
