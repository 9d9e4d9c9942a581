//! Strontium titanate.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Strontium titanate, cubic. Below 430 nm the law is extrapolated.
pub static STRONTIUM_TITANATE: Material = Material {
    name: Cow::Borrowed("strontium-titanate"),
    about: "strontium titanate (fabulite)",
    source: "Bond 1965, as SrTiO3/Bond in refractiveindex.info (CC0)",
    dispersion: Dispersion::Sellmeier {
        c0: 0.0,
        terms: &[(3.042143, 0.1475902), (1.170065, 0.2953086), (30.83326, 33.18606)],
    },
    extraordinary: None,
    valid_nm: (430.0, 3800.0),
    specific_gravity: Some(5.13),
    absorption: None,
};
