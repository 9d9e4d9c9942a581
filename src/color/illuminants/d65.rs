//! Illuminant D65: daylight.

use super::{Illuminant, SpectralPower};

/// CIE standard illuminant D65.
pub static D65: Illuminant = Illuminant {
    name: "D65",
    about: "daylight, 6504 K; the white of sRGB",
    source: "CIE 015:2018, table at 10 nm",
    #[rustfmt::skip]
    spectrum: SpectralPower::Table(&[
        49.9755, 54.6482, 82.7549, 91.486, 93.4318, 86.6823, 104.865, 117.008, 117.812,
        114.861, 115.923, 108.811, 109.354, 107.802, 104.79, 107.689, 104.405, 104.046,
        100.0, 96.3342, 95.788, 88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992,
        80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.349, 61.604, 69.8856,
    ]),
};
