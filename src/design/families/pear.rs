//! The pear: a brilliant over a half circle that two arcs draw out to a point.

use super::fancy_brilliant::{self, GirdleOutline};
use super::{CutError, Family, ParameterValues};
use crate::design::tiers::Design;
use glam::DVec2;
use std::f64::consts::TAU;

/// A pear-shaped brilliant.
pub static FAMILY: Family = Family {
    name: "pear-brilliant",
    about: "pear brilliant: 57 facets and a girdle of flats along a half circle and two arcs",
    parameters: &fancy_brilliant::parameters(1.6, 2.5, 40.5, 6.0),
    heights: super::heights::OF_BRILLIANTS,
    total: Some(("girdle-facets", 16)),
    build,
};

fn build(v: &ParameterValues) -> Result<Design, CutError> {
    // the half circle stands about the axis, where the culet is; the point at −y, index 0
    let tip = 2.0 * v.get("length-to-width") - 1.0;
    let radius = (tip * tip + 1.0) / 2.0;
    let reach = (tip / radius).min(1.0).asin();
    let reach = if tip > radius { std::f64::consts::PI - reach } else { reach };
    let at = move |u: f64| {
        let u = u.rem_euclid(1.0);
        if u == 0.0 {
            return (DVec2::new(0.0, -tip), DVec2::NEG_Y);
        }
        // the right side, and its mirror image
        let side = if u <= 0.5 { 1.0 } else { -1.0 };
        let w = if u <= 0.5 { u } else { 1.0 - u };
        let (point, normal) = if w < 0.25 {
            let (s, c) = (reach * (4.0 * w - 1.0)).sin_cos();
            (DVec2::new(1.0 - radius + radius * c, radius * s), DVec2::new(c, s))
        } else {
            let (s, c) = (TAU * (w - 0.25)).sin_cos();
            (DVec2::new(c, s), DVec2::new(c, s))
        };
        let mirror = DVec2::new(side, 1.0);
        (point * mirror, normal * mirror)
    };
    let outline = GirdleOutline { point: Box::new(at), first_flat: 0.5, symmetry: 1 };
    fancy_brilliant::build(v, "pear brilliant", &outline)
}
