//! Moissanite: silicon carbide 6H.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Moissanite, ordinary ray. Below 435.8 nm the law is extrapolated.
pub static MOISSANITE: Material = Material {
    name: Cow::Borrowed("moissanite"),
    about: "moissanite (silicon carbide 6H), ordinary ray",
    source: "Wang et al. 2013, as SiC/Wang-6H-o and -e in refractiveindex.info (CC0)",
    dispersion: Dispersion::Resonance { a: 6.57232, b: 0.1401, c: 0.03178, d: -0.02153 },
    extraordinary: Some(Dispersion::Resonance { a: 6.7452, b: 0.15352, c: 0.03597, d: -0.02249 }),
    valid_nm: (435.8, 2325.0),
    specific_gravity: Some(3.21),
    absorption: None,
};
