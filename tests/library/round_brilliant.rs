//! The round brilliant against the worked rows of the project's sources.

use cutlab::advanced::design::families::round_brilliant::derived_angles;
use cutlab::advanced::design::proportions;
use cutlab::advanced::design::{Design, library};
use std::collections::BTreeMap;

fn brilliant(values: &[(&str, f64)]) -> Design {
    let values: BTreeMap<String, f64> = values.iter().map(|(k, v)| (k.to_string(), *v)).collect();
    library::design("round-brilliant", &values).expect("in the library").expect("can be made")
}

fn assert_near(value: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((value - expected).abs() <= tolerance, "{what}: {value} against {expected}");
}

/// Angle from the girdle plane of the tier called `name`, as the solid has it.
fn measured_angle(design: &Design, name: &str) -> f64 {
    let number = design.facets().position(|f| f.name == format!("{name} 1")).expect("the tier exists");
    let solid = design.solid().expect("closed");
    let face = solid.faces.iter().position(|f| f.plane == number).expect("the facet stands");
    let n = solid.area_vector(face);
    n.truncate().length().atan2(n.z.abs()).to_degrees()
}

#[test]
fn stars_and_halves_follow_from_the_lengths() {
    // table, crown, pavilion, star, lower half → star, upper half, lower half
    for ([table, crown, pavilion, star, lower], [star_deg, upper_deg, lower_deg]) in [
        ([56.0, 34.0, 40.5, 50.0, 75.0], [21.50, 40.44, 41.76]),
        ([53.0, 34.5, 40.75, 50.0, 75.0], [23.07, 40.58, 42.01]),
        ([57.0, 34.5, 40.8, 50.0, 77.0], [21.43, 41.11, 41.99]),
        // published as the angles of "Ideal Brilliant" on a 64-index gear
        ([56.0, 34.0, 41.0, 54.8, 76.8], [22.493, 41.20, 42.20]),
    ] {
        let angles = derived_angles(table / 100.0, crown, pavilion, star / 100.0, lower / 100.0);
        assert_near(angles.star, star_deg, 0.01, "star");
        assert_near(angles.upper_half, upper_deg, 0.01, "upper half");
        assert_near(angles.lower_half, lower_deg, 0.01, "lower half");
        // and the stone that is made has them
        let design = brilliant(&[
            ("table", table),
            ("crown-angle", crown),
            ("pavilion-angle", pavilion),
            ("star", star),
            ("lower-half", lower),
        ]);
        assert_near(measured_angle(&design, "star"), star_deg, 0.01, "star");
        assert_near(measured_angle(&design, "upper half"), upper_deg, 0.01, "upper half");
        assert_near(measured_angle(&design, "lower half"), lower_deg, 0.01, "lower half");
    }
    // DiamCalc's lower halves
    for (pavilion, lower_deg) in [(41.15, 42.24), (41.25, 42.34)] {
        let angles = derived_angles(0.56, 35.0, pavilion, 0.5, 0.8);
        assert_near(angles.lower_half, lower_deg, 0.01, "lower half");
    }
}

#[test]
fn heights_of_the_reference_stone() {
    let p = proportions::of_design(&brilliant(&[])).expect("closed");
    assert_near(p.width, 6.5, 1e-12, "width");
    assert_near(p.table_percent.expect("a table"), 56.0, 1e-9, "table");
    assert_near(p.crown_angle_deg.expect("a crown"), 34.0, 1e-9, "crown angle");
    assert_near(p.pavilion_angle_deg.expect("a pavilion"), 40.5, 1e-9, "pavilion angle");
    assert_near(p.crown_height_percent, 14.84, 0.005, "crown height");
    assert_near(p.pavilion_depth_percent, 42.70, 0.005, "pavilion depth");
    assert_near(p.girdle_percent, 3.0, 1e-9, "girdle");
    assert_near(p.depth_percent, 60.54, 0.005, "depth");
    assert_near(p.volume / 6.5f64.powi(3), 0.2085, 5e-5, "volume");
}

/// Girdle thickness at the flat whose normal stands at `azimuth_deg` from the first main, in
/// percent of the diameter.
fn girdle_at(design: &Design, azimuth_deg: f64) -> f64 {
    let solid = design.solid().expect("closed");
    let az = azimuth_deg.to_radians();
    let toward = glam::DVec3::new(az.sin(), -az.cos(), 0.0);
    let face = (0..solid.faces.len())
        .find(|&f| solid.area_vector(f).normalize().dot(toward) > 1.0 - 1e-9)
        .expect("a girdle flat stands there");
    // the halves above and below such a flat have its azimuth: its edges are level
    let heights: Vec<f64> = solid.polygon(face).map(|v| v.z).collect();
    let extent =
        heights.iter().fold(f64::MIN, |m, z| m.max(*z)) - heights.iter().fold(f64::MAX, |m, z| m.min(*z));
    100.0 * extent / solid.width()
}

#[test]
fn the_girdle_is_thinner_in_the_valleys() {
    let design = brilliant(&[]);
    let (upper, lower) = (40.44f64.to_radians().tan(), 41.76f64.to_radians().tan());
    let dip = 50.0 * (1.0 - 11.25f64.to_radians().cos()) * (upper + lower);
    assert_near(girdle_at(&design, 11.25), 3.0 - dip, 1e-3, "girdle at the valley");
    assert_near(girdle_at(&design, 11.25 + 22.5), 3.0 - dip, 1e-3, "girdle at the next valley");
}

#[test]
fn the_published_ideal_brilliant_comes_out() {
    // gemcad.blogspot.com 2015-08-04: P/W .443 and C/W .157 to the girdle valley, Vol/W³ .206
    let values = [("pavilion-angle", 41.0), ("star", 54.8), ("lower-half", 76.8)];
    let design = brilliant(&values);
    let p = proportions::of_design(&design).expect("closed");
    let dip = |deg: f64| 50.0 * (1.0 - 11.25f64.to_radians().cos()) * deg.to_radians().tan();
    assert_near(p.pavilion_depth_percent + dip(42.20), 44.3, 0.05, "P/W");
    assert_near(p.crown_height_percent + dip(41.20), 15.7, 0.05, "C/W");
}

#[test]
fn a_culet_is_flat_to_flat() {
    let design = brilliant(&[("culet", 4.0)]);
    let solid = design.solid().expect("closed");
    let number = design.facets().position(|f| f.name == "culet").expect("a culet");
    let face = solid.faces.iter().position(|f| f.plane == number).expect("it stands");
    let y = solid.polygon(face).map(|v| v.y).fold(f64::MIN, f64::max);
    assert_near(2.0 * y / 6.5, 0.04, 1e-9, "culet");
    assert_eq!(solid.faces.len(), 154);
}
