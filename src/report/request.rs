//! A request for a report, and a stone of it as it is reported on.

use crate::batch::input_files::InputFiles;
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
/// assert_eq!((request.seed, request.options), (1, Default::default()));
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
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
    /// Opens one of its stones: a convex one, as wide as it is asked for, as it is, or as stones usually are.
    pub fn open(&self, stone: impl AsRef<OsStr>) -> Result<Stone, StoneError> {
        Stone::open(stone, &self.options)?.convex_in_mm()
    }

    /// Fingerprint of the request and of what the files hold that it names: stones, and materials of one's own.
    ///
    /// - `stones`: those of the request, one by one ([`crate::batch::stone_files::expand_stones`])
    pub fn identity<S: AsRef<OsStr>>(&self, stones: &[S]) -> String {
        InputFiles::new(self, &self.options, stones.iter().map(AsRef::as_ref)).identity
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

impl ReportInput {
    /// Of a convex stone in millimetres ([`Stone::convex_in_mm`]).
    pub fn new(stone: &Stone, seed: u64, command: String) -> Result<ReportInput, StoneError> {
        let design = stone.convex_design()?.clone();
        Ok(ReportInput {
            stone: stone.name().into(),
            design,
            material: stone.material().clone(),
            seed,
            command,
        })
    }
}
