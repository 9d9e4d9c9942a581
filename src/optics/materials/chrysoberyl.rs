//! Chrysoberyl.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Chrysoberyl, biaxial: the middle index, n_β. The published n² = A + B λ²/(λ² − C) + D λ² is the
/// same as (A + B) + BC/(λ² − C) + D λ².
pub static CHRYSOBERYL: Material = Material {
    name: Cow::Borrowed("chrysoberyl"),
    about: "chrysoberyl, the middle of its three indices",
    source: "Walling et al. 1980, Loiko & Major 2016, as BeAl2O4/Walling-beta in refractiveindex.info (CC0)",
    dispersion: Dispersion::Resonance { a: 1.58829 + 1.42711, b: 1.42711 * 0.01113, c: 0.01113, d: -0.01696 },
    extraordinary: None,
    valid_um: (0.25, 2.6),
    specific_gravity: Some(3.73),
    absorption: None,
};
