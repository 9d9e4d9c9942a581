//! What to change first: the tier of which half a degree gains most, predicted by its slope and scored.

use super::turns::Turn;
use crate::design::edit::{EditError, Editor};
use crate::geometry::Polyhedron;
use crate::sampling::stats::Estimate;
use crate::scoring::evaluator::Evaluator;
use crate::scoring::tier_effects::TierSlope;
use serde::Serialize;

/// The change by which tiers are compared, in degrees: as much as a faceter tries at a time.
pub const HALF_DEGREE: f64 = 0.5;

/// So many tiers are scored, half a degree turned, until one gains.
const TRIED: usize = 3;

/// The change to make first.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct FirstChange {
    /// The place of the tier.
    pub place: String,
    /// Its name; empty if it has none.
    pub name: String,
    /// By how much it is to be steeper, in degrees; negative for flatter.
    pub degrees: f64,
    /// What this adds to the score by the change per degree alone: a linear prediction.
    pub predicted: Estimate,
    /// What it adds when the changed stone is scored, by fresh random numbers.
    pub scored: Estimate,
    /// Tiers whose angles follow.
    pub followed: Vec<String>,
}

/// The tiers whose slope for an objective is significant, the steepest slope first.
pub(super) fn order(objective: usize, slopes: &[Result<Vec<TierSlope>, String>]) -> Vec<usize> {
    let slope = |tier: usize| slopes[tier].as_ref().ok().and_then(|of| of.get(objective));
    let mut order: Vec<usize> =
        (0..slopes.len()).filter(|tier| slope(*tier).is_some_and(|s| s.is_significant)).collect();
    let size = |tier: &usize| slope(*tier).map_or(0.0, |s| s.per_degree.value.abs());
    order.sort_by(|a, b| size(b).total_cmp(&size(a)));
    order
}

/// A tier that is tried for an objective.
struct Trial {
    objective: usize,
    tier: usize,
    degrees: f64,
    predicted: Estimate,
    solid: Polyhedron,
}

/// For each objective the first of the tiers in its order of which half a degree gains significantly when it is
/// scored: where a score bends within half a degree its slope says nothing of that.
pub(super) fn first_changes(
    evaluator: &Evaluator,
    editor: &Editor,
    turns: &[Result<Turn, EditError>],
    slopes: &[Result<Vec<TierSlope>, String>],
    orders: &[Vec<usize>],
) -> Vec<Option<FirstChange>> {
    let mut firsts: Vec<Option<FirstChange>> = vec![None; orders.len()];
    for round in 0..TRIED {
        let trials: Vec<Trial> = (0..orders.len())
            .filter(|objective| firsts[*objective].is_none())
            .filter_map(|objective| {
                let tier = *orders[objective].get(round)?;
                let slope = slopes[tier].as_ref().ok()?[objective].per_degree;
                let degrees = HALF_DEGREE * evaluator.objectives[objective].aim.sign() * slope.value.signum();
                let predicted = Estimate { value: degrees * slope.value, error: HALF_DEGREE * slope.error };
                let solid = turns[tier].as_ref().ok()?.edited(editor, degrees).ok()?.solid;
                Some(Trial { objective, tier, degrees, predicted, solid })
            })
            .collect();
        for trial in trials {
            // a stone that cannot be scored gains nothing
            let Ok(gains) = evaluator.gains(&editor.solid, std::slice::from_ref(&trial.solid)) else {
                continue;
            };
            let gain = gains[0][trial.objective];
            if !gain.is_significant || gain.gain.value <= 0.0 {
                continue;
            }
            let (tier, sign) =
                (&editor.tiers.tiers[trial.tier], evaluator.objectives[trial.objective].aim.sign());
            let followed =
                turns[trial.tier].as_ref().map_or_else(|_| Vec::new(), |turn| turn.followed.clone());
            firsts[trial.objective] = Some(FirstChange {
                place: tier.place.clone(),
                name: tier.name.clone(),
                degrees: trial.degrees,
                predicted: trial.predicted,
                scored: Estimate { value: sign * gain.gain.value, ..gain.gain },
                followed,
            });
        }
    }
    firsts
}
