//! What `cutlab show` knows of each file, good or bad.

use super::mesh::MeshSheet;
use super::options::ShowArgs;
use super::stone_sheet::StoneSheet;
use crate::cli::error::CliError;
use crate::cli::weight;
use crate::design::edit::Editor;
use crate::design::edit::meets::MeetReport;
use crate::formats::MeshFacts;
use crate::materials::weight::Weight;
use serde::Serialize;
use std::ffi::OsStr;

/// What is shown of a file.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum Shown {
    Stone(Box<StoneSheet>),
    Mesh(MeshSheet),
}

/// A file that holds no stone, as JSON.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum BadStone {
    /// Understood, but open.
    NoStone {
        file: String,
        format: &'static str,
        facets: Option<usize>,
        closed: bool,
        convex: Option<bool>,
        volume: Option<f64>,
        reason: String,
    },
    Error {
        file: String,
        error: String,
    },
}

impl BadStone {
    fn new(file: &str, failure: &CliError) -> BadStone {
        let (file, why) = (file.to_string(), failure.message());
        match failure.mesh() {
            Some(MeshFacts { format, facets, closed, convex }) => {
                BadStone::NoStone { file, format, facets, closed, convex, volume: None, reason: why }
            }
            None => BadStone::Error { file, error: why },
        }
    }
}

/// A file with what is known of it, as JSON.
#[derive(Serialize)]
#[serde(untagged)]
pub enum ShownEntry<'a> {
    Good(&'a Shown),
    Bad(BadStone),
}

impl<'a> ShownEntry<'a> {
    /// Of a file.
    pub fn new(file: &str, result: &'a Result<Shown, CliError>) -> ShownEntry<'a> {
        match result {
            Ok(sheet) => ShownEntry::Good(sheet),
            Err(failure) => ShownEntry::Bad(BadStone::new(file, failure)),
        }
    }
}

impl Shown {
    /// What the STONE `spec` is, as it is asked for.
    pub fn new(spec: &OsStr, args: &ShowArgs) -> Result<Shown, CliError> {
        let stone = args.stone_args.open(spec)?;
        let (Some(design), Some(solid)) = (stone.design(), stone.solid()) else {
            let mesh = MeshSheet::new(&stone).map(Shown::Mesh);
            return mesh.ok_or_else(|| CliError::input("neither solid nor mesh"));
        };
        let size = match args.carat {
            Some(carats) => Some(weight::width_mm(&Weight::new(stone.material()), design, carats)?),
            None => args.size,
        };
        let mut sheet = StoneSheet::new(&stone, design, solid, size);
        if args.meets {
            sheet.meets = Some(MeetReport::new(&Editor::new(design)?));
        }
        Ok(Shown::Stone(Box::new(sheet)))
    }

    /// Lines for people.
    pub fn text(&self) -> String {
        match self {
            Shown::Stone(sheet) => sheet.text(),
            Shown::Mesh(mesh) => mesh.text(),
        }
    }
}
