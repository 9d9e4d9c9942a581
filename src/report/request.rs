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
/// assert_eq!(request, ReportRequest::new(["tolkowsky"]).seed(1));
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[non_exhaustive]
pub struct ReportRequest {
    /// The stones as they are named: cuts, files, folders, patterns.
    pub stones: Vec<String>,
    /// What they are made of, how large they are and how they stand.
    pub options: StoneOptions,
    /// Seed of the random streams.
    pub seed: u64,
}

impl Default for ReportRequest {
    /// Of no stone, as each is, seed 1.
    fn default() -> ReportRequest {
        ReportRequest { stones: Vec::new(), options: StoneOptions::default(), seed: 1 }
    }
}

impl ReportRequest {
    /// On these stones, as each is, with seed 1.
    pub fn new<S: Into<String>>(stones: impl IntoIterator<Item = S>) -> ReportRequest {
        ReportRequest { stones: stones.into_iter().map(Into::into).collect(), ..ReportRequest::default() }
    }

    /// With what is asked for of every stone.
    pub fn options(mut self, options: StoneOptions) -> ReportRequest {
        self.options = options;
        self
    }

    /// With a seed of its random streams.
    pub fn seed(mut self, seed: u64) -> ReportRequest {
        self.seed = seed;
        self
    }

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
    /// Seed of the random streams.
    pub seed: u64,
    /// The command as typed, for the page.
    pub command: String,
}
