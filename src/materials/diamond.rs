//! Diamond, Peter's Sellmeier law.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Peter's law.
pub(super) const LAW: Dispersion =
    Dispersion::Sellmeier { c0: 0.0, terms: &[(0.3306, 0.1750), (4.3356, 0.1060)] };

/// Where the law was measured, nm.
pub(super) const VALID_NM: (f64, f64) = (226.0, 760.0);

/// Mass per volume, g/cm³.
pub(super) const SPECIFIC_GRAVITY: f64 = 3.52;

/// Diamond. Checked at eight Fraunhofer lines in `tests/optics.rs`.
pub static DIAMOND: Material = Material {
    name: Cow::Borrowed("diamond"),
    about: "diamond, colourless",
    source: "F. Peter, Z. Physik 15 (1923) 358, as C/Peter in refractiveindex.info (CC0)",
    dispersion: LAW,
    extraordinary: None,
    valid_nm: VALID_NM,
    specific_gravity: Some(SPECIFIC_GRAVITY),
    absorption: None,
};
