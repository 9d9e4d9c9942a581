//! The attribution on a report's page.

use super::request::ReportInput;
use crate::design::edit::Editor;
use crate::geometry::Polyhedron;
use crate::scoring::effort::Effort;
use crate::scoring::score::Target;
use crate::scoring::{Attribution, AttributionRequest};

/// Designs of more tiers have none on their page.
const MOST_TIERS: usize = 40;

/// What the tiers of a stone do to `iso` and `wlr`, or why that is left out. The half degree that is predicted has
/// about the noise of the scores on the page.
pub(super) fn attributed(request: &ReportInput, solid: &Polyhedron) -> Result<Attribution, String> {
    let tiers = Editor::new(&request.design).map_err(|why| why.to_string())?.tiers.tiers.len();
    if tiers > MOST_TIERS {
        return Err(format!("of {tiers} tiers each is turned by cutlab attribute, in a minute or more"));
    }
    let effort = Effort::default().seed(request.seed).polarised(request.polarised).size_mm(solid.width());
    let request_of_tiers = match request.target {
        Target::Samples(samples) => AttributionRequest::default().effort(effort.samples(samples / 2)),
        Target::Error(error) => AttributionRequest::default().effort(effort).error(2.0 * error),
    };
    let found = request_of_tiers.of_design(&request.stone, &request.design, &request.material, &());
    found.map_err(|why| why.to_string())
}
