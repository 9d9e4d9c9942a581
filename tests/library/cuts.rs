//! Every cut of the library: a closed convex stone with the proportions that its file promises.

use cutlab::advanced::design::gia_envelopes::envelope;
use cutlab::advanced::design::proportions::{self, Proportions};
use cutlab::advanced::design::{Design, library};
use cutlab::advanced::geometry::polyhedron::PlaneStatus;
use std::collections::BTreeMap;

fn made(name: &str, values: &[(&str, f64)]) -> Design {
    let values: BTreeMap<String, f64> = values.iter().map(|(k, v)| (k.to_string(), *v)).collect();
    let design = library::design(name, &values).unwrap_or_else(|| panic!("no cut {name}"));
    design.unwrap_or_else(|e| panic!("{name}: {e}"))
}

fn measured(name: &str, values: &[(&str, f64)]) -> Proportions {
    proportions::of_design(&made(name, values)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// The value of a key of `[expect]`, and how far it may be off: one unit of the last digit that its
/// sources print.
fn expected(p: &Proportions, key: &str) -> Option<(f64, f64)> {
    let r = &p.ratios;
    Some(match key {
        "facets" => (p.facets as f64, 0.0),
        "symmetry" => (p.symmetry.order as f64, 0.0),
        "table" => (p.table_percent?, 0.01),
        "crown-angle" => (p.crown_angle_deg?, 0.01),
        "crown-height" => (p.crown_height_percent, 0.01),
        "pavilion-depth" => (p.pavilion_depth_percent, 0.01),
        "pavilion-angle" => (p.pavilion_angle_deg?, 0.01),
        "depth" => (p.depth_percent, 0.01),
        "girdle" => (p.girdle_percent, 0.01),
        "culet" => (p.culet_percent, 0.01),
        "l-w" => (r.l_w, 0.001),
        "t-w" => (r.t_w?, 0.0005),
        "p-w" => (r.p_w, 0.0005),
        "c-w" => (r.c_w, 0.0005),
        "vol-w3" => (r.vol_w3, 0.0005),
        _ => return None,
    })
}

#[test]
fn every_cut_has_the_proportions_it_promises() {
    assert!(library::names().count() >= 40);
    let mut broken = Vec::new();
    for name in library::names() {
        let document = library::document(name).expect("in the library").expect("can be read");
        assert!(!document.source.is_empty() && !document.about.is_empty(), "{name} needs source and about");
        let keys = &document.expect;
        assert!(keys.contains_key("facets") && keys.len() > 1, "{name} needs facets and more in [expect]");
        let p = measured(name, &[]);
        for (key, promised) in keys {
            let (value, tolerance) = expected(&p, key).unwrap_or_else(|| panic!("{name}: no such key {key}"));
            if (value - promised).abs() > tolerance {
                broken.push(format!("{name}: {key} is {value}, promised {promised}"));
            }
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

#[test]
fn every_cut_is_closed_and_convex_and_every_facet_stands() {
    let mut broken = Vec::new();
    for name in library::names() {
        let design = made(name, &[]);
        let solid = design.solid().unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(solid.euler(), 2, "{name}");
        let width = solid.width();
        for plane in design.planes() {
            let beyond = solid.vertices.iter().map(|v| plane.signed_distance(*v)).fold(f64::MIN, f64::max);
            assert!(beyond < 1e-9 * width, "{name}: a corner lies {beyond} outside a facet");
        }
        for (facet, fate) in design.facets().zip(&solid.plane_status) {
            let area = if let PlaneStatus::Facet(face) = fate { solid.area(*face) } else { 0.0 };
            if area < 1e-5 * width * width {
                broken.push(format!("{name}: {} is a sliver or nothing: {fate:?}", facet.name));
            }
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

#[test]
fn fancy_outlines_take_their_length_to_width() {
    for name in ["oval", "cushion", "marquise", "pear", "emerald", "baguette"] {
        for length in [1.3, 1.75, 2.2] {
            let p = measured(name, &[("length-to-width", length), ("size", 5.0)]);
            assert!((p.ratios.l_w - length).abs() < 2e-3 * length, "{name}: {} for {length}", p.ratios.l_w);
            assert!((p.width - 5.0).abs() < 5e-3, "{name}: {}", p.width);
        }
    }
}

#[test]
fn every_cut_of_tiers_can_be_drawn_out() {
    let mut drawn = 0;
    for name in library::names() {
        let document = library::document(name).expect("in the library").expect("can be read");
        if document.family.is_some() {
            continue;
        }
        drawn += 1;
        let (before, after) = (made(name, &[]), made(name, &[("length-to-width", 1.7)]));
        let (before, after) = (before.solid().expect("closed"), after.solid().expect("closed"));
        let size = |s: &cutlab::advanced::geometry::Polyhedron| s.bounds().1 - s.bounds().0;
        let (a, b) = (size(&before), size(&after));
        assert!((b.y / b.x - 1.7).abs() < 1e-9, "{name}: {}", b.y / b.x);
        // width and height stay, every facet stands, and the volume grows with the length
        assert!((b.x / a.x - 1.0).abs() < 1e-9 && (b.z / a.z - 1.0).abs() < 1e-9, "{name}: {a} {b}");
        assert_eq!(before.faces.len(), after.faces.len(), "{name}");
        let grown = after.volume() / before.volume() / (b.y / a.y);
        assert!((grown - 1.0).abs() < 1e-9, "{name}: {grown}");
    }
    assert!(drawn >= 20, "{drawn}");
    for name in ["princess", "radiant", "french-cut", "barion-square", "barion-emerald", "barion-oval"] {
        let p = measured(name, &[("length-to-width", 1.25)]);
        assert!((p.ratios.l_w - 1.25).abs() < 1e-9, "{name}: {}", p.ratios.l_w);
    }
    let error = library::design("princess", &BTreeMap::from([("length-to-width".into(), 0.5)]));
    assert!(error.expect("a cut").expect_err("too short").to_string().contains("1 to 6"));
}

/// Along the width nothing changes when a stone is drawn out across it, and W is still measured
/// corner to corner: on an oval of flats as on the round stone that it was.
#[test]
fn the_ratios_of_a_stone_drawn_out_are_those_of_the_round_one() {
    for name in ["classic", "first-stone", "ideal-brilliant"] {
        let round = measured(name, &[]).ratios;
        for length in [1.2, 1.4, 2.0] {
            let oval = measured(name, &[("length-to-width", length)]).ratios;
            let table = oval.t_w.expect("a table") - round.t_w.expect("a table");
            for off in [
                oval.l_w - length,
                table,
                oval.h_w - round.h_w,
                oval.vol_w3 / length - round.vol_w3,
                oval.w - round.w,
            ] {
                assert!(off.abs() < 1e-9, "{name} {length}: {oval:?}, {round:?}");
            }
        }
    }
}

#[test]
fn there_is_no_heart_and_it_is_said_why() {
    let error =
        cutlab::advanced::stone::Stone::parse("heart").map(|i| i.format()).expect_err("no heart").to_string();
    assert!(error.contains("dent") && error.contains("'pear'"), "{error}");
}

/// [P] usfacetersguild.org, gemcad.blogspot.com: three decimals, W corner to corner.
#[test]
fn the_guilds_ratios_come_out() {
    for (name, [t_w, p_w, c_w, vol], vol_tolerance) in [
        ("classic", [0.516, 0.466, 0.218, 0.236], 5e-4),
        ("first-stone", [0.546, 0.435, 0.121, 0.1865], 5e-5),
        ("ideal-brilliant", [0.560, 0.443, 0.157, 0.206], 5e-4),
    ] {
        let r = measured(name, &[]).ratios;
        for (value, published) in [(r.t_w.expect("a table"), t_w), (r.p_w, p_w), (r.c_w, c_w)] {
            assert!((value - published).abs() <= 5e-4, "{name}: {r:?}");
        }
        assert!((r.vol_w3 - vol).abs() <= vol_tolerance, "{name}: {r:?}");
    }
}

#[test]
fn star_and_lower_half_lengths_are_those_a_brilliant_was_made_from() {
    for (star, lower, flats, culet) in
        [(50.0, 75.0, 96.0, 0.0), (54.8, 76.8, 16.0, 0.0), (60.0, 60.0, 64.0, 3.0)]
    {
        let values = [
            ("star", star),
            ("lower-half", lower),
            ("girdle-facets", flats),
            ("culet", culet),
            ("girdle", 5.0),
        ];
        let lengths = measured("round-brilliant", &values).brilliant.expect("a brilliant");
        assert!((lengths.star_percent - star).abs() < 1e-6, "{lengths:?}");
        assert!((lengths.lower_half_percent - lower).abs() < 1e-6, "{lengths:?}");
    }
    for other in ["portuguese", "swiss-cut", "oval", "cube", "double-rose"] {
        assert!(measured(other, &[]).brilliant.is_none(), "{other}");
    }
}

#[test]
fn envelopes_follow_the_table() {
    for (values, name) in [
        (vec![("pavilion-angle", 40.8)], Some("Excellent")),
        (vec![("pavilion-angle", 40.5)], Some("Very good")),
        (vec![("pavilion-angle", 40.8), ("star", 44.0)], Some("Very good")),
        (vec![("pavilion-angle", 43.0)], Some("Good")),
        (vec![("crown-angle", 41.0), ("girdle", 4.0)], Some("Fair")),
        (vec![("pavilion-angle", 45.0)], None),
    ] {
        assert_eq!(envelope(&measured("round-brilliant", &values)), name, "{values:?}");
    }
    assert_eq!(envelope(&measured("princess", &[])), None);
}
