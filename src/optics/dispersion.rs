//! Refractive index as a function of wavelength.

use super::spectral_curve::SpectralCurve;
use std::sync::Arc;

/// The Fraunhofer lines used for scores, vacuum-to-air differences ignored, wavelengths in nm.
pub mod lines {
    /// B, oxygen.
    pub const B: f64 = 686.719;
    /// C, hydrogen α.
    pub const C: f64 = 656.281;
    /// D, sodium: the line that a stone's index is quoted for.
    pub const D: f64 = 589.294;
    /// d, helium.
    pub const D_HELIUM: f64 = 587.562;
    /// e, mercury.
    pub const E: f64 = 546.073;
    /// F, hydrogen β.
    pub const F: f64 = 486.134;
    /// G, iron.
    pub const G: f64 = 430.79;
    /// h, mercury's violet line.
    pub const H: f64 = 404.656;
    /// The six lines B C D e F G over which fire is averaged.
    pub const SIX: [f64; 6] = [B, C, D, E, F, G];
}

/// The wavelengths of a picture, nm: those of [`crate::color::cie::RANGE_NM`].
pub const VISIBLE_NM: (f64, f64) = (380.0, 730.0);

/// A dispersion law: refractive index as a function of wavelength. Coefficients are those of the
/// published formulas, in which λ is in µm; [`Dispersion::index`] takes nm.
#[derive(Debug, Clone, PartialEq)]
pub enum Dispersion {
    /// The same index at every wavelength.
    Constant(f64),
    /// n² = 1 + c₀ + Σ B λ² / (λ² − C²), pairs (B, C with C in µm). Formula 1 of
    /// refractiveindex.info.
    Sellmeier {
        /// c₀.
        c0: f64,
        /// B and C, C in µm.
        terms: Arc<[(f64, f64)]>,
    },
    /// n² = 1 + c₀ + Σ B λ² / (λ² − C), pairs (B, C with C in µm²). Formula 2.
    SellmeierSquared {
        /// c₀.
        c0: f64,
        /// B and C, C in µm².
        terms: Arc<[(f64, f64)]>,
    },
    /// n = A + B/λ², B in µm².
    Cauchy {
        /// A.
        a: f64,
        /// B, µm².
        b: f64,
    },
    /// n = A + B/λ² + C/λ⁴ + …, with any number of coefficients.
    CauchySeries(Arc<[f64]>),
    /// n² = A + B/(λ² − C) + D λ².
    Resonance {
        /// A.
        a: f64,
        /// B, µm².
        b: f64,
        /// C, µm².
        c: f64,
        /// D, 1/µm².
        d: f64,
    },
    /// A step function: pairs (greatest wavelength in nm, n) in rising order, the last for all longer
    /// wavelengths. The dispersion of renderers of three colours.
    Steps(Arc<[(f64, f64)]>),
    /// A table of n against nm.
    Table(SpectralCurve),
}

impl Dispersion {
    /// Cauchy's law through an index at D and a difference between G and B; one index if that is not known.
    pub fn through(n_d: f64, b_g: Option<f64>) -> Dispersion {
        let Some(b_g) = b_g else { return Self::Constant(n_d) };
        let (b_um, d_um, g_um) = (lines::B / 1000.0, lines::D / 1000.0, lines::G / 1000.0);
        let b = b_g / (1.0 / (g_um * g_um) - 1.0 / (b_um * b_um));
        Self::Cauchy { a: n_d - b / (d_um * d_um), b }
    }

    /// Refractive index at the wavelength `nm`.
    pub fn index(&self, nm: f64) -> f64 {
        let um = nm / 1000.0;
        let l2 = um * um;
        match self {
            Self::Constant(n) => *n,
            Self::Sellmeier { c0, terms } => {
                let sum: f64 = terms.iter().map(|(b, c)| b * l2 / (l2 - c * c)).sum();
                (1.0 + c0 + sum).sqrt()
            }
            Self::SellmeierSquared { c0, terms } => {
                let sum: f64 = terms.iter().map(|(b, c)| b * l2 / (l2 - c)).sum();
                (1.0 + c0 + sum).sqrt()
            }
            Self::Cauchy { a, b } => a + b / l2,
            Self::CauchySeries(coefficients) => coefficients.iter().rev().fold(0.0, |n, c| n / l2 + c),
            Self::Resonance { a, b, c, d } => (a + b / (l2 - c) + d * l2).sqrt(),
            Self::Steps(steps) => {
                steps.iter().find(|(up_to, _)| nm <= *up_to).or(steps.last()).map_or(1.0, |(_, n)| *n)
            }
            Self::Table(curve) => curve.at(nm),
        }
    }
}
