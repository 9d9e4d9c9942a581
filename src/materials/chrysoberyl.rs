//! Chrysoberyl.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Chrysoberyl, biaxial. The law is that of the axis b of a synthetic crystal, the greatest of its three
/// indices (1.7408, 1.7427, 1.7484 at D); gems have 1.746, 1.748 and 1.756, of which it is the middle one
/// to .0005. The published n² = A + B λ²/(λ² − C) + D λ² is the
/// same as (A + B) + BC/(λ² − C) + D λ².
pub static CHRYSOBERYL: Material = Material {
    name: Cow::Borrowed("chrysoberyl"),
    about: "chrysoberyl; the middle one of a gem's three indices, 1.746, 1.748 and 1.756",
    source: "Walling et al. 1980, Loiko & Major 2016, as BeAl2O4/Walling-beta in refractiveindex.info (CC0)",
    dispersion: Dispersion::Resonance { a: 1.58829 + 1.42711, b: 1.42711 * 0.01113, c: 0.01113, d: -0.01696 },
    extraordinary: None,
    valid_nm: (250.0, 2600.0),
    specific_gravity: Some(3.73),
    absorption: None,
};
