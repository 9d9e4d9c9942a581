//! Absorption: how much light a stone keeps on the way, by Beer–Lambert.

use super::spectral_curve::SpectralCurve;
use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;

/// One absorption band: over wavenumber, half a Gaussian on either side of its peak. Bands that
/// vibrations broaden fall off more slowly towards the blue.
#[derive(Debug, Clone, PartialEq)]
pub struct Band {
    /// What absorbs.
    pub name: Cow<'static, str>,
    /// Wavelength of the peak, nm.
    pub centre_nm: f64,
    /// From the peak to half its height towards the red and towards the blue, cm⁻¹.
    pub half_widths_per_cm: (f64, f64),
    /// Absorption coefficient at the peak, natural logarithm, 1/mm.
    pub peak_per_mm: f64,
}

/// The absorption of a material: its spectrum, and where that is from.
#[derive(Clone, PartialEq)]
pub struct Absorption {
    /// The spectrum.
    pub spectrum: AbsorptionSpectrum,
    /// Concentration and ray, and how sure the figures are.
    pub about: Cow<'static, str>,
    /// Where they are from.
    pub source: Cow<'static, str>,
}

/// An absorption spectrum.
#[derive(Debug, Clone, PartialEq)]
pub enum AbsorptionSpectrum {
    /// The sum of bands.
    Bands(Arc<[Band]>),
    /// A table: absorption coefficient, natural logarithm, 1/mm, against nm.
    Table(SpectralCurve),
}

impl Band {
    /// Absorption coefficient at `nm`, natural logarithm, 1/mm.
    pub fn per_mm(&self, nm: f64) -> f64 {
        const PER_CM: f64 = 1e7; // cm⁻¹ × nm
        let off = PER_CM / nm - PER_CM / self.centre_nm;
        let (red, blue) = self.half_widths_per_cm;
        let half_width = if off < 0.0 { red } else { blue };
        self.peak_per_mm * (-std::f64::consts::LN_2 * (off / half_width).powi(2)).exp()
    }
}

/// Photon maps are known by a checksum of this text, so that of bands stays as it is.
impl fmt::Debug for Absorption {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let mut fields = f.debug_struct("Absorption");
        match &self.spectrum {
            AbsorptionSpectrum::Bands(bands) => fields.field("bands", bands),
            AbsorptionSpectrum::Table(table) => fields.field("table", table),
        };
        fields.field("about", &self.about).field("source", &self.source).finish()
    }
}

impl Absorption {
    /// The sum of bands.
    pub fn from_bands(
        bands: impl Into<Arc<[Band]>>,
        about: impl Into<Cow<'static, str>>,
        source: impl Into<Cow<'static, str>>,
    ) -> Absorption {
        let spectrum = AbsorptionSpectrum::Bands(bands.into());
        Absorption { spectrum, about: about.into(), source: source.into() }
    }

    /// Absorption coefficient at `nm`, natural logarithm, 1/mm: exp(−a x) of the light is left after
    /// `x` mm.
    pub fn per_mm(&self, nm: f64) -> f64 {
        match &self.spectrum {
            AbsorptionSpectrum::Bands(bands) => bands.iter().map(|band| band.per_mm(nm)).sum(),
            AbsorptionSpectrum::Table(curve) => curve.at(nm),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_has_its_height_and_its_width() {
        let band = Band {
            name: "test".into(),
            centre_nm: 500.0,
            half_widths_per_cm: (1000.0, 2000.0),
            peak_per_mm: 0.3,
        };
        assert!((band.per_mm(500.0) - 0.3).abs() < 1e-15);
        // half a width from 20,000 cm⁻¹ on either side
        for wavenumber in [19_000.0, 22_000.0] {
            assert!((band.per_mm(1e7 / wavenumber) - 0.15).abs() < 1e-12);
        }
        let both = Absorption::from_bands([band.clone(), band], "", "");
        assert!((both.per_mm(500.0) - 0.6).abs() < 1e-15);
    }
}
