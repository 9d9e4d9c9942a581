//! Beryl: aquamarine, emerald and others, without their colour.

use super::{Material, gems};
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Line B less line G.
const B_G: f64 = 0.014;

/// Index of the ordinary ray.
pub(super) const ORDINARY: Dispersion = gems::through(1.583, Some(B_G));

/// Index of the extraordinary ray.
pub(super) const EXTRAORDINARY: Dispersion = gems::through(1.577, Some(B_G));

/// The lines G and B, through which the law is drawn, nm.
pub(super) const VALID_NM: (f64, f64) = gems::VALID_NM;

/// Mass per volume, g/cm³.
pub(super) const SPECIFIC_GRAVITY: f64 = 2.72;

/// Beryl, ordinary ray.
pub static BERYL: Material = Material {
    name: Cow::Borrowed("beryl"),
    about: "beryl, ordinary ray, colourless",
    source: "n_D and B–G of gemmological tables, as a Cauchy law through both",
    dispersion: ORDINARY,
    extraordinary: Some(EXTRAORDINARY),
    valid_nm: VALID_NM,
    specific_gravity: Some(SPECIFIC_GRAVITY),
    absorption: None,
};
