//! Corundum: sapphire and ruby, without their colour.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Index of the ordinary ray.
pub(super) const ORDINARY: Dispersion = Dispersion::Sellmeier {
    c0: 0.0,
    terms: &[(1.4313493, 0.0726631), (0.65054713, 0.1193242), (5.3414021, 18.028251)],
};

/// Index of the extraordinary ray.
pub(super) const EXTRAORDINARY: Dispersion = Dispersion::Sellmeier {
    c0: 0.0,
    terms: &[(1.5039759, 0.0740288), (0.55069141, 0.1216529), (6.5927379, 20.072248)],
};

/// Where the law was measured, nm.
pub(super) const VALID_NM: (f64, f64) = (200.0, 5000.0);

/// Mass per volume, g/cm³.
pub(super) const SPECIFIC_GRAVITY: f64 = 4.00;

/// Corundum, ordinary ray.
pub static CORUNDUM: Material = Material {
    name: Cow::Borrowed("corundum"),
    about: "corundum (sapphire, ruby), ordinary ray, colourless",
    source: "Malitson & Dodge 1972, as Al2O3/Malitson-o and -e in refractiveindex.info (CC0)",
    dispersion: ORDINARY,
    extraordinary: Some(EXTRAORDINARY),
    valid_nm: VALID_NM,
    specific_gravity: Some(SPECIFIC_GRAVITY),
    absorption: None,
};
