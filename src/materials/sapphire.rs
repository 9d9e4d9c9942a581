//! Blue sapphire: corundum with iron and titanium.

use super::{Material, corundum};
use crate::optics::absorption::{Absorption, Band};
use std::borrow::Cow;

/// Blue sapphire, ordinary ray.
///
/// Charge transfer between Fe²⁺ and Ti⁴⁺ neighbours, and the weak bands of Fe³⁺. Positions are
/// published; the strength is that of a medium blue, chosen.
pub static SAPPHIRE: Material = Material {
    name: Cow::Borrowed("sapphire"),
    about: "blue sapphire: corundum with iron and titanium, ordinary ray",
    source: "Malitson & Dodge 1972, as Al2O3/Malitson-o and -e in refractiveindex.info (CC0)",
    dispersion: corundum::ORDINARY,
    extraordinary: Some(corundum::EXTRAORDINARY),
    valid_nm: corundum::VALID_NM,
    specific_gravity: Some(corundum::SPECIFIC_GRAVITY),
    absorption: Some(Absorption {
        bands: &[
            Band {
                name: "Fe2+-Ti4+, 17,400/cm",
                centre_nm: 575.0,
                half_widths_per_cm: (2000.0, 2300.0),
                peak_per_mm: 0.22,
            },
            Band {
                name: "Fe2+-Ti4+, 14,300/cm",
                centre_nm: 700.0,
                half_widths_per_cm: (1800.0, 1800.0),
                peak_per_mm: 0.12,
            },
            Band {
                name: "Fe3+, 450 nm",
                centre_nm: 450.0,
                half_widths_per_cm: (500.0, 500.0),
                peak_per_mm: 0.02,
            },
            Band {
                name: "Fe3+, 388 nm",
                centre_nm: 388.0,
                half_widths_per_cm: (500.0, 500.0),
                peak_per_mm: 0.06,
            },
        ],
        about: "reconstructed from four bands: positions to 10 nm, widths to a fifth; the strength is chosen for a medium blue",
        source: "positions: M. G. Townsend, Solid State Commun. 6 (1968) 81; J. Ferguson & P. E. Fielding, Aust. J. Chem. 25 (1972) 1371",
    }),
};
