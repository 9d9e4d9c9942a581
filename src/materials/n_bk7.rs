//! N-BK7: the common optical glass.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Schott N-BK7.
pub static N_BK7: Material = Material {
    name: Cow::Borrowed("n-bk7"),
    about: "N-BK7 optical glass",
    source: "Schott catalogue 2017-01-20b, as glass/schott/N-BK7 in refractiveindex.info (CC0)",
    dispersion: Dispersion::SellmeierSquared {
        c0: 0.0,
        terms: &[(1.03961212, 0.00600069867), (0.231792344, 0.0200179144), (1.01046945, 103.560653)],
    },
    extraordinary: None,
    valid_nm: (300.0, 2500.0),
    specific_gravity: Some(2.51),
    absorption: None,
};
