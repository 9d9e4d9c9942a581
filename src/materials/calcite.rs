//! Calcite.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Calcite, ordinary ray.
pub static CALCITE: Material = Material {
    name: Cow::Borrowed("calcite"),
    about: "calcite, ordinary ray",
    source: "Ghosh 1999, as CaCO3/Ghosh-o and -e in refractiveindex.info (CC0)",
    dispersion: Dispersion::SellmeierSquared {
        c0: 0.73358749,
        terms: &[(0.96464345, 0.0194325203), (1.82831454, 120.0)],
    },
    extraordinary: Some(Dispersion::SellmeierSquared {
        c0: 0.35859695,
        terms: &[(0.82427830, 0.0106689543), (0.14429128, 120.0)],
    }),
    valid_nm: (204.0, 2172.0),
    specific_gravity: Some(2.71),
    absorption: None,
};
