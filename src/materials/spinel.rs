//! Spinel.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Spinel, colourless, cubic.
pub static SPINEL: Material = Material {
    name: Cow::Borrowed("spinel"),
    about: "spinel, colourless",
    source: "Tropf & Thomas 1991, as MgAl2O4/Tropf in refractiveindex.info (CC0)",
    dispersion: Dispersion::Sellmeier { c0: 0.0, terms: &[(1.8938, 0.09942), (3.0755, 15.826)] },
    extraordinary: None,
    valid_nm: (350.0, 5500.0),
    specific_gravity: Some(3.60),
    absorption: None,
};
