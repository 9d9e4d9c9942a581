//! Tourmaline.

use super::{Material, gems};
use std::borrow::Cow;

/// Line B less line G.
const B_G: f64 = 0.017;

/// Tourmaline, ordinary ray.
pub static TOURMALINE: Material = Material {
    name: Cow::Borrowed("tourmaline"),
    about: "tourmaline, ordinary ray, colourless",
    source: "n_D and B–G of gemmological tables, as a Cauchy law through both",
    dispersion: gems::through(1.644, Some(B_G)),
    extraordinary: Some(gems::through(1.624, Some(B_G))),
    valid_nm: gems::VALID_NM,
    specific_gravity: Some(3.06),
    absorption: None,
};
