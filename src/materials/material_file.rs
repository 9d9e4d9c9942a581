//! Material files: a material as TOML, of the catalogue or of a user. Their grammar is in
//! [`crate::manual::materials`].
//!
//! The reader works on text; whoever calls it says how the tables that a file names are read.

use super::Material;
use super::absorption_entry::AbsorptionEntry;
use super::birefringence::CrystalAxis;
use super::crystal_entry::{AxisEntry, CrystalEntry, OrientationEntry};
use super::crystal_orientation::CrystalOrientation;
use super::index_entry::IndexEntry;
use crate::optics::dispersion::{Dispersion, VISIBLE_NM};
use crate::parse::data_file::{DataFile, DataFileError, ValueProblem};
use crate::parse::table_entry::TableReader;
use serde::Deserialize;
use toml::Spanned;

/// Indices that a material may have: those that `--ri` takes.
const INDICES: std::ops::RangeInclusive<f64> = 1.0..=10.0;

/// Least and greatest mass per volume, g/cm³: osmium has 22.6.
const GRAVITIES: std::ops::RangeInclusive<f64> = 0.01..=30.0;

/// Most letters of a name.
const LONGEST_NAME: usize = 100;

/// A material file as written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct MaterialFile {
    name: String,
    about: Option<String>,
    source: Option<String>,
    specific_gravity: Option<f64>,
    valid_nm: Option<[f64; 2]>,
    c_axis: Option<OrientationEntry>,
    index: Spanned<IndexEntry>,
    extraordinary_index: Option<Spanned<IndexEntry>>,
    alpha_index: Option<Spanned<IndexEntry>>,
    gamma_index: Option<Spanned<IndexEntry>>,
    absorption: Option<Spanned<AbsorptionEntry>>,
    extraordinary_absorption: Option<Spanned<AbsorptionEntry>>,
    alpha_absorption: Option<Spanned<AbsorptionEntry>>,
    gamma_absorption: Option<Spanned<AbsorptionEntry>>,
}

impl Material {
    /// The material that a TOML text describes.
    ///
    /// - `file`: how messages name the text; `tables`: reads the tables that it names
    pub fn parse(file: &str, text: &str, tables: TableReader) -> Result<Material, DataFileError> {
        let file = DataFile { name: file, text };
        let document: MaterialFile = file.document()?;
        document.check().map_err(|problem| file.error(0, problem))?;
        let index = |entry: &Spanned<IndexEntry>| {
            let law = entry.get_ref().dispersion(tables).and_then(|(law, key)| checked(law, key));
            law.map_err(|problem| file.error(entry.span().start, problem))
        };
        let absorption = |entry: &Spanned<AbsorptionEntry>, law: &Dispersion| {
            let absorption = entry.get_ref().absorption(law, tables);
            absorption.map_err(|problem| file.error(entry.span().start, problem))
        };
        let dispersion = index(&document.index)?;
        let own_absorption =
            document.absorption.as_ref().map(|entry| absorption(entry, &dispersion)).transpose()?;
        let range_nm = document.index.get_ref().range_nm(&dispersion);
        let axis = |entry: &Spanned<IndexEntry>, absorbs: Option<&Spanned<AbsorptionEntry>>| {
            let law = index(entry)?;
            let absorption = absorbs.map(|entry| absorption(entry, &law)).transpose()?;
            Ok(CrystalAxis { dispersion: law, absorption })
        };
        let MaterialFile { name, about, source, specific_gravity, valid_nm, c_axis, .. } = document;
        let crystal = CrystalEntry {
            extraordinary: AxisEntry {
                index: document.extraordinary_index,
                absorption: document.extraordinary_absorption,
            },
            alpha: AxisEntry { index: document.alpha_index, absorption: document.alpha_absorption },
            gamma: AxisEntry { index: document.gamma_index, absorption: document.gamma_absorption },
        };
        let crystal = crystal.crystal((&dispersion, range_nm), &file, &axis)?;
        let orientation = match c_axis {
            Some(entry) => entry.orientation(crystal.as_ref()).map_err(|problem| file.error(0, problem))?,
            None => CrystalOrientation::default(),
        };
        Ok(Material {
            about: about.unwrap_or_else(|| name.clone()).into(),
            source: source.unwrap_or_else(|| "not stated".into()).into(),
            name: name.into(),
            valid_nm: valid_nm.map_or(range_nm, Into::into),
            dispersion,
            crystal,
            orientation,
            specific_gravity,
            absorption: own_absorption,
            file: None,
        })
    }
}

impl MaterialFile {
    /// Refuses values at the top of the document that cannot be.
    fn check(&self) -> Result<(), ValueProblem> {
        // names become parts of file names
        let fits = |c: char| c.is_alphanumeric() || " -_.,+()'".contains(c);
        let letters = self.name.chars().count();
        if !(1..=LONGEST_NAME).contains(&letters)
            || self.name.trim() != self.name
            || !self.name.chars().all(fits)
        {
            let expected = format!("up to {LONGEST_NAME} letters, digits, blanks and any of - _ . , + ( ) '");
            return Err(ValueProblem::new("name", expected, format!("{:?}", self.name)));
        }
        for (key, text) in [("about", &self.about), ("source", &self.source)] {
            if text.as_ref().is_some_and(|text| text.chars().any(char::is_control)) {
                return Err(ValueProblem::new(
                    key,
                    "one line of text",
                    "several lines or control characters",
                ));
            }
        }
        if let Some(sg) = self.specific_gravity.filter(|sg| !GRAVITIES.contains(sg)) {
            let expected = format!("g/cm³ from {} to {}", GRAVITIES.start(), GRAVITIES.end());
            return Err(ValueProblem::new("specific-gravity", expected, sg.to_string()));
        }
        match self.valid_nm {
            Some([from, to]) if !(from > 0.0 && from < to) => {
                Err(ValueProblem::new("valid-nm", "[from, to] in nm, rising", format!("[{from}, {to}]")))
            }
            _ => Ok(()),
        }
    }
}

/// The law, if it gives an index that a material can have at every nanometre of a picture.
fn checked(law: Dispersion, key: &'static str) -> Result<Dispersion, ValueProblem> {
    let (from, to) = VISIBLE_NM;
    let nodes = std::iter::successors(Some(from), |nm| Some(nm + 1.0)).take_while(|nm| *nm <= to);
    let mut indices = nodes.map(|nm| (nm, law.index(nm)));
    match indices.find(|(_, n)| !INDICES.contains(n)) {
        None => Ok(law),
        Some((nm, n)) => {
            let expected =
                format!("an index from {} to {} at {from} to {to} nm", INDICES.start(), INDICES.end());
            Err(ValueProblem::new(key, expected, format!("{n} at {nm} nm")))
        }
    }
}
