//! The index of a material file: a law by its coefficients, or a table.

use crate::optics::dispersion::{Dispersion, lines};
use crate::optics::spectral_curve::SpectralCurve;
use crate::parse::data_file::ValueProblem;
use crate::parse::spectral_table::{SpectrumEntry, SpectrumLayout, WavelengthUnit};
use crate::parse::table_entry::{TableReader, read_rows};
use serde::Deserialize;

/// Most coefficients of a law.
const MOST_TERMS: usize = 20;

/// `[index]`: one law.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct IndexEntry {
    n_d: Option<f64>,
    b_g: Option<f64>,
    constant: Option<f64>,
    sellmeier: Option<Vec<[f64; 2]>>,
    sellmeier_squared: Option<Vec<[f64; 2]>>,
    cauchy: Option<Vec<f64>>,
    resonance: Option<[f64; 4]>,
    steps: Option<Vec<[f64; 2]>>,
    table: Option<SpectrumEntry>,
    wavelength: Option<WavelengthUnit>,
    columns: Option<[usize; 2]>,
}

impl IndexEntry {
    /// The law, and the key that it is given by.
    pub fn dispersion(&self, tables: TableReader) -> Result<(Dispersion, &'static str), ValueProblem> {
        self.check_company()?;
        let c0 = self.constant.unwrap_or(0.0);
        let mut laws: Vec<(&'static str, Dispersion)> = Vec::new();
        if let Some(n_d) = self.n_d {
            laws.push(("n-d", Dispersion::through(n_d, self.b_g)));
        }
        if let Some(terms) = &self.sellmeier {
            laws.push((
                "sellmeier",
                Dispersion::Sellmeier { c0, terms: terms_of("sellmeier", terms)?.into() },
            ));
        }
        if let Some(terms) = &self.sellmeier_squared {
            let terms = terms_of("sellmeier-squared", terms)?.into();
            laws.push(("sellmeier-squared", Dispersion::SellmeierSquared { c0, terms }));
        }
        if let Some(coefficients) = &self.cauchy {
            laws.push(("cauchy", cauchy(coefficients)?));
        }
        if let Some([a, b, c, d]) = self.resonance {
            laws.push(("resonance", Dispersion::Resonance { a, b, c, d }));
        }
        if let Some(steps) = &self.steps {
            let pairs = terms_of("steps", steps)?;
            if let Some(pair) = pairs.windows(2).find(|pair| pair[0].0 >= pair[1].0) {
                return Err(ValueProblem::new("steps", "rising wavelengths", format!("{} nm", pair[1].0)));
            }
            laws.push(("steps", Dispersion::Steps(pairs.into())));
        }
        if let Some(table) = &self.table {
            laws.push(("table", self.table(table, tables)?));
        }
        if let [(key, law)] = &laws[..] {
            return Ok((law.clone(), key));
        }
        let keys: Vec<&str> = laws.iter().map(|(key, _)| *key).collect();
        let found = if keys.is_empty() { "none".into() } else { keys.join(" and ") };
        let expected = "one of n-d, sellmeier, sellmeier-squared, cauchy, resonance, steps, table";
        Err(ValueProblem::new(laws.last().map_or("index", |(key, _)| key), expected, found))
    }

    /// Where the law holds if the file does not say: a table where it has rows, a law through the lines G and B
    /// between them; of others nothing is known.
    pub fn range_nm(&self, law: &Dispersion) -> (f64, f64) {
        match law {
            Dispersion::Table(curve) => curve.range_nm(),
            _ if self.n_d.is_some() => (lines::G, lines::B),
            _ => (0.0, f64::INFINITY),
        }
    }

    /// Refuses keys that belong to another law, and dispersions that cannot be.
    fn check_company(&self) -> Result<(), ValueProblem> {
        let sellmeier = self.sellmeier.is_some() || self.sellmeier_squared.is_some();
        for (key, lonely, company) in [
            ("b-g", self.b_g.is_some() && self.n_d.is_none(), "n-d"),
            ("constant", self.constant.is_some() && !sellmeier, "sellmeier or sellmeier-squared"),
            ("wavelength", self.wavelength.is_some() && self.table.is_none(), "a table"),
            ("columns", self.columns.is_some() && self.table.is_none(), "a table"),
        ] {
            if lonely {
                return Err(ValueProblem::new(key, format!("{company} beside it"), "none"));
            }
        }
        match self.b_g {
            Some(b_g) if !(0.0..=1.0).contains(&b_g) => {
                Err(ValueProblem::new("b-g", "a difference of indices from 0 to 1", b_g.to_string()))
            }
            _ => Ok(()),
        }
    }

    fn table(&self, table: &SpectrumEntry, tables: TableReader) -> Result<Dispersion, ValueProblem> {
        let layout =
            SpectrumLayout { wavelength: self.wavelength.unwrap_or_default(), columns: self.columns };
        let rows = read_rows(table, layout, tables)?;
        let points = rows.iter().map(|row| (row.nm, row.value)).collect();
        let curve = SpectralCurve::new(points);
        curve.map(Dispersion::Table).ok_or_else(|| ValueProblem::new("table", "rising wavelengths", "none"))
    }
}

/// Pairs of a law: at least one, not too many.
fn terms_of(key: &'static str, terms: &[[f64; 2]]) -> Result<Vec<(f64, f64)>, ValueProblem> {
    check_count(key, terms.len())?;
    Ok(terms.iter().map(|[a, b]| (*a, *b)).collect())
}

fn cauchy(coefficients: &[f64]) -> Result<Dispersion, ValueProblem> {
    check_count("cauchy", coefficients.len())?;
    Ok(match *coefficients {
        [a, b] => Dispersion::Cauchy { a, b },
        _ => Dispersion::CauchySeries(coefficients.into()),
    })
}

fn check_count(key: &'static str, count: usize) -> Result<(), ValueProblem> {
    if (1..=MOST_TERMS).contains(&count) {
        return Ok(());
    }
    Err(ValueProblem::new(key, format!("1 to {MOST_TERMS} entries"), count.to_string()))
}
