//! A request for a report, and a stone of it as it is reported on.

use crate::design::Design;
use crate::materials::Material;
use crate::stone::{Stone, StoneError, StoneOptions};
use serde::{Deserialize, Serialize};
use std::ffi::OsStr;

/// A request for reports: everything that they follow from, beside what the stones' files hold.
///
/// ```
/// use cutlab::ReportRequest;
///
/// let request: ReportRequest = serde_json::from_str(r#"{ "stones": ["tolkowsky"] }"#)?;
/// assert_eq!((request.seed, request.polarised, request.options), (1, true, Default::default()));
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ReportRequest {
    /// The stones as they are named: cuts, files, folders, patterns.
    pub stones: Vec<String>,
    /// What they are made of, how large they are and how they stand.
    pub options: StoneOptions,
    /// Whether light keeps its polarisation from facet to facet; if not it counts as unpolarised at each.
    pub polarised: bool,
    /// Seed of the random streams.
    pub seed: u64,
}

impl Default for ReportRequest {
    /// Of no stone, as each is, polarisation followed, seed 1.
    fn default() -> ReportRequest {
        ReportRequest { stones: Vec::new(), options: StoneOptions::default(), polarised: true, seed: 1 }
    }
}

impl ReportRequest {
    /// Opens one of its stones: a convex one, as wide as it is asked for, as it is, or as stones usually are.
    pub fn open(&self, stone: impl AsRef<OsStr>) -> Result<Stone, StoneError> {
        let stone = Stone::open(stone, &self.options)?.with_usual_width()?;
        stone.convex_design()?;
        Ok(stone)
    }
}

/// A stone to report on.
#[derive(Debug, Clone)]
pub struct ReportInput {
    /// The stone as it was asked for: its name in the table of scores.
    pub stone: String,
    /// The design, in millimetres.
    pub design: Design,
    /// What it is made of.
    pub material: Material,
    /// Whether light keeps its polarisation from facet to facet, in scores and pictures.
    pub polarised: bool,
    /// Seed of the random streams.
    pub seed: u64,
    /// The command as typed, for the page.
    pub command: String,
}
