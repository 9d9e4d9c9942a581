//! GemCad's two forms: words and records that changed are replaced, and nothing else.

use super::{assert_same_texts, changed_lines, data, distance, read, with_angle, written};
use cutlab::advanced::design::Design;
use cutlab::advanced::design::tiers::facet_normal;
use cutlab::advanced::formats;
use cutlab::advanced::geometry::Plane;
use glam::DVec3;

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
