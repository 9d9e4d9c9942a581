//! Turns of single tiers: what is kept, and which other tiers follow.

use crate::design::edit::{EditError, EditTarget, EditableTier, Edited, Editor, Keep, Setting};
use crate::geometry::Polyhedron;
use crate::scoring::tier_effects::STEP_DEG;

/// Angles that differ by less, in radians, are the same: far above rounding, far below what a tier follows by.
const SAME_ANGLE: f64 = 1e-6;

/// How a tier is turned.
#[derive(Debug, Clone)]
pub(super) struct Turn {
    place: String,
    /// What is kept.
    pub keep: Keep,
    /// The places of tiers whose angles follow, whichever way it is turned.
    pub followed: Vec<String>,
}

impl Turn {
    /// The design with the tier steeper by some degrees.
    pub fn edited(&self, editor: &Editor, degrees: f64) -> Result<Edited, EditError> {
        let target = EditTarget::Angle(self.place.clone());
        editor.edit(&[Setting { target, is_added: true, value: degrees }], self.keep)
    }
}

/// How each tier is turned, or why it cannot be.
///
/// - `keep`: none keeps the other angles, and where that cannot be lets them follow
pub(super) fn of_tiers(editor: &Editor, keep: Option<Keep>) -> Vec<Result<Turn, EditError>> {
    let tried = keep.map_or_else(|| vec![Keep::Angles, Keep::Meets], |keep| vec![keep]);
    let turn = |place: &str, keep: Keep| -> Result<Turn, EditError> {
        let mut turn = Turn { place: place.into(), keep, followed: Vec::new() };
        for degrees in [STEP_DEG, -STEP_DEG] {
            let edited = turn.edited(editor, degrees)?;
            for tier in editor.tiers.tiers.iter().filter(|tier| tier.place != place) {
                if !turn.followed.contains(&tier.place) && is_turned(tier, &editor.solid, &edited.solid) {
                    turn.followed.push(tier.place.clone());
                }
            }
        }
        Ok(turn)
    };
    let of = |place: &str| {
        let (last, others) = tried.split_last().unwrap_or((&Keep::Meets, &[]));
        others.iter().find_map(|keep| turn(place, *keep).ok()).map_or_else(|| turn(place, *last), Ok)
    };
    editor.tiers.tiers.iter().map(|tier| of(&tier.place)).collect()
}

/// Whether a facet of a tier has another angle than it had.
fn is_turned(tier: &EditableTier, was: &Polyhedron, is: &Polyhedron) -> bool {
    let angle = |solid: &Polyhedron, facet: &usize| {
        let face = solid.faces.iter().position(|face| face.plane == *facet)?;
        let normal = solid.area_vector(face);
        Some(normal.truncate().length().atan2(normal.z))
    };
    let differs = |facet: &usize| Some((angle(was, facet)? - angle(is, facet)?).abs() > SAME_ANGLE);
    tier.facets.iter().any(|facet| differs(facet).unwrap_or_default())
}
