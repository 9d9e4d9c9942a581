//! Tourmaline.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Tourmaline, ordinary ray.
pub static TOURMALINE: Material = Material {
    name: Cow::Borrowed("tourmaline"),
    about: "tourmaline, ordinary ray, colourless",
    source: "n_D and B–G of gemmological tables, as a Cauchy law through both",
    dispersion: Dispersion::Cauchy { a: 1.624481, b: 0.005183 },
    extraordinary: Some(Dispersion::Cauchy { a: 1.624481 - 0.021, b: 0.005183 }),
    valid_um: (0.4308, 0.6867),
    specific_gravity: Some(3.06),
    absorption: None,
};
