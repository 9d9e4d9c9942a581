//! Ruby: corundum with chromium.

use super::{Material, corundum};
use crate::optics::absorption::{Absorption, Band};
use std::borrow::Cow;

/// Ruby, ordinary ray.
///
/// The two broad bands of Cr³⁺. Peak cross-sections of 1.8e-19 and 1.9e-19 cm² are those of laser
/// ruby (2.8 and 3.0 cm⁻¹ at 0.05 % Cr₂O₃, 1.58e19 ions/cm³); a gem is taken to hold four times as much.
/// The R lines at 693 nm are left out: half a nanometre wide where the eye sees little.
pub static RUBY: Material = Material {
    name: Cow::Borrowed("ruby"),
    about: "ruby: corundum with 0.2 % Cr2O3, ordinary ray",
    source: "Malitson & Dodge 1972, as Al2O3/Malitson-o and -e in refractiveindex.info (CC0)",
    dispersion: corundum::ORDINARY,
    extraordinary: Some(corundum::EXTRAORDINARY),
    valid_nm: corundum::VALID_NM,
    specific_gravity: Some(corundum::SPECIFIC_GRAVITY),
    absorption: Some(Absorption {
        bands: &[
            Band {
                name: "Cr3+ U, 4A2-4T2",
                centre_nm: 555.0,
                half_widths_per_cm: (1150.0, 1750.0),
                peak_per_mm: 1.14,
            },
            Band {
                name: "Cr3+ Y, 4A2-4T1",
                centre_nm: 410.0,
                half_widths_per_cm: (1700.0, 2000.0),
                peak_per_mm: 1.20,
            },
        ],
        about: "reconstructed from two bands: positions to 5 nm, strengths to a fifth, flanks to a third; 6.3e19 Cr3+ per cm3",
        source: "positions: D. S. McClure, J. Chem. Phys. 36 (1962) 2757; cross-sections: D. C. Cronemeyer, J. Opt. Soc. Am. 56 (1966) 1703",
    }),
};
