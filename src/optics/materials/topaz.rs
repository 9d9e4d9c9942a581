//! Topaz.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Topaz, biaxial: one index stands for its three, which differ by .01.
pub static TOPAZ: Material = Material {
    name: Cow::Borrowed("topaz"),
    about: "topaz, one of its three indices",
    source: "n_D and B–G of gemmological tables, as a Cauchy law through both",
    dispersion: Dispersion::Cauchy { a: 1.614872, b: 0.004273 },
    extraordinary: None,
    valid_um: (0.4308, 0.6867),
    specific_gravity: Some(3.53),
    absorption: None,
};
