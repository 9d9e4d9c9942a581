//! Illuminant files: an illuminant as TOML, of the catalogue or of a user. Their grammar is in
//! [`crate::manual::scenes`].
//!
//! The reader works on text; whoever calls it says how the table that a file names is read.

use super::super::cie;
use super::daylight_series::{TEMPERATURES_K, daylight};
use super::{Illuminant, SpectralPower};
#[cfg(feature = "files")]
use crate::limits::Limits;
use crate::parse::data_file::{DataFile, DataFileError, ValueProblem};
use crate::parse::spectral_table::{SpectrumEntry, SpectrumLayout, SpectrumRow, WavelengthUnit};
use crate::parse::table_entry::{TableReader, at, read_visible_rows};
#[cfg(feature = "files")]
use crate::storage::include;
use serde::Deserialize;
use std::ops::RangeInclusive;
#[cfg(feature = "files")]
use std::path::Path;
use toml::Spanned;

/// c₂ of Planck's law, nm K. Source: CODATA 2018.
const C2_NM_K: f64 = 1.438_776_877e7;

/// Temperatures of a black body that shines, K.
const BLACK_BODY_K: RangeInclusive<f64> = 1000.0..=100_000.0;

/// Values of a table; only their shape counts.
const POWERS: RangeInclusive<f64> = 0.0..=1e12;

/// The greatest value of a table is at least this.
const LEAST_POWER: f64 = 1e-12;

/// An illuminant file as written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct IlluminantFile {
    name: String,
    about: Option<String>,
    source: Option<String>,
    power: Spanned<PowerEntry>,
}

/// `[power]`: relative power per nm.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct PowerEntry {
    #[serde(default)]
    equal: bool,
    black_body_k: Option<f64>,
    c2_nm_k: Option<f64>,
    daylight_k: Option<f64>,
    table: Option<SpectrumEntry>,
    wavelength: Option<WavelengthUnit>,
    columns: Option<[usize; 2]>,
}

impl Illuminant {
    /// The illuminant that a TOML text describes.
    ///
    /// - `file`: how messages name the text; `tables`: reads the table that it names, or says why it cannot
    pub fn parse(file: &str, text: &str, tables: TableReader) -> Result<Illuminant, DataFileError> {
        let file = DataFile { name: file, text };
        let IlluminantFile { name, about, source, power } = file.document()?;
        if name.trim().is_empty() || name.chars().any(char::is_control) {
            return Err(file.error(0, ValueProblem::new("name", "a name", format!("{name:?}"))));
        }
        let spectrum = power.get_ref().spectrum(tables);
        let spectrum = spectrum.map_err(|problem| file.error(power.span().start, problem))?;
        let illuminant = Illuminant {
            about: about.unwrap_or_else(|| name.clone()).into(),
            source: source.unwrap_or_else(|| "not stated".into()).into(),
            name: name.into(),
            spectrum,
        };
        if !illuminant.xyz(|_| 1.0).is_finite() {
            let dark = ValueProblem::new("power", "light that an eye sees", "none");
            return Err(file.error(power.span().start, dark));
        }
        Ok(illuminant)
    }

    /// The illuminant in the regular file at `path`; the table that it names lies in its folder or below.
    ///
    /// - `name`: how messages name the file
    #[cfg(feature = "files")]
    pub fn read(path: &Path, name: &str, limits: Limits) -> Result<Illuminant, DataFileError> {
        let file = crate::parse::display_name(name);
        let unreadable = |problem| DataFileError::Unreadable { file: file.clone(), problem };
        let content = include::read_text(path, true, limits).map_err(unreadable)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Illuminant::parse(&file, &content, &|table| include::read_table(folder, table, limits))
    }
}

impl PowerEntry {
    fn spectrum(&self, tables: TableReader) -> Result<SpectralPower, ValueProblem> {
        for (key, lonely, company) in [
            ("c2-nm-k", self.c2_nm_k.is_some() && self.black_body_k.is_none(), "black-body-k"),
            ("wavelength", self.wavelength.is_some() && self.table.is_none(), "a table"),
            ("columns", self.columns.is_some() && self.table.is_none(), "a table"),
        ] {
            if lonely {
                return Err(ValueProblem::new(key, format!("{company} beside it"), "none"));
            }
        }
        match (self.equal, self.black_body_k, self.daylight_k, &self.table) {
            (true, None, None, None) => Ok(SpectralPower::Equal),
            (false, Some(kelvin), None, None) => {
                let kelvin = within("black-body-k", kelvin, &BLACK_BODY_K, "a temperature in K")?;
                let c2 = self.c2_nm_k.unwrap_or(C2_NM_K);
                let c2 = within("c2-nm-k", c2, &(1.4e7..=1.5e7), "c2 in nm K")?;
                Ok(SpectralPower::Planck { c2_over_t: c2 / kelvin })
            }
            (false, None, Some(kelvin), None) => {
                let kelvin = within("daylight-k", kelvin, &TEMPERATURES_K, "a temperature in K")?;
                Ok(SpectralPower::Table(daylight(kelvin).into()))
            }
            (false, None, None, Some(table)) => self.table(table, tables),
            _ => {
                let expected = "one of equal = true, black-body-k, daylight-k, table";
                Err(ValueProblem::new("power", expected, "none or several"))
            }
        }
    }

    fn table(&self, table: &SpectrumEntry, tables: TableReader) -> Result<SpectralPower, ValueProblem> {
        let layout =
            SpectrumLayout { wavelength: self.wavelength.unwrap_or_default(), columns: self.columns };
        let rows = read_visible_rows(table, layout, tables)?;
        if let Some(row) = rows.iter().find(|row| !POWERS.contains(&row.value)) {
            let expected = format!("powers from 0 to {:e}", POWERS.end());
            return Err(at(table, row.line, expected, row.value.to_string()));
        }
        let values = even(&rows);
        if f64::from(values.iter().fold(0f32, |most, value| most.max(*value))) < LEAST_POWER {
            return Err(ValueProblem::new("table", "light from 380 to 730 nm", "none"));
        }
        Ok(SpectralPower::Table(values.into()))
    }
}

/// A number in a range.
fn within(key: &'static str, x: f64, range: &RangeInclusive<f64>, what: &str) -> Result<f64, ValueProblem> {
    let expected = || format!("{what} from {} to {}", range.start(), range.end());
    if range.contains(&x) { Ok(x) } else { Err(ValueProblem::new(key, expected(), x.to_string())) }
}

/// The values of a table at even steps over the range of a picture: its own if it has a row every 10 or 5 nm,
/// else one every nm, linear between its rows. Beyond its ends it has their values.
fn even(rows: &[SpectrumRow]) -> Vec<f32> {
    let (from, to) = (f64::from(cie::RANGE_NM.0), f64::from(cie::RANGE_NM.1));
    let inside: Vec<&SpectrumRow> = rows.iter().filter(|row| (from..=to).contains(&row.nm)).collect();
    let steps = |step: f64| (0..=((to - from) / step) as usize).map(move |i| from + step * i as f64);
    for step in [10.0, 5.0] {
        if inside.iter().map(|row| row.nm).eq(steps(step)) {
            return inside.iter().map(|row| row.value as f32).collect();
        }
    }
    steps(1.0).map(|nm| linear(rows, nm) as f32).collect()
}

/// The value at a wavelength, linear between two rows.
fn linear(rows: &[SpectrumRow], nm: f64) -> f64 {
    let i = rows.partition_point(|row| row.nm <= nm).clamp(1, rows.len() - 1) - 1;
    let (a, b) = (rows[i], rows[i + 1]);
    a.value + (b.value - a.value) * ((nm - a.nm) / (b.nm - a.nm)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(power: &str) -> Result<Illuminant, DataFileError> {
        let text = format!("name = \"lamp\"\n[power]\n{power}\n");
        Illuminant::parse("lamp.toml", &text, &|_| Ok("nm;p\n380;1,0\n480;3\n730;3\n".into()))
    }

    /// [P] The tables of D65 and D50 are those of the series at 6504 K and 5003 K. The published ones are
    /// computed with factors of three decimals, which changes them by less than 0.05.
    #[test]
    fn daylight_of_a_temperature_is_that_of_the_published_tables() {
        for (name, kelvin) in [("D65", 6504), ("D50", 5003)] {
            let published = Illuminant::by_name(name).expect("in the catalogue");
            let computed = parse(&format!("daylight-k = {kelvin}")).expect("a temperature");
            for nm in cie::nodes() {
                assert!((computed.power(nm) - published.power(nm)).abs() < 0.05, "{name} at {nm}");
            }
        }
        let [x, y] = parse("daylight-k = 10000").expect("a temperature").chromaticity();
        // the locus of daylight at 10,000 K
        assert!((x - 0.2788).abs() < 1e-3 && (y - 0.2920).abs() < 1e-3, "{x} {y}");
    }

    #[test]
    fn tables_and_temperatures_are_read() {
        let lamp = parse("table = \"lamp.csv\"").expect("a table");
        for (nm, power) in [(380.0, 1.0), (430.0, 2.0), (480.0, 3.0), (600.0, 3.0)] {
            assert!((lamp.power(nm) - power).abs() < 1e-5, "{nm}: {}", lamp.power(nm));
        }
        let a = Illuminant::by_name("A").expect("in the catalogue");
        let lamp = parse("black-body-k = 2855.5").expect("a temperature");
        assert!(cie::nodes().all(|nm| (lamp.power(nm) / a.power(nm) - 1.0).abs() < 1e-3));
        let coarse = parse("table = [[300, 2], [800, 2]]").expect("a table");
        assert!(cie::nodes().all(|nm| coarse.power(nm) == 2.0));
    }

    #[test]
    fn what_is_no_illuminant_is_refused_with_its_place() {
        for (power, said) in [
            ("daylight-k = 3000", "lamp.toml, line 3: daylight-k: expected a temperature in K from 4000"),
            ("equal = true\nblack-body-k = 3000", "line 2: power: expected one of"),
            ("table = [[380, 1], [390, -1], [730, 1]]", "line 3: table: expected powers from 0"),
            ("table = [[380, 1], [390, -1], [730, 1]]", "found -1 in row 2"),
            ("table = [[500, 1], [600, 1]]", "expected a table from 400 to 700 nm or more"),
            ("table = [[380, 0], [730, 0]]", "expected light from 380"),
            ("balck-body-k = 3000", "did you mean 'black-body-k'?"),
        ] {
            let error = parse(power).expect_err(power).to_string();
            assert!(error.contains(said), "{error}");
        }
    }
}
