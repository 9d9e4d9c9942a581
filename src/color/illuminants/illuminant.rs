//! An illuminant: the spectrum of a light source, and its colour.

use super::super::cie;
use glam::Vec3;

/// A light source's spectrum.
#[derive(Debug, PartialEq)]
pub struct Illuminant {
    /// Its name.
    pub name: &'static str,
    /// One line for people.
    pub about: &'static str,
    /// Where its figures are from.
    pub source: &'static str,
    /// Relative power per nm.
    pub spectrum: SpectralPower,
}

/// Relative spectral power; only its shape counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SpectralPower {
    /// The same at every wavelength.
    Equal,
    /// Planck's law, (exp(c₂/λT) − 1)⁻¹ λ⁻⁵, λ in nm.
    Planck {
        /// c₂/T in nm.
        c2_over_t: f64,
    },
    /// Values at 380, 390 … 730 nm, linear between them.
    Table(&'static [f32; 36]),
}

impl Illuminant {
    /// Relative power per nm at `nm`, within 380–730.
    pub fn power(&self, nm: f32) -> f32 {
        match self.spectrum {
            SpectralPower::Equal => 1.0,
            SpectralPower::Planck { c2_over_t } => {
                let planck = |nm: f64| ((c2_over_t / nm).exp() - 1.0).recip() * nm.powi(-5);
                (planck(nm.into()) / planck(560.0)) as f32
            }
            SpectralPower::Table(values) => {
                let t = ((nm - cie::RANGE_NM.0) / 10.0).clamp(0.0, 35.0);
                let i = (t as usize).min(34);
                values[i] + (values[i + 1] - values[i]) * (t - i as f32)
            }
        }
    }

    /// CIE 1931 XYZ of this light after something that lets `share` of each wavelength (nm) pass or
    /// gives it back; Y = 1 for all of it. Sums over 380–730 nm in steps of 5.
    pub fn xyz(&self, share: impl Fn(f32) -> f32) -> Vec3 {
        let (mut sum, mut white) = (Vec3::ZERO, 0.0);
        for nm in cie::nodes() {
            let lit = cie::matching(nm) * self.power(nm);
            sum += lit * share(nm);
            white += lit.y;
        }
        sum / white
    }

    /// The same in linear sRGB, adapted so that this light itself is white.
    pub fn linear_srgb(&self, share: impl Fn(f32) -> f32) -> Vec3 {
        cie::adapted_srgb(self.xyz(share), self.xyz(|_| 1.0))
    }

    /// CIE 1931 x, y of this light.
    pub fn chromaticity(&self) -> [f32; 2] {
        cie::chromaticity(self.xyz(|_| 1.0))
    }
}
