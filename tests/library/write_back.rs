//! A changed design in the file it was read from: only what changed differs, and the planes come back.

use cutlab::advanced::design::tiers::facet_normal;
use cutlab::advanced::design::{Design, Facet};
use cutlab::advanced::formats::write_back::Change;
use cutlab::advanced::formats::{self, Encoded, Input};
use cutlab::advanced::geometry::Plane;
use cutlab::advanced::limits::Limits;
use glam::DVec3;
use std::path::{Path, PathBuf};

fn data(name: &str) -> Vec<u8> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/write_back").join(name);
    std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

fn read(name: &str, bytes: &[u8]) -> Design {
    formats::read_bytes(name, bytes, None).unwrap_or_else(|e| panic!("{name}: {e}")).design
}

fn written(name: &str, bytes: &[u8], design: &Design) -> Encoded {
    let file = Input { name, bytes, folder: None, limits: Limits::default() };
    Change::new(design).write_back(&file).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// The design with a tier at another angle, by its number from 0: same indices, same distance.
fn with_angle(design: &Design, tier: usize, angle_deg: f64) -> Design {
    let mut design = design.clone();
    let gear = design.gear;
    let tier = &mut design.tiers[tier];
    tier.angle_deg = Some(angle_deg);
    for facet in &mut tier.facets {
        facet.plane.normal = facet_normal(gear, angle_deg, facet.index.expect("cut by index"));
    }
    design
}

/// The design stretched along its axis about a height: an affine map, so whatever met still does.
fn stretched(design: &Design, by: f64) -> Design {
    let mut design = design.clone();
    for tier in &mut design.tiers {
        tier.angle_deg = None;
        for facet in &mut tier.facets {
            let normal = facet.plane.normal * DVec3::new(1.0, 1.0, by.recip());
            facet.plane =
                Plane { normal: normal.normalize(), distance: facet.plane.distance / normal.length() };
        }
    }
    design
}

fn size(design: &Design) -> f64 {
    design.facets().map(|f| f.plane.distance.abs()).fold(0.0, f64::max)
}

/// How far the planes of one are from those of the other, facet by facet, in parts of the stone's size.
fn distance(a: &Design, b: &Design) -> f64 {
    assert_eq!(a.facets().count(), b.facets().count());
    let off = |(f, g): (&Facet, &Facet)| {
        let along = (f.plane.distance - g.plane.distance).abs() / size(b);
        f.plane.normal.distance(g.plane.normal).max(along)
    };
    a.facets().zip(b.facets()).map(off).fold(0.0, f64::max)
}

fn assert_same_texts(name: &str, a: &Design, b: &Design) {
    assert_eq!((&a.name, &a.headers, &a.footers), (&b.name, &b.headers, &b.footers), "{name}");
    assert_eq!((a.gear, a.symmetry), (b.gear, b.symmetry), "{name}");
    let names = |d: &Design| d.facets().map(|f| f.name.clone()).collect::<Vec<_>>();
    assert_eq!(names(a), names(b), "{name}");
    let tiers = |d: &Design| {
        d.tiers.iter().map(|t| (t.name.clone(), t.instructions.clone(), t.facets.len())).collect::<Vec<_>>()
    };
    assert_eq!(tiers(a), tiers(b), "{name}");
}

/// The lines of a file in Windows-1252 that differ from those of another: number from 1, old, new.
fn changed_lines(old: &[u8], new: &[u8]) -> Vec<(usize, String, String)> {
    let text = |bytes: &[u8]| bytes.iter().map(|b| char::from(*b)).collect::<String>();
    let (old, new) = (text(old), text(new));
    assert_eq!(old.split("\r\n").count(), new.split("\r\n").count(), "{new}");
    let both = old.split("\r\n").zip(new.split("\r\n")).enumerate();
    both.filter(|(_, (a, b))| a != b).map(|(i, (a, b))| (i + 1, a.into(), b.into())).collect()
}

#[test]
fn gemcad_text_keeps_every_byte_but_the_words_that_changed() {
    let bytes = data("odd.asc");
    let before = read("odd.asc", &bytes);
    let same = written("odd.asc", &bytes, &before);
    assert_eq!((same.bytes, same.remarks), (bytes.clone(), Vec::<String>::new()));
    // a tier's angle is one word
    let steeper = with_angle(&before, 3, 36.5);
    let out = written("odd.asc", &bytes, &steeper).bytes;
    assert_eq!(changed_lines(&bytes, &out), [(17, "a 35 0.80".into(), "a 36.500000 0.80".into())]);
    // a distance is another, and a glued angle stays glued
    let mut changed = with_angle(&before, 4, 41.75);
    changed.tiers[4].facets.iter_mut().for_each(|f| f.plane.distance = 0.912345678901234);
    changed.refractive_index = Some(1.76);
    let out = written("odd.asc", &bytes, &changed).bytes;
    let lines = changed_lines(&bytes, &out);
    assert_eq!(lines[0], (5, "I 1.540".into(), "I 1.76".into()));
    assert_eq!(lines[1].2, "a41.750000 0.912345678901234 96 24 48 n Star");
    assert_eq!(lines.len(), 2);
    let again = read("odd.asc", &out);
    assert_eq!(again.refractive_index, Some(1.76));
    assert!(distance(&again, &changed) < 1e-15);
    assert_same_texts("odd.asc", &again, &before);
    // indices that no longer hold are replaced, fractional where they must be
    let turn = (3.3 / 96.0) * std::f64::consts::TAU;
    let turned = before.clone().turned(glam::DMat3::from_rotation_z(turn));
    let out = written("odd.asc", &bytes, &turned).bytes;
    let again = read("odd.asc", &out);
    assert!(distance(&again, &turned) < 1e-12);
    assert_same_texts("odd.asc", &again, &before);
    assert!(out.split(|b| *b == b'\n').all(|line| line.len() <= 80));
}

#[test]
fn a_gemcad_tier_that_comes_apart_is_split_with_its_instructions_last() {
    let bytes = data("odd.asc");
    let mut changed = read("odd.asc", &bytes);
    let gear = changed.gear;
    for facet in &mut changed.tiers[0].facets[2..] {
        facet.plane.normal = facet_normal(gear, -41.0, facet.index.expect("by index"));
        facet.plane.distance = 0.71;
    }
    let out = written("odd.asc", &bytes, &changed).bytes;
    let text: String = out.iter().map(|b| char::from(*b)).collect();
    assert!(
        text.contains(
            "a -40.00  0.70000000 -96 n P1 -72\r\na -41.000000 0.71000000 -48 n P1 -24 G Centre\u{b7}point\r\n"
        ),
        "{text}"
    );
    let again = read("odd.asc", &out);
    assert!(distance(&again, &changed) < 1e-15);
    let texts: Vec<_> = again.tiers[..2].iter().map(|t| (&*t.name, &*t.instructions)).collect();
    assert_eq!(texts, [("P1", ""), ("P1", "Centre·point")]);
}

#[test]
fn an_origin_that_comes_to_lie_outside_is_moved_and_that_is_said() {
    let bytes = data("odd.asc");
    let mut changed = read("odd.asc", &bytes);
    for facet in changed.tiers.iter_mut().flat_map(|t| &mut t.facets) {
        facet.plane = facet.plane.moved(DVec3::new(0.0, 0.0, 2.0));
    }
    let out = written("odd.asc", &bytes, &changed);
    assert!(out.remarks[0].contains("origin"), "{:?}", out.remarks);
    let volume = |d: &Design| d.solid().expect("closed").volume();
    let again = read("odd.asc", &out.bytes);
    assert!((volume(&again) / volume(&changed) - 1.0).abs() < 1e-12);
}

#[test]
fn a_change_that_is_none_of_the_file_is_refused() {
    let bytes = data("odd.asc");
    let mut other = read("odd.asc", &bytes);
    other.tiers.pop();
    let file = Input { name: "odd.asc", bytes: &bytes, folder: None, limits: Limits::default() };
    let error = Change::new(&other).write_back(&file).expect_err("a facet is missing").to_string();
    assert!(error.contains("has 21 facets, and the changed design 20"), "{error}");
    // other texts are told of
    let mut named = read("odd.asc", &bytes);
    named.headers.push("new".into());
    let out = written("odd.asc", &bytes, &named);
    assert_eq!(out.bytes, bytes);
    assert!(out.remarks[0].contains("texts"), "{:?}", out.remarks);
}

fn corpus() -> Option<PathBuf> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder =
        std::env::var_os("CUTLAB_CORPUS").map_or_else(|| here.join("../shared/corpus"), PathBuf::from);
    if !folder.join("geometry.csv").is_file() {
        println!("no corpus at {}: set CUTLAB_CORPUS; nothing was checked", folder.display());
        return None;
    }
    Some(folder)
}

#[test]
fn real_designs_come_back_unchanged_and_stretched() {
    let Some(corpus) = corpus() else { return };
    let folders = ["gemcad", "pairs", "other"].map(|f| corpus.join(f));
    let files = folders.iter().flat_map(|f| std::fs::read_dir(f).expect("the corpus is there"));
    let mut counts = std::collections::BTreeMap::<&str, usize>::new();
    for path in files.map(|f| f.expect("a file").path()) {
        let name = path.display().to_string();
        let Ok(loaded) = formats::read(&path) else { continue };
        let bytes = std::fs::read(&path).expect("was read");
        let before = loaded.design;
        assert_eq!(written(&name, &bytes, &before).bytes, bytes, "{name}");
        let changed = stretched(&before, 1.01);
        let out = written(&name, &bytes, &changed);
        assert!(out.remarks.is_empty(), "{name}: {:?}", out.remarks);
        let again = read(&name, &out.bytes);
        assert!(distance(&again, &changed) < 1e-12, "{name}: {:e}", distance(&again, &changed));
        assert_same_texts(&name, &again, &before);
        *counts.entry(loaded.format).or_default() += 1;
    }
    println!("{counts:?}");
    assert!(counts.values().sum::<usize>() > 300, "{counts:?}");
}
