//! Cape diamond: yellowish by the nitrogen centres N3 and N2.

use super::{Material, diamond};
use crate::optics::absorption::{Absorption, Band};
use std::borrow::Cow;

/// Cape diamond.
///
/// The zero-phonon line of N3 with its vibronic side band, and the bands of N2 that come with it.
/// Positions are published; the strength is that of a clear yellow, chosen.
pub static CAPE_DIAMOND: Material = Material {
    name: Cow::Borrowed("cape-diamond"),
    about: "yellowish diamond of the Cape series, coloured by N3 and N2",
    source: "F. Peter, Z. Physik 15 (1923) 358, as C/Peter in refractiveindex.info (CC0)",
    dispersion: diamond::LAW,
    extraordinary: None,
    valid_nm: diamond::VALID_NM,
    specific_gravity: Some(diamond::SPECIFIC_GRAVITY),
    absorption: Some(Absorption {
        bands: &[
            Band {
                name: "N3 zero phonon",
                centre_nm: 415.2,
                half_widths_per_cm: (80.0, 80.0),
                peak_per_mm: 0.30,
            },
            Band {
                name: "N3 side band",
                centre_nm: 395.0,
                half_widths_per_cm: (700.0, 1500.0),
                peak_per_mm: 0.36,
            },
            Band {
                name: "N2, 478 nm",
                centre_nm: 478.0,
                half_widths_per_cm: (200.0, 200.0),
                peak_per_mm: 0.048,
            },
            Band {
                name: "N2, 465 nm",
                centre_nm: 465.0,
                half_widths_per_cm: (200.0, 200.0),
                peak_per_mm: 0.030,
            },
            Band {
                name: "N2, 452 nm",
                centre_nm: 452.0,
                half_widths_per_cm: (200.0, 200.0),
                peak_per_mm: 0.036,
            },
            Band {
                name: "N2, 435 nm",
                centre_nm: 435.0,
                half_widths_per_cm: (250.0, 250.0),
                peak_per_mm: 0.036,
            },
        ],
        about: "reconstructed from six bands: positions to 1 nm (side band 5 nm); widths and ratios are rough, the strength is chosen for a clear yellow",
        source: "positions: A. T. Collins, J. Gemmol. 18 (1982) 37; A. M. Zaitsev, Optical Properties of Diamond (2001)",
    }),
};
