//! Fancy brilliants against the round one: a round outline gives it back, an ellipse its affine
//! image; step cuts against hand-derived heights.

use cutlab::advanced::design::{Design, families, proportions};
use std::collections::BTreeMap;

fn built(family: &str, values: &[(&str, f64)]) -> Design {
    let values: BTreeMap<String, f64> = values.iter().map(|(k, v)| (k.to_string(), *v)).collect();
    families::build(family, &values).unwrap_or_else(|e| panic!("{family}: {e}"))
}

const SHARED: [(&str, f64); 3] = [("crown-angle", 34.0), ("girdle", 3.0), ("girdle-facets", 96.0)];

#[test]
fn a_round_outline_gives_the_round_brilliant() {
    let round = built("round-brilliant", &[]);
    for family in ["oval-brilliant", "cushion-brilliant"] {
        let mut values = SHARED.to_vec();
        values.extend([("length-to-width", 1.0), ("pavilion-angle", 40.5)]);
        if family == "cushion-brilliant" {
            values.push(("squareness", 2.0));
        }
        let fancy = built(family, &values);
        assert_eq!(fancy.facets().count(), 153, "{family}");
        for p in fancy.planes() {
            let off = |q: &cutlab::advanced::geometry::Plane| {
                (p.normal - q.normal).length() + (p.distance - q.distance).abs()
            };
            let nearest = round.planes().iter().map(off).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-9, "{family}: {p:?} is off by {nearest:e}");
        }
    }
}

#[test]
fn an_oval_is_the_round_brilliant_drawn_out() {
    let round = built("round-brilliant", &[]).solid().expect("closed").volume();
    for length in [1.2, 1.5, 2.0] {
        let mut values = SHARED.to_vec();
        values.push(("length-to-width", length));
        let oval = built("oval-brilliant", &values).solid().expect("closed").volume();
        // the flats of the ellipse are the images of the circle's
        assert!((oval / (length * round) - 1.0).abs() < 1e-9, "{length}: {}", oval / round);
    }
}

#[test]
fn steps_have_the_heights_of_their_angles() {
    let stone = built(
        "step-cut",
        &[
            ("length-to-width", 1.5),
            ("crown-steps", 2.0),
            ("crown-angle", 40.0),
            ("crown-spread", 10.0),
            ("pavilion-steps", 2.0),
            ("pavilion-angle", 40.0),
            ("pavilion-spread", 15.0),
        ],
    );
    let p = proportions::of_design(&stone).expect("closed");
    let tan = |deg: f64| deg.to_radians().tan();
    // the table takes 60 %: 20 % of the width a side in two steps of 45° and 35°
    assert!((p.crown_height_percent - 10.0 * (tan(45.0) + tan(35.0))).abs() < 1e-9);
    // half the width in two steps of 55° and 40°
    assert!((p.pavilion_depth_percent - 25.0 * (tan(55.0) + tan(40.0))).abs() < 1e-9);
    assert!((p.girdle_percent - 3.0).abs() < 1e-9 && (p.table_percent.expect("a table") - 60.0).abs() < 1e-9);
    // a rectangle of 1 × 1.5 less four corners of .15
    let outline =
        cutlab::advanced::geometry::measure::polygon_area(&stone.solid().expect("closed").outline());
    assert!((outline / p.width.powi(2) - (1.5 - 2.0 * 0.15 * 0.15)).abs() < 1e-9);
}
