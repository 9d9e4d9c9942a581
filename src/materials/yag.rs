//! YAG: yttrium aluminium garnet.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Yttrium aluminium garnet, cubic.
pub static YAG: Material = Material {
    name: Cow::Borrowed("yag"),
    about: "YAG (yttrium aluminium garnet)",
    source: "Zelmon et al. 1998, as Y3Al5O12/Zelmon in refractiveindex.info (CC0)",
    dispersion: Dispersion::SellmeierSquared { c0: 0.0, terms: &[(2.28200, 0.01185), (3.27644, 282.734)] },
    extraordinary: None,
    valid_nm: (400.0, 5000.0),
    specific_gravity: Some(4.57),
    absorption: None,
};
