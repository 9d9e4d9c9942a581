//! Fused silica.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Fused silica, 20 °C.
pub static FUSED_SILICA: Material = Material {
    name: Cow::Borrowed("fused-silica"),
    about: "fused silica",
    source: "Malitson 1965, as SiO2/Malitson in refractiveindex.info (CC0)",
    dispersion: Dispersion::Sellmeier {
        c0: 0.0,
        terms: &[(0.6961663, 0.0684043), (0.4079426, 0.1162414), (0.8974794, 9.896161)],
    },
    extraordinary: None,
    valid_nm: (210.0, 6700.0),
    specific_gravity: Some(2.20),
    absorption: None,
};
