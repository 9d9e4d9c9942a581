//! The oval brilliant: the round brilliant drawn out, outline an ellipse.

use super::fancy_brilliant::{self, GirdleOutline};
use super::{CutError, Family, ParameterValues};
use crate::design::tiers::Design;
use glam::DVec2;

/// An oval brilliant.
pub static FAMILY: Family = Family {
    name: "oval-brilliant",
    about: "oval brilliant: 57 facets and a girdle of flats along an ellipse",
    parameters: &fancy_brilliant::parameters(1.4, 3.0, 40.5, 4.0),
    heights: super::heights::OF_BRILLIANTS,
    total: Some(("girdle-facets", 16)),
    build,
};

fn build(v: &ParameterValues) -> Result<Design, CutError> {
    let length = v.get("length-to-width");
    // u = 0 at the lower tip, index 0
    let at = move |u: f64| {
        let (s, c) = (std::f64::consts::TAU * u).sin_cos();
        (DVec2::new(s, -c * length), DVec2::new(s * length, -c))
    };
    let symmetry = if length == 1.0 { 8 } else { 2 };
    fancy_brilliant::build(
        v,
        "oval brilliant",
        &GirdleOutline { point: Box::new(at), first_flat: 0.0, symmetry },
    )
}
