//! A changed design in the file it was read from: only what changed differs, and the planes come back.

mod design_files;
mod gem_cut_studio;
mod gemcad;

use crate::corpus_folder::corpus;
use cutlab::advanced::design::tiers::facet_normal;
use cutlab::advanced::design::{Design, Facet};
use cutlab::advanced::formats::write_back::Change;
use cutlab::advanced::formats::{self, Encoded, Input};
use cutlab::advanced::geometry::Plane;
use cutlab::advanced::limits::Limits;
use cutlab::advanced::materials::Material;
use cutlab::{ScoreRequest, Stone};
use glam::DVec3;
use std::path::Path;

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
fn a_change_that_is_none_of_the_file_is_refused() {
    let bytes = data("odd.asc");
    let mut other = read("odd.asc", &bytes);
    other.tiers.pop();
    let file = Input { name: "odd.asc", bytes: &bytes, folder: None, limits: Limits::default() };
    let refused = |design: &Design| {
        Change::new(design).write_back(&file).expect_err("is no change of this file").to_string()
    };
    let error = refused(&other);
    assert!(error.contains("has 21 facets, and the changed design 20"), "{error}");
    let error = refused(&read("odd.asc", &bytes).scaled_to_mm(3.0));
    assert!(error.contains("another unit"), "{error}");
    let mut open = read("odd.asc", &bytes);
    open.tiers[0].facets.iter_mut().for_each(|f| f.plane.normal = DVec3::Z);
    assert!(refused(&open).contains("open"), "{}", refused(&open));
    let mut none = read("odd.asc", &bytes);
    none.tiers[5].facets[0].plane.distance = f64::NAN;
    refused(&none);
    // other texts are told of
    let mut named = read("odd.asc", &bytes);
    named.headers.push("new".into());
    let out = written("odd.asc", &bytes, &named);
    assert_eq!(out.bytes, bytes);
    assert!(out.remarks[0].contains("texts"), "{:?}", out.remarks);
}

#[test]
fn a_mesh_is_written_anew_and_that_is_said() {
    let text = "[[tier]]\nangle = 90\nindices = [0]\nrepeat = 4\ndistance = 1\n\
                [[tier]]\nangle = 0\nindices = [0]\ndistance = 1\n\
                [[tier]]\nangle = -0.0\nindices = [0]\ndistance = 1\n";
    let cube = read("x.toml", text.as_bytes());
    let bytes = formats::encode(&cube, "obj").expect("is written");
    let mut taller = read("x.obj", &bytes);
    assert_eq!(written("x.obj", &bytes, &taller).bytes, bytes);
    taller.tiers[0].facets[0].plane.distance *= 1.5;
    let out = written("x.obj", &bytes, &taller);
    assert!(out.remarks[0].contains("written anew"), "{:?}", out.remarks);
    let volume = |d: &Design| d.solid().expect("closed").volume();
    assert!((volume(&read("x.obj", &out.bytes)) / volume(&taller) - 1.0).abs() < 1e-5);
}

#[test]
fn three_formats_hold_one_stone_to_the_last_digit_of_its_exact_scores() {
    let specs = ["round-brilliant:crown-angle=33.37,pavilion-angle=41.17,table=56.1", "classic", "emerald"];
    for spec in specs {
        let design = Stone::parse(spec).and_then(Stone::into_design).expect("a cut");
        let request = ScoreRequest::new(["iso", "cos"]).exact(true);
        let scores = |stone: Stone| {
            let stone = stone.with_material(Material::by_name("corundum").expect("known").clone());
            let scores = request.run(&stone).unwrap_or_else(|e| panic!("{spec}: {e}"));
            ["iso", "cos"].map(|m| scores.get(m).expect("a value").value)
        };
        let own = scores(Stone::from_design(design.clone()).expect("closed"));
        for format in ["asc", "gem", "gcs"] {
            let bytes = formats::encode(&design, format).expect("is written");
            let back = scores(Stone::from_bytes("x", &bytes, None).expect("reads"));
            for (a, b) in own.iter().zip(back) {
                println!("{spec} {format}: {a} {:e}", a - b);
                assert!((a - b).abs() < 1e-9, "{spec} {format}: {a} {b}");
            }
        }
    }
}

/// Files damaged at random places: whatever is still read is written back, or refused in one line.
#[test]
fn damaged_files_are_written_back_or_refused() {
    let gem = formats::encode(&read("odd.asc", &data("odd.asc")), "gem").expect("is written");
    let files = [
        ("x.asc", data("odd.asc")),
        ("x.gcs", data("odd.gcs")),
        ("x.toml", data("odd.toml")),
        ("x.gem", gem),
    ];
    for (seed, (name, bytes)) in files.into_iter().enumerate() {
        let mut state = 0x9E37_79B9_7F4A_7C15_u64.wrapping_add(seed as u64);
        let mut next = |below: usize| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state % below as u64) as usize
        };
        let (mut read, mut kept) = (0, 0);
        for _ in 0..400 {
            let mut damaged = bytes.clone();
            for _ in 0..=next(3) {
                let at = next(damaged.len());
                match next(3) {
                    0 => damaged[at] = b" \n0-9.\"<=[]#anG\0"[next(16)],
                    1 => drop(damaged.remove(at)),
                    _ => damaged.insert(at, damaged[next(damaged.len())]),
                }
            }
            let Ok(loaded) = formats::read_bytes(name, &damaged, None) else { continue };
            read += 1;
            let file = Input { name, bytes: &damaged, folder: None, limits: Limits::default() };
            let same = Change::new(&loaded.design).write_back(&file).expect("nothing changed");
            assert_eq!(same.bytes, damaged);
            let mut changed = stretched(&loaded.design, 1.01);
            changed.refractive_index = Some(1.7);
            match Change::new(&changed).write_back(&file) {
                Ok(_) => kept += 1,
                Err(error) => assert!(!error.to_string().contains('\n'), "{error}"),
            }
        }
        println!("{name}: {kept} of {read}");
        assert!(read > 50 && kept * 10 >= read * 9, "{name}: {kept} of {read}");
    }
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
