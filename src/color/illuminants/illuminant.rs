//! An illuminant: the spectrum of a light source, and its colour.

use super::super::cie;
use glam::Vec3;
use std::borrow::Cow;
use std::sync::Arc;

/// A light source's spectrum.
///
/// ```
/// use cutlab::Illuminant;
///
/// let [x, y] = Illuminant::daylight().chromaticity();
/// assert!((x - 0.3127).abs() < 1e-3 && (y - 0.3290).abs() < 1e-3); // D65 of CIE 15
///
/// let lamp = Illuminant::by_name("a").unwrap();
/// assert!(lamp.power(650.0) > 2.0 * lamp.power(450.0)); // an incandescent lamp is red
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Illuminant {
    /// Its name.
    pub name: Cow<'static, str>,
    /// One line for people.
    pub about: Cow<'static, str>,
    /// Where its figures are from.
    pub source: Cow<'static, str>,
    /// Relative power per nm.
    pub spectrum: SpectralPower,
}

/// Relative spectral power; only its shape counts.
#[derive(Debug, Clone, PartialEq)]
pub enum SpectralPower {
    /// The same at every wavelength.
    Equal,
    /// Planck's law, (exp(c₂/λT) − 1)⁻¹ λ⁻⁵, λ in nm.
    Planck {
        /// c₂/T in nm.
        c2_over_t: f64,
    },
    /// Two or more values at even steps from 380 to 730 nm, linear between them.
    Table(Arc<[f32]>),
}

impl Illuminant {
    /// Of a name and a spectrum, with nothing told of it yet.
    pub fn new(name: impl Into<Cow<'static, str>>, spectrum: SpectralPower) -> Illuminant {
        Illuminant { name: name.into(), about: "".into(), source: "".into(), spectrum }
    }

    /// Relative power per nm at `nm`, within 380–730.
    pub fn power(&self, nm: f32) -> f32 {
        match &self.spectrum {
            SpectralPower::Equal => 1.0,
            SpectralPower::Planck { c2_over_t } => {
                let planck = |nm: f64| ((*c2_over_t / nm).exp() - 1.0).recip() * nm.powi(-5);
                (planck(nm.into()) / planck(560.0)) as f32
            }
            SpectralPower::Table(values) => {
                let (first, last) = cie::RANGE_NM;
                let intervals = values.len() - 1;
                let step_nm = (last - first) / intervals as f32;
                let t = ((nm - first) / step_nm).clamp(0.0, intervals as f32);
                let i = (t as usize).min(intervals - 1);
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
