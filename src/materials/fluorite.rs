//! Fluorite.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Fluorite, cubic, 24 °C.
pub static FLUORITE: Material = Material {
    name: Cow::Borrowed("fluorite"),
    about: "fluorite (calcium fluoride)",
    source: "Malitson 1963, as CaF2/Malitson in refractiveindex.info (CC0)",
    dispersion: Dispersion::Sellmeier {
        c0: 0.0,
        terms: &[(0.5675888, 0.050263605), (0.4710914, 0.1003909), (3.8484723, 34.649040)],
    },
    extraordinary: None,
    valid_nm: (230.0, 9700.0),
    specific_gravity: Some(3.18),
    absorption: None,
};
