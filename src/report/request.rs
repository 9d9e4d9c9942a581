//! A request for a report, and a stone of it as it is reported on.

use crate::batch::input_files::InputFiles;
use crate::design::Design;
use crate::materials::Material;
use crate::scoring::score::Target;
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
    /// Whether light keeps its polarisation from facet to facet; if not it counts as unpolarised at each.
    pub polarised: bool,
    /// Seed of the random streams.
    pub seed: u64,
    /// The standard error at which every score ends, times the metric's scale; none is a number of samples
    /// ([`Target`]).
    pub error: Option<f64>,
    /// Pixels across the picture on the table, at least [`LEAST_WIDTH`]. It is three quarters as high, and so
    /// are the squares of the pictures from above.
    pub width: u32,
}

/// Pixels across the picture on the table unless asked otherwise.
pub const USUAL_WIDTH: u32 = 640;

/// The fewest pixels across the picture on the table: less shows no facets.
pub const LEAST_WIDTH: u32 = 64;

impl Default for ReportRequest {
    /// Of no stone, as each is, polarisation followed, seed 1, scores of as many samples as `score` takes,
    /// [`USUAL_WIDTH`].
    fn default() -> ReportRequest {
        ReportRequest {
            stones: Vec::new(),
            options: StoneOptions::default(),
            polarised: true,
            seed: 1,
            error: None,
            width: USUAL_WIDTH,
        }
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

    /// Whether light keeps its polarisation from facet to facet.
    pub fn polarised(mut self, polarised: bool) -> ReportRequest {
        self.polarised = polarised;
        self
    }

    /// With a standard error at which every score ends, times the metric's scale.
    pub fn error(mut self, error: f64) -> ReportRequest {
        self.error = Some(error);
        self
    }

    /// With so many pixels across the picture on the table.
    pub fn width(mut self, pixels: u32) -> ReportRequest {
        self.width = pixels;
        self
    }

    /// Opens one of its stones: a convex one, as wide as it is asked for, as it is, or as stones usually are.
    pub fn open(&self, stone: impl AsRef<OsStr>) -> Result<Stone, StoneError> {
        Stone::open(stone, &self.options)?.convex_in_mm()
    }

    /// One of its stones, opened, as its pages take it.
    ///
    /// - `command`: as typed, for the page
    pub fn input(&self, stone: &Stone, command: String) -> Result<ReportInput, StoneError> {
        Ok(ReportInput {
            polarised: self.polarised,
            seed: self.seed,
            target: self.error.map_or_else(Target::default, Target::Error),
            width: self.width,
            ..ReportInput::new(stone, command)?
        })
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
    /// Whether light keeps its polarisation from facet to facet, in scores and pictures.
    pub polarised: bool,
    /// Seed of the random streams.
    pub seed: u64,
    /// When its scores end.
    pub target: Target,
    /// Pixels across the picture on the table; it is three quarters as high.
    pub width: u32,
    /// The command as typed, for the page.
    pub command: String,
}

impl ReportInput {
    /// Of a convex stone in millimetres ([`Stone::convex_in_mm`]), with what [`ReportRequest::default`] has.
    pub fn new(stone: &Stone, command: String) -> Result<ReportInput, StoneError> {
        let design = stone.convex_design()?.clone();
        Ok(ReportInput {
            stone: stone.name().into(),
            design,
            material: stone.material().clone(),
            polarised: true,
            seed: 1,
            target: Target::default(),
            width: USUAL_WIDTH,
            command,
        })
    }
}
