//! The three-index diamond of the original project.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Diamond as the 2014 renderer had it: one index for red, one for green, one for blue. For its
/// pictures; scores should use `diamond`.
pub static DIAMOND_RGB: Material = Material {
    name: Cow::Borrowed("diamond-rgb"),
    about: "the original project's diamond of three indices: 2.40 red, 2.43 green, 2.46 blue",
    source: "the original renderer of 2014; bands cut at 490 and 580 nm",
    dispersion: Dispersion::Steps(&[(490.0, 2.46), (580.0, 2.43), (f64::INFINITY, 2.40)]),
    extraordinary: None,
    valid_nm: (380.0, 730.0),
    specific_gravity: Some(3.52),
    absorption: None,
};
