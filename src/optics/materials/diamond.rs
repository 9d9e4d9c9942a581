//! Diamond, Peter's Sellmeier law.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Diamond. Checked at eight Fraunhofer lines in `tests/optics.rs`.
pub static DIAMOND: Material = Material {
    name: Cow::Borrowed("diamond"),
    about: "diamond, colourless",
    source: "F. Peter, Z. Physik 15 (1923) 358, as C/Peter in refractiveindex.info (CC0)",
    dispersion: Dispersion::Sellmeier { c0: 0.0, terms: &[(0.3306, 0.1750), (4.3356, 0.1060)] },
    valid_um: (0.226, 0.760),
    specific_gravity: Some(3.52),
};
