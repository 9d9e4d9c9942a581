//! The attribution on a report's page.

use super::request::ReportInput;
use crate::design::edit::Editor;
use crate::geometry::Polyhedron;
use crate::scoring::effort::Effort;
use crate::scoring::score::Target;
use crate::scoring::settings::DEFAULT_SAMPLES;
use crate::scoring::{Attribution, AttributionRequest};

/// Designs of more tiers have none on their page.
const MOST_TIERS: usize = 40;

/// Points that are traced of all turned stones together, four a tier: about a second of processor time.
const POINTS: u64 = 1 << 20;

/// The fewest points of a turned stone: fewer leave no change significant.
const LEAST_POINTS: u64 = 1 << 12;

/// What the tiers of a stone do to `iso` and `wlr`, or why that is left out.
pub(super) fn attributed(request: &ReportInput, solid: &Polyhedron) -> Result<Attribution, String> {
    let tiers = Editor::new(&request.design).map_err(|why| why.to_string())?.tiers.tiers.len();
    if tiers > MOST_TIERS {
        return Err(format!("of {tiers} tiers each is turned by cutlab attribute, in a minute or more"));
    }
    let samples = match request.target {
        Target::Samples(samples) => samples,
        // as where ± 0.0005 is asked for
        Target::Error(error) => (DEFAULT_SAMPLES as f64 * (5e-4 / error).powi(2)) as u64,
    };
    let samples = samples.min(POINTS / (4 * tiers.max(1)) as u64).max(LEAST_POINTS);
    let effort = Effort::default().seed(request.seed).polarised(request.polarised).size_mm(solid.width());
    let request_of_tiers = AttributionRequest::default().effort(effort.samples(samples));
    let found = request_of_tiers.of_design(&request.stone, &request.design, &request.material, &());
    found.map_err(|why| why.to_string())
}
