//! The crystal of a material file: the other indices, what it absorbs along their axes, and how it is cut.

use super::absorption_entry::AbsorptionEntry;
use super::birefringence::{Birefringence, CrystalAxis};
use super::crystal_orientation::CrystalOrientation;
use super::index_entry::IndexEntry;
use crate::optics::dispersion::{Dispersion, lines};
use crate::parse::data_file::{DataFile, DataFileError, ValueProblem};
use serde::Deserialize;
use toml::Spanned;

/// Indices of the D line may be out of order by this: rounding of a law's coefficients.
const ROUNDING: f64 = 1e-6;

/// The tables of a crystal's other axes in a material file; those of the first are the material's own.
#[derive(Debug, Default)]
pub struct CrystalEntry {
    /// `[extraordinary-index]` and `[extraordinary-absorption]`.
    pub extraordinary: AxisEntry,
    /// `[alpha-index]` and `[alpha-absorption]`.
    pub alpha: AxisEntry,
    /// `[gamma-index]` and `[gamma-absorption]`.
    pub gamma: AxisEntry,
}

/// The tables of one axis.
#[derive(Debug, Default)]
pub struct AxisEntry {
    /// The index.
    pub index: Option<Spanned<IndexEntry>>,
    /// The absorption.
    pub absorption: Option<Spanned<AbsorptionEntry>>,
}

/// `c-axis`: a word, or angles in degrees.
#[derive(Debug, Deserialize)]
#[serde(untagged, expecting = "c-axis is to be \"up\", \"across\" or angles [theta, phi] in degrees")]
pub enum OrientationEntry {
    /// `up` or `across`.
    Word(String),
    /// θ and φ, and ψ of a biaxial crystal.
    Angles(Vec<f64>),
}

/// Reads the tables of one axis.
type ReadAxis<'a> =
    &'a dyn Fn(&Spanned<IndexEntry>, Option<&Spanned<AbsorptionEntry>>) -> Result<CrystalAxis, DataFileError>;

impl CrystalEntry {
    /// The crystal; none of an isotropic material.
    ///
    /// - `own`: the dispersion of `[index]` and where it holds, nm; `file`: names places; `axis`: reads the tables of one axis
    pub fn crystal(
        &self,
        own: (&Dispersion, (f64, f64)),
        file: &DataFile,
        axis: ReadAxis,
    ) -> Result<Option<Birefringence>, DataFileError> {
        self.check_company().map_err(|(start, problem)| file.error(start, problem))?;
        let read = |key: &'static str, entry: &Spanned<IndexEntry>, absorption| {
            let found = axis(entry, absorption)?;
            let range = entry.get_ref().range_nm(&found.dispersion);
            check_overlap(key, own.1, range).map_err(|problem| file.error(entry.span().start, problem))?;
            Ok::<CrystalAxis, DataFileError>(found)
        };
        if let Some(index) = &self.extraordinary.index {
            let absorption = self.extraordinary.absorption.as_ref();
            let extraordinary = read("extraordinary-index", index, absorption)?;
            return Ok(Some(Birefringence::Uniaxial { extraordinary }));
        }
        let (Some(alpha_index), Some(gamma_index)) = (&self.alpha.index, &self.gamma.index) else {
            return Ok(None);
        };
        let alpha = read("alpha-index", alpha_index, self.alpha.absorption.as_ref())?;
        let gamma = read("gamma-index", gamma_index, self.gamma.absorption.as_ref())?;
        let [a, b, c] =
            [&alpha.dispersion, own.0, &gamma.dispersion].map(|dispersion| dispersion.index(lines::D));
        for (key, entry, is_wrong, order) in [
            ("alpha-index", alpha_index, a > b + ROUNDING, "no more than that of [index]"),
            ("gamma-index", gamma_index, c < b - ROUNDING, "no less than that of [index]"),
        ] {
            if is_wrong {
                let expected = format!("an index at the D line {order}, {b:.4}");
                let found = format!("{:.4}", if key == "alpha-index" { a } else { c });
                return Err(file.error(entry.span().start, ValueProblem::new(key, expected, found)));
            }
        }
        Ok(Some(Birefringence::Biaxial { alpha, gamma }))
    }

    /// Refuses tables that do not go together; the byte is where the wrong one begins.
    fn check_company(&self) -> Result<(), (usize, ValueProblem)> {
        let start = |index: &Option<Spanned<IndexEntry>>| index.as_ref().map(|entry| entry.span().start);
        let (extraordinary, alpha, gamma) =
            (start(&self.extraordinary.index), start(&self.alpha.index), start(&self.gamma.index));
        let lonely = |at: usize, key, company: &str| {
            Err((at, ValueProblem::new(key, format!("[{company}] beside it"), "none")))
        };
        match (extraordinary, alpha, gamma) {
            (Some(at), Some(_), _) | (Some(at), _, Some(_)) => {
                let expected = "[index] alone, or [alpha-index] and [gamma-index] beside it";
                return Err((at, ValueProblem::new("extraordinary-index", expected, "both")));
            }
            (None, Some(at), None) => return lonely(at, "alpha-index", "gamma-index"),
            (None, None, Some(at)) => return lonely(at, "gamma-index", "alpha-index"),
            _ => {}
        }
        for (absorption, index, key, company) in [
            (
                &self.extraordinary.absorption,
                extraordinary,
                "extraordinary-absorption",
                "extraordinary-index",
            ),
            (&self.alpha.absorption, alpha, "alpha-absorption", "alpha-index"),
            (&self.gamma.absorption, gamma, "gamma-absorption", "gamma-index"),
        ] {
            if let (Some(entry), None) = (absorption, index) {
                return lonely(entry.span().start, key, company);
            }
        }
        Ok(())
    }
}

/// Refuses two laws that hold nowhere together.
fn check_overlap(key: &'static str, own: (f64, f64), other: (f64, f64)) -> Result<(), ValueProblem> {
    if own.0.max(other.0) < own.1.min(other.1) {
        return Ok(());
    }
    let nm = |(from, to): (f64, f64)| format!("{from:.0} to {to:.0} nm");
    Err(ValueProblem::new(key, format!("wavelengths in common with [index], {}", nm(own)), nm(other)))
}

impl OrientationEntry {
    /// How the axes of `crystal` lie.
    pub fn orientation(&self, crystal: Option<&Birefringence>) -> Result<CrystalOrientation, ValueProblem> {
        const KEY: &str = "c-axis";
        const WORDS: &str = "\"up\", \"across\" or [theta, phi] in degrees";
        let angles = match (crystal, self) {
            (None, _) => {
                let expected = "[extraordinary-index], or [alpha-index] and [gamma-index] beside it";
                return Err(ValueProblem::new(KEY, expected, "none"));
            }
            (_, OrientationEntry::Word(word)) => {
                return CrystalOrientation::by_name(word)
                    .ok_or_else(|| ValueProblem::new(KEY, WORDS, format!("{word:?}")));
            }
            (_, OrientationEntry::Angles(angles)) => angles,
        };
        let is_biaxial = matches!(crystal, Some(Birefringence::Biaxial { .. }));
        let (theta, phi, psi) = match angles[..] {
            [theta, phi] => (theta, phi, 0.0),
            [theta, phi, psi] if is_biaxial => (theta, phi, psi),
            [_, _, _] => {
                return Err(ValueProblem::new(
                    KEY,
                    "[theta, phi] of a crystal with one optic axis",
                    "three angles",
                ));
            }
            _ => {
                return Err(ValueProblem::new(
                    KEY,
                    WORDS,
                    format!("{} angle{}", angles.len(), if angles.len() == 1 { "" } else { "s" }),
                ));
            }
        };
        CrystalOrientation::from_degrees(theta, phi, psi).map_err(|error| {
            let expected = format!("{} from {} to {} degrees", error.angle, error.least, error.most);
            ValueProblem::new(KEY, expected, error.found.to_string())
        })
    }
}
