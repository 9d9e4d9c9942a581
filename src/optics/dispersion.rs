//! Refractive index as a function of wavelength.

/// The Fraunhofer lines used for scores, vacuum-to-air differences ignored, wavelengths in µm.
pub mod lines {
    /// B, oxygen.
    pub const B: f64 = 0.686719;
    /// C, hydrogen α.
    pub const C: f64 = 0.656281;
    /// D, sodium: the line that a stone's index is quoted for.
    pub const D: f64 = 0.589294;
    /// d, helium.
    pub const D_HELIUM: f64 = 0.587562;
    /// e, mercury.
    pub const E: f64 = 0.546073;
    /// F, hydrogen β.
    pub const F: f64 = 0.486134;
    /// G, iron.
    pub const G: f64 = 0.43079;
    /// h, mercury's violet line.
    pub const H: f64 = 0.404656;
    /// The six lines B C D e F G over which fire is averaged.
    pub const SIX: [f64; 6] = [B, C, D, E, F, G];
}

/// The wavelengths of a picture, µm: those of [`crate::color::cie::RANGE_NM`].
pub const VISIBLE_UM: (f64, f64) = (0.380, 0.730);

/// A dispersion law; λ in µm, result dimensionless.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Dispersion {
    /// The same index at every wavelength.
    Constant(f64),
    /// n² = 1 + c₀ + Σ B λ² / (λ² − C²), pairs (B, C with C in µm). Formula 1 of
    /// refractiveindex.info.
    Sellmeier { c0: f64, terms: &'static [(f64, f64)] },
    /// n² = 1 + c₀ + Σ B λ² / (λ² − C), pairs (B, C with C in µm²). Formula 2.
    SellmeierSquared { c0: f64, terms: &'static [(f64, f64)] },
    /// n = A + B/λ², B in µm².
    Cauchy { a: f64, b: f64 },
    /// n² = A + B/(λ² − C) + D λ².
    Resonance { a: f64, b: f64, c: f64, d: f64 },
    /// One index from each wavelength on: (up to λ, n), the last entry for the rest. How the
    /// renderers of three colours treat dispersion.
    Steps(&'static [(f64, f64)]),
}

impl Dispersion {
    /// Refractive index at the wavelength `um` (µm).
    pub fn index(&self, um: f64) -> f64 {
        let l2 = um * um;
        match *self {
            Self::Constant(n) => n,
            Self::Sellmeier { c0, terms } => {
                let sum: f64 = terms.iter().map(|(b, c)| b * l2 / (l2 - c * c)).sum();
                (1.0 + c0 + sum).sqrt()
            }
            Self::SellmeierSquared { c0, terms } => {
                let sum: f64 = terms.iter().map(|(b, c)| b * l2 / (l2 - c)).sum();
                (1.0 + c0 + sum).sqrt()
            }
            Self::Cauchy { a, b } => a + b / l2,
            Self::Resonance { a, b, c, d } => (a + b / (l2 - c) + d * l2).sqrt(),
            Self::Steps(steps) => {
                steps.iter().find(|(up_to, _)| um <= *up_to).or(steps.last()).map_or(1.0, |(_, n)| *n)
            }
        }
    }
}
