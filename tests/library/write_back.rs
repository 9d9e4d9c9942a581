//! A changed design in the file it was read from: only what changed differs, and the planes come back.

use cutlab::advanced::design::tiers::facet_normal;
use cutlab::advanced::design::{Design, Facet};
use cutlab::advanced::formats::write_back::Change;
use cutlab::advanced::formats::{self, Encoded, Input};
use cutlab::advanced::geometry::Plane;
use cutlab::advanced::limits::Limits;
use cutlab::advanced::materials::Material;
use cutlab::{ScoreRequest, Stone};
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
fn a_table_without_an_index_keeps_its_form_until_it_is_tilted() {
    let text = "g 96 0\nI 1.54\na -42 0.7 96 24 48 72 G centre point\na 90 1 96 24 48 72\na 0 0.4\n";
    let mut design = read("mine.asc", text.as_bytes());
    design.tiers[2].facets[0].plane.distance = 0.45;
    let out = written("mine.asc", text.as_bytes(), &design).bytes;
    assert_eq!(String::from_utf8(out).expect("text"), text.replace("0.4\n", "0.45000000\n"));
    let tilted = with_angle(&design, 2, 3.0);
    let out = written("mine.asc", text.as_bytes(), &tilted).bytes;
    let out = String::from_utf8(out).expect("text");
    assert_eq!(out, text.replace("a 0 0.4\n", "a 3.000000 0.45000000 96\n"));
    assert!(distance(&read("mine.asc", out.as_bytes()), &tilted) < 1e-15);
    // no index of refraction yet
    let none = text.replace("I 1.54\n", "");
    let mut drawn = read("mine.asc", none.as_bytes());
    drawn.refractive_index = Some(1.54);
    assert_eq!(written("mine.asc", none.as_bytes(), &drawn).bytes, text.as_bytes());
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

/// A facet of a GemCad binary file: plane, key, text and corners.
type Record = (Plane, i32, Vec<u8>, Vec<DVec3>);

/// What a GemCad binary file holds: its facets, and where they end.
fn records(bytes: &[u8]) -> (Vec<Record>, usize) {
    let float = |at: usize| f64::from_le_bytes(bytes[at..at + 8].try_into().expect("eight bytes"));
    let int = |at: usize| i32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes"));
    let point = |at: usize| DVec3::new(float(at), -float(at + 8), float(at + 16));
    let (mut all, mut at) = (Vec::new(), 0);
    while float(at) != -99999.0 {
        let p = point(at);
        let plane = Plane { normal: p.normalize(), distance: p.length().recip() };
        let key = int(at + 24);
        let end = at + 29 + usize::from(bytes[at + 28]);
        let text = bytes[at + 29..end].to_vec();
        at = end;
        let mut corners = Vec::new();
        while int(at) == 1 {
            corners.push(point(at + 4));
            at += 28;
        }
        at += 4;
        all.push((plane, key, text, corners));
    }
    (all, at)
}

#[test]
fn gemcad_binary_keeps_its_texts_its_keys_and_its_preform() {
    let square = read("odd.asc", &data("odd.asc"));
    let mut bytes = formats::encode(&square, "gem").expect("is written");
    let preform = [b"\x07preform", &bytes[..], b"\x1A\0anything"].concat();
    bytes.extend(&preform);
    let before = read("odd.gem", &bytes);
    assert_eq!(written("odd.gem", &bytes, &before).bytes, bytes);
    let mut changed = with_angle(&before, 3, 36.5);
    changed.refractive_index = Some(1.76);
    let out = written("odd.gem", &bytes, &changed);
    assert!(out.remarks.is_empty() && out.bytes.ends_with(&preform));
    let again = read("odd.gem", &out.bytes);
    assert!(distance(&again, &changed) < 1e-15);
    assert_same_texts("odd.gem", &again, &before);
    assert_eq!(again.refractive_index, Some(1.76));
    let ((old, old_end), (new, new_end)) = (records(&bytes), records(&out.bytes));
    // after the facets only the index of refraction differs
    let mut tail = bytes[old_end..].to_vec();
    tail[20..28].copy_from_slice(&1.76f64.to_le_bytes());
    assert_eq!(out.bytes[new_end..], tail);
    let mut kept = 0;
    for (old, new) in old.iter().zip(&new) {
        assert_eq!((old.1, &old.2), (new.1, &new.2));
        kept += usize::from(old.0 == new.0 && old.3 == new.3);
        for corner in &new.3 {
            assert!(new.0.signed_distance(*corner).abs() < 1e-14);
        }
    }
    // the pavilion and what touches no changed facet
    assert!((1..old.len() - 4).contains(&kept), "{kept}");
    // of a tier that comes apart the rest gets a key of its own
    let mut apart = before.clone();
    for facet in &mut apart.tiers[0].facets[2..] {
        facet.plane.distance *= 1.01;
    }
    let out = written("odd.gem", &bytes, &apart).bytes;
    let (split, _) = records(&out);
    assert_eq!([0, 1].map(|i| split[i].1), [0, 1].map(|i| old[i].1));
    let free = old.iter().map(|r| r.1).max().expect("facets") + 1;
    assert_eq!([2, 3].map(|i| split[i].1), [free; 2]);
    assert!(distance(&read("odd.gem", &out), &apart) < 1e-15);
    // an index of refraction that has no place
    let (_, end) = records(&bytes);
    let short = &bytes[..end];
    let mut drawn = read("short.gem", short);
    drawn.refractive_index = Some(1.6);
    let out = written("short.gem", short, &drawn);
    assert_eq!(out.bytes, short);
    assert!(out.remarks[0].contains("index of refraction"), "{:?}", out.remarks);
}

#[test]
fn gem_cut_studio_keeps_everything_but_the_numbers_of_the_facets_that_changed() {
    let bytes = data("odd.gcs");
    let before = read("odd.gcs", &bytes);
    assert_eq!(written("odd.gcs", &bytes, &before).bytes, bytes);
    let changed = with_angle(&before, 1, -43.0);
    let out = written("odd.gcs", &bytes, &changed);
    assert_eq!(out.remarks, ["facets of guides and hidden tiers stay where they were"]);
    let again = read("odd.gcs", &out.bytes);
    assert!(distance(&again, &changed) < 1e-15);
    assert_same_texts("odd.gcs", &again, &before);
    let lines = changed_lines(&bytes, &out.bytes);
    assert_eq!(lines[0].0, 7, "{lines:?}");
    let tier = lines.iter().find(|(_, old, _)| old.contains("<tier")).expect("the angle");
    assert_eq!(tier.2, tier.1.replace("\"138\"", "\"137\""));
    let facets = lines.iter().filter(|(_, old, _)| old.contains("<facet")).count();
    let corners = lines.iter().filter(|(_, old, _)| old.contains("<vertex")).count();
    // four facets, their twelve corners and the eight of the girdle's lower edge
    assert_eq!((facets, corners, lines.len()), (4, 20, 25), "{lines:?}");
    let text: String = out.bytes.iter().map(|b| char::from(*b)).collect();
    let xml = roxmltree::Document::parse(&text).expect("XML");
    let value = |node: &roxmltree::Node, key: &str| -> f64 {
        node.attribute(key).and_then(|v| v.parse().ok()).unwrap_or_else(|| panic!("{key}"))
    };
    for vertex in xml.descendants().filter(|n| n.has_tag_name("vertex")) {
        let facet = vertex.parent_element().expect("in a facet");
        let n = DVec3::new(value(&facet, "nx"), value(&facet, "ny"), value(&facet, "nz"));
        let v = DVec3::new(value(&vertex, "x"), value(&vertex, "y"), value(&vertex, "z"));
        let depth = value(&facet.parent_element().expect("in a tier"), "depth");
        assert!((n.dot(v) - depth).abs() < 1e-12);
    }
    // another stone
    let mut drawn = before.clone();
    drawn.refractive_index = Some(1.76);
    let out = written("odd.gcs", &bytes, &drawn);
    let lines = changed_lines(&bytes, &out.bytes);
    assert_eq!(lines.len(), 1);
    assert_eq!(lines[0].2, lines[0].1.replace("1.540", "1.76"));
    assert!(out.remarks.iter().any(|r| r.contains("material, dispersion, density")), "{:?}", out.remarks);
}

#[test]
fn a_gem_cut_studio_tier_that_comes_apart_is_split_and_corners_follow() {
    let bytes = data("odd.gcs");
    let mut changed = read("odd.gcs", &bytes);
    // two facets deeper: the culet becomes an edge
    for facet in &mut changed.tiers[1].facets[2..] {
        facet.plane.distance += 0.05;
    }
    let out = written("odd.gcs", &bytes, &changed).bytes;
    let again = read("odd.gcs", &out);
    assert!(distance(&again, &changed) < 1e-15);
    let texts: Vec<_> = again.tiers.iter().map(|t| (&*t.name, &*t.instructions, t.facets.len())).collect();
    assert_eq!(texts[1..3], [("P1", "", 2), ("P1", "Cut to a point.", 2)]);
    assert_eq!(again.tiers.len(), 5);
    let stored = |bytes: &[u8]| {
        let text: String = bytes.iter().map(|b| char::from(*b)).collect();
        let xml = roxmltree::Document::parse(&text).expect("XML");
        xml.descendants().filter(|n| n.has_tag_name("vertex")).count()
    };
    let solid = changed.solid().expect("closed");
    assert_eq!(stored(&out), solid.faces.iter().map(|f| f.corners.len()).sum::<usize>());
    assert_ne!(stored(&out), stored(&bytes));
}

fn toml(text: &str) -> Design {
    read("odd.toml", text.as_bytes())
}

#[test]
fn a_design_file_keeps_its_comments_and_its_rules() {
    let text = String::from_utf8(data("odd.toml")).expect("text");
    let before = toml(&text);
    let after = |change: &dyn Fn(&mut Design)| {
        let mut design = before.clone();
        change(&mut design);
        let out = written("odd.toml", text.as_bytes(), &design);
        let new = String::from_utf8(out.bytes).expect("text");
        let again = toml(&new);
        assert!(distance(&again, &design) < 1e-12, "{new}");
        assert_same_texts("odd.toml", &again, &design);
        (new, out.remarks)
    };
    assert_eq!(after(&|_| ()), (text.clone(), Vec::new()));
    // what is built with another angle is written as that angle, and the rules stay
    let steeper = text.replace("angle = -43 ", "angle = -42.5 ");
    let (new, remarks) = after(&|design| *design = toml(&steeper));
    assert_eq!(new, steeper);
    assert_eq!(remarks, ["the proportions under [expect] stay as they were"]);
    // a table of no rule is written by distance, its comment kept
    let (new, remarks) = after(&|design| design.tiers[3].facets[0].plane.distance = 0.5);
    assert_eq!(new, text.replace("table = 0.55 #", "distance = 0.5\nnames = [\"table\"] #"));
    assert!(remarks[1].contains("tier 'table': its rule gives other planes"), "{remarks:?}");
    // both lines of a rule go, and the rule of the tier after it still holds
    let crown = |design: &mut Design| {
        let distance = design.tiers[2].facets[0].plane.distance + 0.01;
        design.tiers[2].facets.iter_mut().for_each(|f| f.plane.distance = distance);
    };
    let table = |design: &mut Design| {
        let mut built = text.clone();
        let distance = design.tiers[2].facets[0].plane.distance;
        let rule = "meets = \"pavilion main@0 & pavilion main@24 & girdle@0\"";
        built = built.replace(rule, &format!("distance = {distance}")).replace("girdle = 0.02\n", "");
        *design = toml(&built);
    };
    let (new, remarks) = after(&|design| {
        crown(design);
        table(design);
    });
    assert!(new.contains("# the corner\ninstructions") && new.contains("table = 0.55 # of W"), "{new}");
    assert_eq!(remarks.len(), 2, "{remarks:?}");
    // a tier that came apart, and the index of refraction
    let (new, remarks) = after(&|design| {
        let more = &mut design.tiers[0].facets[2..];
        more.iter_mut().for_each(|f| f.plane.distance = 1.01);
        let apart = design.tiers[0].facets.split_off(2);
        let part = cutlab::advanced::design::Tier { facets: apart, ..design.tiers[0].clone() };
        design.tiers.insert(1, part);
        design.refractive_index = Some(1.76);
    });
    assert!(new.starts_with("# a square of four mains, by hand\nrefractive-index = 1.76\n"), "{new}");
    assert!(new.contains("# the table last") && remarks.iter().any(|r| r.contains("written anew")), "{new}");
}

#[test]
fn families_take_parameters_and_explicit_planes_stay_explicit() {
    let family = "# mine\nname = \"x\"\nfamily = \"round-brilliant\"\n\n[parameters]\ntable = 57 # wide\n";
    let built = toml(&family.replace("57", "58").replace("# wide", "# wide\ncrown-angle = 33.5"));
    let file = Input { name: "x.toml", bytes: family.as_bytes(), folder: None, limits: Limits::default() };
    let parameters = [("table", 58.0), ("crown-angle", 33.5)].map(|(k, v)| (k.to_owned(), v)).into();
    let out = Change { design: &built, parameters }.write_back(&file).expect("is written");
    let new = String::from_utf8(out.bytes).expect("text");
    assert!(new.contains("table = 58 # wide") && new.contains("crown-angle = 33.5"), "{new}");
    assert!(distance(&toml(&new), &built) < 1e-15);
    // other facets too
    let step = "family = \"step-cut\"\n";
    let more = toml(&format!("{step}[parameters]\ncrown-steps = 4\n"));
    let file = Input { name: "y.toml", bytes: step.as_bytes(), ..file };
    let parameters: std::collections::BTreeMap<_, _> = [("crown-steps".to_owned(), 4.0)].into();
    let out = Change { design: &more, parameters: parameters.clone() }.write_back(&file).expect("is written");
    let new = String::from_utf8(out.bytes).expect("text");
    assert!(new.starts_with(step) && distance(&toml(&new), &more) < 1e-15, "{new}");
    // which are a design file's alone
    let asc = data("odd.asc");
    let design = read("odd.asc", &asc);
    let file = Input { name: "odd.asc", bytes: &asc, folder: None, limits: Limits::default() };
    assert!(Change { design: &design, parameters }.write_back(&file).is_err());
    // planes alone are not the family's
    let out = written("x.toml", family.as_bytes(), &built);
    assert!(out.remarks[0].contains("family"), "{:?}", out.remarks);
    assert!(distance(&toml(&String::from_utf8(out.bytes).expect("text")), &built) < 1e-15);

    let cube = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/good/cube.toml"));
    let cube = cube.expect("is there");
    let mut taller = toml(&cube);
    taller.tiers[2].facets[0].plane.distance = 3.5;
    let out = written("cube.toml", cube.as_bytes(), &taller).bytes;
    let new = String::from_utf8(out).expect("text");
    let last = cube.rfind("3.0").expect("the culet's");
    assert_eq!(new, format!("{}3.5{}", &cube[..last], &cube[last + 3..]));
}

#[test]
fn a_mesh_is_written_anew_and_that_is_said() {
    let cube = toml(
        "[[tier]]\nangle = 90\nindices = [0]\nrepeat = 4\ndistance = 1\n[[tier]]\nangle = 0\nindices = [0]\n\
                     distance = 1\n[[tier]]\nangle = -0.0\nindices = [0]\ndistance = 1\n",
    );
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
