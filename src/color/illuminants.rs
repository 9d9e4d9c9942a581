//! The catalogue of illuminants, one a file: light by which colours are judged.

mod a;
mod d50;
mod d65;
mod equal_energy;
mod illuminant;

use crate::parse;
pub use illuminant::{Illuminant, SpectralPower};

/// Every illuminant, by name.
pub static ILLUMINANTS: &[&Illuminant] = &[&d65::D65, &a::A, &d50::D50, &equal_energy::EQUAL_ENERGY];

impl Illuminant {
    /// The illuminant called `name`, or none.
    pub fn by_name(name: &str) -> Option<&'static Illuminant> {
        ILLUMINANTS.iter().copied().find(|i| parse::is_name(i.name, name))
    }

    /// CIE standard illuminant D65, daylight.
    pub fn daylight() -> &'static Illuminant {
        &d65::D65
    }

    /// Light of the same power at every wavelength.
    pub fn equal_energy() -> &'static Illuminant {
        &equal_energy::EQUAL_ENERGY
    }

    /// Luminance of the spectrum as [`Illuminant::power`] gives it, over that of equal-energy light
    /// of power 1.
    pub fn luminance(&self) -> f32 {
        Self::equal_energy().xyz(|nm| self.power(nm)).y
    }
}
