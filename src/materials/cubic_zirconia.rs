//! Cubic zirconia with 12 % yttria.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Cubic zirconia, the commonest imitation of diamond.
pub static CUBIC_ZIRCONIA: Material = Material {
    name: Cow::Borrowed("cubic-zirconia"),
    about: "cubic zirconia, 12 % yttria",
    source: "Wood & Nassau 1982, as ZrO2-Y2O3/Wood in refractiveindex.info (CC0)",
    dispersion: Dispersion::Sellmeier {
        c0: 0.0,
        terms: &[(1.347091, 0.062543), (2.117788, 0.166739), (9.452943, 24.32057)],
    },
    extraordinary: None,
    valid_nm: (361.0, 5135.0),
    specific_gravity: Some(5.8),
    absorption: None,
};
