//! A request for a report.

use crate::design::Design;
use crate::materials::Material;

/// What to report on.
#[derive(Debug, Clone)]
pub struct ReportRequest {
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
