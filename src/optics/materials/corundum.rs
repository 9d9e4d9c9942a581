//! Corundum: sapphire and ruby, without their colour.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Corundum, ordinary ray.
pub static CORUNDUM: Material = Material {
    name: Cow::Borrowed("corundum"),
    about: "corundum (sapphire, ruby), ordinary ray, colourless",
    source: "Malitson & Dodge 1972, as Al2O3/Malitson-o in refractiveindex.info (CC0)",
    dispersion: Dispersion::Sellmeier {
        c0: 0.0,
        terms: &[(1.4313493, 0.0726631), (0.65054713, 0.1193242), (5.3414021, 18.028251)],
    },
    valid_um: (0.20, 5.0),
    specific_gravity: Some(4.00),
};
