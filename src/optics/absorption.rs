//! Absorption: how much light a stone keeps on the way, by Beer–Lambert.

/// One absorption band: over wavenumber, half a Gaussian on either side of its peak. Bands that
/// vibrations broaden fall off more slowly towards the blue.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Band {
    /// What absorbs.
    pub name: &'static str,
    /// Wavelength of the peak, nm.
    pub centre_nm: f64,
    /// From the peak to half its height towards the red and towards the blue, cm⁻¹.
    pub half_widths_per_cm: (f64, f64),
    /// Absorption coefficient at the peak, natural logarithm, 1/mm.
    pub peak_per_mm: f64,
}

/// An absorption spectrum: the sum of its bands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Absorption {
    /// The bands.
    pub bands: &'static [Band],
    /// Concentration and ray, and how sure the figures are.
    pub about: &'static str,
    /// Where they are from.
    pub source: &'static str,
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

impl Absorption {
    /// Absorption coefficient at `nm`, natural logarithm, 1/mm: exp(−a x) of the light is left after
    /// `x` mm.
    pub fn per_mm(&self, nm: f64) -> f64 {
        self.bands.iter().map(|band| band.per_mm(nm)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_has_its_height_and_its_width() {
        const BAND: Band =
            Band { name: "test", centre_nm: 500.0, half_widths_per_cm: (1000.0, 2000.0), peak_per_mm: 0.3 };
        assert!((BAND.per_mm(500.0) - 0.3).abs() < 1e-15);
        // half a width from 20,000 cm⁻¹ on either side
        for wavenumber in [19_000.0, 22_000.0] {
            assert!((BAND.per_mm(1e7 / wavenumber) - 0.15).abs() < 1e-12);
        }
        let both = Absorption { bands: &[BAND, BAND], about: "", source: "" };
        assert!((both.per_mm(500.0) - 0.6).abs() < 1e-15);
    }
}
