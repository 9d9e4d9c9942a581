//! The cushion brilliant: a square or rectangle with bowed sides and round corners.

use super::fancy_brilliant::{self, GirdleOutline};
use super::{CutError, Family, Parameter, ParameterValues};
use crate::design::tiers::Design;
use glam::DVec2;

const SHARED: [Parameter; 10] = fancy_brilliant::parameters(1.05, 2.5, 41.0, 6.0);

/// A cushion brilliant.
pub static FAMILY: Family = Family {
    name: "cushion-brilliant",
    about: "cushion brilliant: 57 facets and a girdle of flats along a superellipse",
    parameters: &[
        SHARED[0],
        SHARED[1],
        SHARED[2],
        SHARED[3],
        SHARED[4],
        SHARED[5],
        SHARED[6],
        SHARED[7],
        SHARED[8],
        SHARED[9],
        Parameter {
            key: "squareness",
            default: 2.6,
            range: (2.0, 4.0),
            unit: "",
            about: "exponent of the superellipse: 2 is an ellipse",
        },
    ],
    heights: super::heights::OF_BRILLIANTS,
    total: Some(("girdle-facets", 16)),
    build,
};

fn build(v: &ParameterValues) -> Result<Design, CutError> {
    let (length, power) = (v.get("length-to-width"), v.get("squareness"));
    // |x|^p + |y/length|^p = 1, by the angle of its own circle
    let at = move |u: f64| {
        let (s, c) = (std::f64::consts::TAU * u).sin_cos();
        let bow = |t: f64, exponent: f64| {
            let t = if t.abs() < 1e-12 { 0.0 } else { t };
            t.abs().powf(exponent).copysign(t)
        };
        let (point, normal) = (2.0 / power, 2.0 - 2.0 / power);
        let toward = DVec2::new(bow(s, normal), -bow(c, normal) / length);
        (DVec2::new(bow(s, point), -bow(c, point) * length), toward)
    };
    let symmetry = if length == 1.0 { 4 } else { 2 };
    fancy_brilliant::build(
        v,
        "cushion brilliant",
        &GirdleOutline { point: Box::new(at), first_flat: 0.0, symmetry },
    )
}
