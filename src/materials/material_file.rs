//! Material files: a material as TOML, of the catalogue or of a user. Their grammar is in
//! [`crate::manual::materials`].
//!
//! The reader works on text; whoever calls it says how the tables that a file names are read.

use super::Material;
use super::absorption_entry::AbsorptionEntry;
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
    index: Spanned<IndexEntry>,
    extraordinary_index: Option<Spanned<IndexEntry>>,
    absorption: Option<Spanned<AbsorptionEntry>>,
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
        let dispersion = index(&document.index)?;
        let extraordinary = document.extraordinary_index.as_ref().map(index).transpose()?;
        let absorption = document.absorption.as_ref().map(|entry| {
            let absorption = entry.get_ref().absorption(&dispersion, tables);
            absorption.map_err(|problem| file.error(entry.span().start, problem))
        });
        let MaterialFile { name, about, source, specific_gravity, .. } = document;
        Ok(Material {
            about: about.unwrap_or_else(|| name.clone()).into(),
            source: source.unwrap_or_else(|| "not stated".into()).into(),
            name: name.into(),
            valid_nm: document
                .valid_nm
                .map_or_else(|| document.index.get_ref().range_nm(&dispersion), Into::into),
            dispersion,
            extraordinary,
            specific_gravity,
            absorption: absorption.transpose()?,
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
