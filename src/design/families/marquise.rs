//! The marquise (navette): a brilliant between two circular arcs that meet in points.

use super::fancy_brilliant::{self, GirdleOutline};
use super::{CutError, Family, ParameterValues};
use crate::design::tiers::Design;
use glam::DVec2;

/// A marquise brilliant.
pub static FAMILY: Family = Family {
    name: "marquise-brilliant",
    about: "marquise brilliant: 57 facets and a girdle of flats along two arcs",
    parameters: &fancy_brilliant::parameters(2.0, 4.0, 40.5, 6.0),
    heights: super::heights::OF_BRILLIANTS,
    total: Some(("girdle-facets", 16)),
    build,
};

fn build(v: &ParameterValues) -> Result<Design, CutError> {
    let length = v.get("length-to-width");
    // each arc passes (0, ±length) and (±1, 0): radius ρ about (±(1 − ρ), 0)
    let radius = (1.0 + length * length) / 2.0;
    let reach = (length / radius).clamp(-1.0, 1.0).asin();
    let reach = if length > radius { std::f64::consts::PI - reach } else { reach };
    let at = move |u: f64| {
        let u = u.rem_euclid(1.0);
        // the points belong to both arcs, and a main faces along the axis there
        if u == 0.0 || u == 0.5 {
            let tip = DVec2::new(0.0, if u == 0.0 { -length } else { length });
            return (tip, tip);
        }
        let right = u < 0.5;
        let angle = reach * (4.0 * if right { u } else { u - 0.5 } - 1.0);
        let (s, c) = angle.sin_cos();
        let (point, normal) = (DVec2::new(1.0 - radius + radius * c, radius * s), DVec2::new(c, s));
        if right { (point, normal) } else { (-point, -normal) }
    };
    let outline = GirdleOutline { point: Box::new(at), first_flat: 0.5, symmetry: 2 };
    fancy_brilliant::build(v, "marquise brilliant", &outline)
}
