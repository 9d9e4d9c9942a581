//! Emerald: beryl with chromium.

use super::{Material, beryl};
use crate::optics::absorption::{Absorption, Band};
use std::borrow::Cow;

/// Emerald, ordinary ray.
///
/// The two broad bands of Cr³⁺. Positions are published; the strength is that of some 0.2 % Cr₂O₃
/// at a molar extinction of 40 l/(mol cm), usual for Cr³⁺ in silicates.
pub static EMERALD: Material = Material {
    name: Cow::Borrowed("emerald"),
    about: "emerald: beryl with some 0.2 % Cr2O3, ordinary ray",
    source: "n_D and B–G of gemmological tables, as a Cauchy law through both",
    dispersion: beryl::ORDINARY,
    extraordinary: Some(beryl::EXTRAORDINARY),
    valid_nm: beryl::VALID_NM,
    specific_gravity: Some(beryl::SPECIFIC_GRAVITY),
    absorption: Some(Absorption {
        bands: &[
            Band {
                name: "Cr3+, 4A2-4T2",
                centre_nm: 600.0,
                half_widths_per_cm: (1300.0, 1600.0),
                peak_per_mm: 0.28,
            },
            Band {
                name: "Cr3+, 4A2-4T1",
                centre_nm: 430.0,
                half_widths_per_cm: (1600.0, 1800.0),
                peak_per_mm: 0.32,
            },
        ],
        about: "reconstructed from two bands: positions to 5 nm, widths to a fifth, strengths to a half",
        source: "positions: D. L. Wood & K. Nassau, Am. Mineral. 53 (1968) 777",
    }),
};
