//! The attribution on a report's page.

use super::request::ReportInput;
use crate::design::edit::Editor;
use crate::geometry::Polyhedron;
use crate::scoring::effort::Effort;
use crate::scoring::{Attribution, AttributionRequest};

/// Designs of more tiers have none on their page: half a minute of processor time.
const MOST_TIERS: usize = 30;

/// Designs of more tiers have that of `iso` alone, which beams give in an instant; the light return of each turned
/// stone takes tens of milliseconds.
const MOST_TIERS_BY_RAYS: usize = 12;

/// Points of a turned stone: as many as fill the lanes of one packet in each batch of each run. Fewer would take as
/// long.
const POINTS: u64 = 1 << 15;

/// What the tiers of a stone do to `iso` and `wlr`, or why that is left out.
pub(super) fn attributed(request: &ReportInput, solid: &Polyhedron) -> Result<Attribution, String> {
    let tiers = Editor::new(&request.design).map_err(|why| why.to_string())?.tiers.tiers.len();
    if tiers > MOST_TIERS {
        return Err(format!("the design has {tiers} tiers; cutlab attribute turns each of them"));
    }
    let effort = Effort::default().seed(request.seed).polarised(request.polarised).size_mm(solid.width());
    let mut of_tiers = AttributionRequest::default().effort(effort.samples(POINTS));
    if tiers > MOST_TIERS_BY_RAYS {
        of_tiers.objectives.truncate(1);
    }
    let found = of_tiers.of_design(&request.stone, &request.design, &request.material, &());
    found.map_err(|why| why.to_string())
}
