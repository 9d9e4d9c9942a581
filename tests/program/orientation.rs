//! Stones on their side, upside down or leaning: they are noticed, and `--up` and `--align` turn them.

use cutlab::advanced::design::orientation::{doubt, turned_up, up_of};
use cutlab::advanced::design::{Design, library};
use cutlab::advanced::formats::{self};
use cutlab::advanced::stone::Stone;
use glam::{DMat3, DVec3};
use std::path::{Path, PathBuf};
use std::process::Command;

fn cut(name: &str) -> Design {
    Stone::parse(name).and_then(Stone::into_design).unwrap_or_else(|e| panic!("{e}"))
}

fn doubted(design: &Design) -> Option<String> {
    doubt(&design.solid().expect("closed"))
}

#[test]
fn every_cut_of_the_library_stands_upright() {
    for name in library::names() {
        assert_eq!(doubted(&cut(name)), None, "{name}");
        let long = Stone::parse(format!("{name}:length-to-width=1.6"));
        assert_eq!(long.ok().and_then(|stone| doubted(stone.design()?)), None, "{name}");
    }
}

#[test]
fn real_designs_stand_upright() {
    let Some(corpus) = std::env::var_os("CUTLAB_CORPUS").map(PathBuf::from) else { return };
    let mut seen = 0;
    let mut doubts = Vec::new();
    for entry in std::fs::read_dir(corpus.join("gemcad")).expect("a folder") {
        let path = entry.expect("an entry").path();
        if let Ok(imported) = formats::read(&path) {
            seen += 1;
            doubts.extend(doubted(&imported.design).map(|d| format!("{}: {d}", path.display())));
        }
    }
    assert!(seen > 300 && doubts.is_empty(), "{} of {seen}:\n{}", doubts.len(), doubts.join("\n"));
}

const CUTS: [&str; 8] =
    ["tolkowsky", "oval", "emerald", "pear", "princess", "classic", "trilliant", "round-brilliant:culet=2"];

#[test]
fn stones_on_their_side_leaning_or_upside_down_are_noticed_and_put_right() {
    for name in CUTS {
        let design = cut(name);
        for (how, rotation) in [
            ("y up", DMat3::from_rotation_x(-0.5 * std::f64::consts::PI)),
            ("x up", DMat3::from_rotation_y(0.5 * std::f64::consts::PI)),
            ("down", DMat3::from_rotation_x(std::f64::consts::PI)),
            ("7° off", DMat3::from_rotation_y(7f64.to_radians())),
            ("all ways", DMat3::from_rotation_x(2.0) * DMat3::from_rotation_y(1.0)),
        ] {
            let lying = design.clone().turned(rotation);
            assert!(doubted(&lying).is_some(), "{name}, {how}");
            let up = up_of(&lying.solid().expect("closed"));
            let off = up.angle_between(rotation * DVec3::Z).to_degrees();
            assert!(off < 0.01, "{name}, {how}: {off}°");
            let stood = lying.turned(turned_up(up));
            assert_eq!(doubted(&stood), None, "{name}, {how}");
        }
        assert!(up_of(&design.solid().expect("closed")).distance(DVec3::Z) < 1e-6, "{name}");
    }
}

#[test]
fn a_direction_is_turned_to_the_top_by_a_rotation() {
    for up in
        [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z, DVec3::new(1.0, 2.0, -3.0)]
    {
        let rotation = turned_up(up);
        assert!((rotation * up.normalize()).distance(DVec3::Z) < 1e-12, "{up}");
        assert!((rotation.determinant() - 1.0).abs() < 1e-12, "{up}");
    }
}

/// Runs cutlab in `folder`; standard output and error.
fn run(folder: &Path, arguments: &[&str]) -> (String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_cutlab"));
    let out = command.current_dir(folder).args(arguments).output().expect("runs");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    assert!(out.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&out.stderr));
    (text(out.stdout), text(out.stderr))
}

#[test]
fn every_command_takes_up_and_align_and_says_when_they_are_wanted() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |name: &str, rotation: DMat3| {
        let bytes = formats::encode(&cut("tolkowsky").turned(rotation), "obj").expect("is written");
        std::fs::write(folder.path().join(name), bytes).expect("writes");
    };
    write("up.obj", DMat3::IDENTITY);
    write("side.obj", DMat3::from_rotation_x(-0.5 * std::f64::consts::PI));
    write("down.obj", DMat3::from_rotation_x(std::f64::consts::PI));
    let wlr = |arguments: &[&str]| {
        let mut all = vec!["score", "--metrics", "wlr", "--error", "0.01"];
        all.extend(arguments);
        let (table, said) = run(folder.path(), &all);
        let mut rows = csv::Reader::from_reader(table.as_bytes());
        let at = rows.headers().expect("heads").iter().position(|h| h == "wlr").expect("a column");
        let row = rows.records().next().expect("a row").expect("is CSV");
        (row[at].parse::<f64>().expect("a number"), said.contains("does not stand table up"))
    };
    let (upright, doubted) = wlr(&["up.obj"]);
    assert!(!doubted);
    for (file, up) in [("side.obj", "y"), ("down.obj", "-z")] {
        let (_, doubted) = wlr(&[file]);
        assert!(doubted, "{file}");
        for turned in [&["--up", up][..], &["--align"]] {
            let mut arguments = vec![file];
            arguments.extend(turned);
            let (value, doubted) = wlr(&arguments);
            assert!(!doubted && (value - upright).abs() < 0.05, "{file} {turned:?}: {value} {upright}");
        }
    }
    let (text, _) = run(folder.path(), &["show", "side.obj"]);
    assert!(text.contains("does not stand table up"), "{text}");
    let (text, _) = run(folder.path(), &["show", "side.obj", "--align"]);
    assert!(text.contains("table           53.00 %") && !text.contains("table up"), "{text}");
    run(folder.path(), &["import", "side.obj", "--up", "y", "-o", "stood.stl"]);
    let stood = formats::read(&folder.path().join("stood.stl")).expect("is read").design;
    assert_eq!(doubt(&stood.solid().expect("closed")), None);
}

/// A frustum with its table up and a pit in its bottom: corners turned as told.
fn pitted(rotation: DMat3) -> String {
    let square = |half: f64, z: f64| {
        [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].map(|(x, y)| DVec3::new(x * half, y * half, z))
    };
    let mut corners = square(1.0, 0.5).to_vec();
    corners.extend(square(0.4, -0.5));
    corners.push(DVec3::new(0.0, 0.0, -0.2));
    let mut obj = String::new();
    for corner in corners {
        let v = rotation * corner;
        obj += &format!("v {} {} {}\n", v.x, v.y, v.z);
    }
    obj += "f 1 2 3 4\n";
    for i in 1..=4 {
        let next = i % 4 + 1;
        obj += &format!("f {next} {i} {} {}\n", i + 4, next + 4);
        obj += &format!("f {} {} 9\n", next + 4, i + 4);
    }
    obj
}

#[test]
fn stones_with_dents_are_turned_too() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let quarter = 0.5 * std::f64::consts::PI;
    for (name, rotation) in [
        ("up.obj", DMat3::IDENTITY),
        ("side.obj", DMat3::from_rotation_x(-quarter)),
        ("down.obj", DMat3::from_rotation_x(2.0 * quarter)),
    ] {
        std::fs::write(folder.path().join(name), pitted(rotation)).expect("writes");
    }
    let scored = |arguments: &[&str]| {
        let all = ["score", "--metrics", "wlr,leakage", "--ri", "2.4", "--error", "0.005"];
        let (table, said) = run(folder.path(), &[&all[..], arguments].concat());
        let row: Vec<String> = table.lines().nth(1).expect("a row").split(',').map(String::from).collect();
        let number = |i: usize| row[i].parse::<f64>().unwrap_or_else(|_| panic!("{table}"));
        ([number(3), number(5)], said.contains("does not stand table up"))
    };
    let (upright, doubted) = scored(&["up.obj"]);
    assert!(!doubted);
    let differs = |scores: [f64; 2]| scores.iter().zip(upright).any(|(a, b)| (a - b).abs() > 0.03);
    for (file, up) in [("side.obj", "y"), ("down.obj", "-z")] {
        let (scores, doubted) = scored(&[file]);
        // a flat base under crown facets alone is a rose cut's
        assert_eq!(doubted, file == "side.obj", "{file}");
        assert!(differs(scores), "{file}: {scores:?} {upright:?}");
        for turned in [&["--up", up][..], &["--align"]] {
            let (scores, doubted) = scored(&[&[file], turned].concat());
            assert!(!doubted && !differs(scores), "{file} {turned:?}: {scores:?} {upright:?}");
        }
    }
    // the shape that is shown and written stands so too: 2 × 2 × 1
    let (shown, _) = run(folder.path(), &["show", "side.obj"]);
    assert!(shown.contains("2.000000 × 1.000000 × 2.000000"), "{shown}");
    let (shown, _) = run(folder.path(), &["show", "side.obj", "--up", "y"]);
    assert!(shown.contains("2.000000 × 2.000000 × 1.000000"), "{shown}");
    run(folder.path(), &["import", "side.obj", "--align", "-o", "stood.obj"]);
    let (shown, _) = run(folder.path(), &["show", "stood.obj"]);
    assert!(shown.contains("2.000000 × 2.000000 × 1.000000"), "{shown}");
}
