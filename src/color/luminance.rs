//! Luminance: wavelengths by what they bring to the eye in daylight.

use super::cie;
use super::illuminants::Illuminant;
use crate::sampling::discrete_cdf::DiscreteCdf;
use std::sync::LazyLock;

/// A tristimulus value of the CIE 1931 observer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tristimulus {
    /// By x̄.
    X = 0,
    /// By ȳ: luminance.
    Y = 1,
    /// By z̄.
    Z = 2,
}

/// A matching function × D65 at the wavelengths of the table, and the steps between them by its integral.
struct WavelengthDensity {
    density: Vec<f64>,
    steps: DiscreteCdf,
}

/// In the order of [`Tristimulus`].
static DAYLIGHT: LazyLock<[WavelengthDensity; 3]> = LazyLock::new(|| {
    let light = Illuminant::daylight();
    [0, 1, 2].map(|value| {
        let density: Vec<f64> =
            cie::nodes().map(|nm| f64::from(cie::matching(nm)[value]) * f64::from(light.power(nm))).collect();
        let steps = DiscreteCdf::new(density.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]))).normalised();
        WavelengthDensity { density, steps }
    })
});

/// The wavelength in nm below which daylight has a share of its luminance: with uniform shares,
/// wavelengths are drawn in proportion to ȳ (CIE 1931) × D65.
///
/// - `share`: 0 to 1
///
/// The product is linear between 380, 385 … 730 nm; light beyond is left out (1e-4 of it). Checked
/// below.
pub fn wavelength_nm(share: f64) -> f64 {
    wavelength_by(Tristimulus::Y, share)
}

/// [`wavelength_nm`] with the matching function of any tristimulus value in place of ȳ.
pub fn wavelength_by(value: Tristimulus, share: f64) -> f64 {
    let WavelengthDensity { density, steps } = &DAYLIGHT[value as usize];
    let (i, within) = steps.sample(share);
    // the root of the integral of a linear density
    let (a, b) = (density[i], density[i + 1]);
    let root = (a * a + within * (b * b - a * a)).max(0.0).sqrt();
    let along = within * (a + b) / (a + root).max(f64::MIN_POSITIVE);
    let (first, last) = (f64::from(cie::RANGE_NM.0), f64::from(cie::RANGE_NM.1));
    let step = (last - first) / (density.len() - 1) as f64;
    first + step * (i as f64 + along)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Light through a red filter (above 600 nm) and a green one, against sums over the table.
    #[test]
    fn wavelengths_drawn_by_a_tristimulus_value_give_that_behind_a_filter() {
        let light = Illuminant::daylight();
        let white = light.xyz(|_| 1.0);
        for pass in [
            |nm: f64| 1.0 / (1.0 + (-(nm - 600.0) / 10.0).exp()),
            |nm: f64| (-((nm - 530.0) / 30.0).powi(2)).exp(),
        ] {
            let n = 20_000;
            for value in [Tristimulus::X, Tristimulus::Y, Tristimulus::Z] {
                let wavelength = |i: u32| wavelength_by(value, (f64::from(i) + 0.5) / f64::from(n));
                let drawn = (0..n).map(|i| pass(wavelength(i))).sum::<f64>() / f64::from(n);
                let table = f64::from((light.xyz(|nm| pass(f64::from(nm)) as f32) / white)[value as usize]);
                // steps of 5 nm over filters and functions 10 to 30 nm wide
                let tolerance = if value == Tristimulus::Y { 2e-3 * table } else { 1e-3 };
                assert!((drawn - table).abs() < tolerance, "{value:?}: {drawn} {table}");
            }
        }
        assert!(wavelength_by(Tristimulus::Z, 1.0).is_finite());
        assert!((wavelength_nm(0.0) - 380.0).abs() < 1e-9 && (wavelength_nm(1.0) - 730.0).abs() < 1e-9);
        assert!(
            (0..1000)
                .all(|i| wavelength_nm(f64::from(i) / 1000.0) < wavelength_nm(f64::from(i + 1) / 1000.0))
        );
    }
}
