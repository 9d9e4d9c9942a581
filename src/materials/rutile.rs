//! Rutile: titanium dioxide.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Rutile, ordinary ray. Below 430 nm the law is extrapolated.
pub static RUTILE: Material = Material {
    name: Cow::Borrowed("rutile"),
    about: "rutile (titanium dioxide), ordinary ray",
    source: "Devore 1951, as TiO2/Devore-o and -e in refractiveindex.info (CC0)",
    dispersion: Dispersion::Resonance { a: 5.913, b: 0.2441, c: 0.0803, d: 0.0 },
    extraordinary: Some(Dispersion::Resonance { a: 7.197, b: 0.3322, c: 0.0843, d: 0.0 }),
    valid_nm: (430.0, 1530.0),
    specific_gravity: Some(4.25),
    absorption: None,
};
