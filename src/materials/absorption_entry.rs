//! The absorption of a material file: bands, or a table as a spectrometer gives it.

use crate::optics::absorption::{Absorption, AbsorptionSpectrum, Band};
use crate::optics::dispersion::{Dispersion, VISIBLE_NM};
use crate::optics::fresnel::unpolarised;
use crate::optics::spectral_curve::SpectralCurve;
use crate::parse::data_file::ValueProblem;
use crate::parse::spectral_table::{SpectrumEntry, SpectrumLayout, WavelengthUnit};
use crate::parse::table_entry::{TableReader, at, read_visible_rows};
use serde::Deserialize;
use std::f64::consts::LN_10;

/// A measured transmittance may lie so far outside 0 to 1: the noise and drift of a spectrometer.
const NOISE: f64 = 0.02;

/// The least transmittance that is told from none: a spectrometer's stray light is more.
const LEAST_TRANSMITTANCE: f64 = 1e-6;

/// The greatest absorption coefficient (1/mm), width (cm⁻¹) or wavelength (nm): beyond any that is known.
const MOST: f64 = 1e9;

/// Most bands.
const MOST_BANDS: usize = 1000;

/// `[absorption]`: bands, or a table.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct AbsorptionEntry {
    about: Option<String>,
    source: Option<String>,
    band: Option<Vec<BandEntry>>,
    table: Option<SpectrumEntry>,
    wavelength: Option<WavelengthUnit>,
    columns: Option<[usize; 2]>,
    quantity: Option<Quantity>,
    path_mm: Option<f64>,
    #[serde(default)]
    includes_surface_losses: bool,
}

/// `[[absorption.band]]`
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct BandEntry {
    #[serde(default)]
    name: String,
    centre_nm: f64,
    half_widths_per_cm: [f64; 2],
    peak_per_mm: f64,
}

/// What a table has of the light that is lost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Quantity {
    /// Absorption coefficient, natural logarithm, 1/mm.
    PerMm,
    /// The same, 1/cm.
    PerCm,
    /// Absorbance of the path, decadic logarithm.
    Absorbance,
    /// Share of the light that comes through the path, 0 to 1.
    Transmittance,
    /// The same in hundredths.
    PercentTransmittance,
}

impl Quantity {
    /// Whether it is that of a path of some length.
    fn is_of_path(self) -> bool {
        !matches!(self, Quantity::PerMm | Quantity::PerCm)
    }
}

impl AbsorptionEntry {
    /// The absorption of a material of this index.
    pub fn absorption(&self, index: &Dispersion, tables: TableReader) -> Result<Absorption, ValueProblem> {
        let (spectrum, kind) = match (&self.band, &self.table) {
            (Some(bands), None) => (self.bands(bands)?, format!("the sum of {} bands", bands.len())),
            (None, Some(table)) => (self.curve(table, index, tables)?, "a table".into()),
            (Some(_), Some(_)) => {
                return Err(ValueProblem::new("table", "bands or a table", "both"));
            }
            (None, None) => return Err(ValueProblem::new("absorption", "bands or a table", "neither")),
        };
        let source = self.source.clone().unwrap_or_else(|| "not stated".into());
        Ok(Absorption { spectrum, about: self.about.clone().unwrap_or(kind).into(), source: source.into() })
    }

    fn bands(&self, bands: &[BandEntry]) -> Result<AbsorptionSpectrum, ValueProblem> {
        for (key, given) in [
            ("wavelength", self.wavelength.is_some()),
            ("columns", self.columns.is_some()),
            ("quantity", self.quantity.is_some()),
            ("path-mm", self.path_mm.is_some()),
            ("includes-surface-losses", self.includes_surface_losses),
        ] {
            if given {
                return Err(ValueProblem::new(key, "a table beside it", "bands"));
            }
        }
        if bands.len() > MOST_BANDS {
            return Err(ValueProblem::new(
                "band",
                format!("at most {MOST_BANDS} bands"),
                bands.len().to_string(),
            ));
        }
        let bands: Result<Vec<Band>, ValueProblem> = bands.iter().map(BandEntry::band).collect();
        Ok(AbsorptionSpectrum::Bands(bands?.into()))
    }

    fn curve(
        &self,
        table: &SpectrumEntry,
        index: &Dispersion,
        tables: TableReader,
    ) -> Result<AbsorptionSpectrum, ValueProblem> {
        const QUANTITIES: &str = "per-mm, per-cm, absorbance, transmittance or percent-transmittance";
        let quantity = self.quantity.ok_or_else(|| ValueProblem::new("quantity", QUANTITIES, "none"))?;
        let path_mm = match self.path_mm {
            Some(mm) if quantity.is_of_path() && mm > 0.0 && mm.is_finite() => mm,
            None if !quantity.is_of_path() => 1.0,
            Some(mm) if quantity.is_of_path() => {
                return Err(ValueProblem::new("path-mm", "a length above 0 in mm", mm.to_string()));
            }
            Some(_) => {
                return Err(ValueProblem::new("path-mm", "absorbance or transmittance", "a coefficient"));
            }
            None => return Err(ValueProblem::new("path-mm", "the length of the path in mm", "none")),
        };
        if self.includes_surface_losses && !quantity.is_of_path() {
            let expected = "absorbance or transmittance";
            return Err(ValueProblem::new("includes-surface-losses", expected, "a coefficient"));
        }
        let layout =
            SpectrumLayout { wavelength: self.wavelength.unwrap_or_default(), columns: self.columns };
        let rows = read_visible_rows(table, layout, tables)?;
        // what lies beyond the neighbours of a picture's wavelengths is noise, or another law's
        let (from, to) = VISIBLE_NM;
        let begin = rows.partition_point(|row| row.nm <= from).saturating_sub(1);
        let end = (rows.partition_point(|row| row.nm < to) + 1).min(rows.len());
        let mut points = Vec::with_capacity(end - begin);
        for row in &rows[begin..end] {
            let n = index.index(row.nm.clamp(from, to));
            let surface = self.includes_surface_losses.then(|| unpolarised(1.0, n).0);
            let per_mm = match quantity {
                Quantity::PerMm => positive(row.value),
                Quantity::PerCm => positive(row.value / 10.0),
                Quantity::Absorbance => of_plate((-LN_10 * row.value).exp(), path_mm, surface),
                Quantity::Transmittance => of_plate(row.value, path_mm, surface),
                Quantity::PercentTransmittance => of_plate(row.value / 100.0, path_mm, surface),
            };
            let per_mm = per_mm.map_err(|expected| at(table, row.line, expected, row.value.to_string()))?;
            points.push((row.nm, per_mm));
        }
        let curve = SpectralCurve::new(points).map(AbsorptionSpectrum::Table);
        curve.ok_or_else(|| ValueProblem::new("table", "rising wavelengths", "none"))
    }
}

impl BandEntry {
    fn band(&self) -> Result<Band, ValueProblem> {
        for (key, value, expected) in [
            ("centre-nm", self.centre_nm, "a wavelength"),
            ("half-widths-per-cm", self.half_widths_per_cm[0], "widths"),
            ("half-widths-per-cm", self.half_widths_per_cm[1], "widths"),
            ("peak-per-mm", self.peak_per_mm, "an absorption coefficient"),
        ] {
            if !(value > 0.0 && value <= MOST) {
                let expected = format!("{expected} above 0 in band '{}'", self.name.escape_debug());
                return Err(ValueProblem::new(key, expected, value.to_string()));
            }
        }
        Ok(Band {
            name: self.name.clone().into(),
            centre_nm: self.centre_nm,
            half_widths_per_cm: self.half_widths_per_cm.into(),
            peak_per_mm: self.peak_per_mm,
        })
    }
}

/// An absorption coefficient, or what is expected of one.
fn positive(per_mm: f64) -> Result<f64, String> {
    if (0.0..=MOST).contains(&per_mm) {
        Ok(per_mm)
    } else {
        Err("an absorption coefficient of 0 or more".into())
    }
}

/// Absorption coefficient, 1/mm, of a plate that lets a share of the light through, or what is expected of it.
///
/// - `surface`: reflectance R of each face, where the share includes their losses. With x = exp(−a L) of one
///   crossing T = (1 − R)² x/(1 − R² x²), the light that goes to and fro included.
fn of_plate(transmittance: f64, path_mm: f64, surface: Option<f64>) -> Result<f64, String> {
    let clear = surface.map_or(1.0, |r| (1.0 - r) / (1.0 + r));
    if !(-NOISE..=clear + NOISE).contains(&transmittance) {
        return Err(format!("a transmittance from 0 to {clear:.3}, that of a clear plate"));
    }
    let t = transmittance.clamp(LEAST_TRANSMITTANCE, clear);
    let x = match surface {
        None => t,
        Some(r) => {
            let through = (1.0 - r) * (1.0 - r);
            // the positive root of T R² x² + (1 − R)² x − T = 0, in the form that loses no digits
            2.0 * t / (through + (through * through + 4.0 * t * t * r * r).sqrt())
        }
    };
    Ok((-x.ln() / path_mm).max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plate_gives_back_what_it_absorbs() {
        for (r, a, mm) in [(0.172f64, 0.3f64, 2.0f64), (0.04, 0.01, 10.0), (0.08, 1.5, 1.0)] {
            let x = (-a * mm).exp();
            let t = (1.0 - r).powi(2) * x / (1.0 - r * r * x * x);
            assert!((of_plate(t, mm, Some(r)).expect("a plate") - a).abs() < 1e-12);
            assert!((of_plate(x, mm, None).expect("a path") - a).abs() < 1e-12);
        }
        assert_eq!(of_plate(1.01, 1.0, None), Ok(0.0));
        assert!(of_plate(0.9, 1.0, Some(0.172)).is_err() && of_plate(1.1, 1.0, None).is_err());
        assert!(of_plate(0.0, 1.0, None).is_ok_and(|a| (a - 6.0 * LN_10).abs() < 1e-12));
    }
}
