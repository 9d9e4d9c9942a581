//! Gem Cut Studio's XML: attributes and corners that changed are replaced, and nothing else.

use super::{assert_same_texts, changed_lines, data, distance, read, with_angle, written};
use glam::DVec3;

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
