//! Illuminant A: incandescent light.

use super::{Illuminant, SpectralPower};

/// CIE standard illuminant A.
pub static A: Illuminant = Illuminant {
    name: "A",
    about: "incandescent light, 2856 K",
    source: "CIE 015:2018, from its definition: Planck's law with c2/T = 1.435e7 nm K / 2848 K",
    spectrum: SpectralPower::Planck { c2_over_t: 1.435e7 / 2848.0 },
};
