//! Beryl: aquamarine, emerald and others, without their colour.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Index of the ordinary ray.
pub(super) const ORDINARY: Dispersion = Dispersion::Cauchy { a: 1.566794, b: 0.004273 };

/// Index of the extraordinary ray.
pub(super) const EXTRAORDINARY: Dispersion = Dispersion::Cauchy { a: 1.566794 - 0.006, b: 0.004273 };

/// The lines G and B, through which the law is drawn, µm.
pub(super) const VALID_UM: (f64, f64) = (0.4308, 0.6867);

/// Mass per volume, g/cm³.
pub(super) const SPECIFIC_GRAVITY: f64 = 2.72;

/// Beryl, ordinary ray.
pub static BERYL: Material = Material {
    name: Cow::Borrowed("beryl"),
    about: "beryl, ordinary ray, colourless",
    source: "n_D and B–G of gemmological tables, as a Cauchy law through both",
    dispersion: ORDINARY,
    extraordinary: Some(EXTRAORDINARY),
    valid_um: VALID_UM,
    specific_gravity: Some(SPECIFIC_GRAVITY),
    absorption: None,
};
