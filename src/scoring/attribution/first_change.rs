//! What to change first: the tier of which half a degree gains most, predicted by its slope, and scored.

use super::turns::Turn;
use crate::design::edit::{EditError, Editor};
use crate::geometry::Polyhedron;
use crate::sampling::stats::Estimate;
use crate::scoring::evaluator::Evaluator;
use crate::scoring::gain::Gain;
use crate::scoring::tier_effects::TierSlope;
use serde::Serialize;

/// The change by which tiers are compared, in degrees: as much as a faceter tries at a time.
pub const HALF_DEGREE: f64 = 0.5;

/// So many tiers are scored half a degree turned: those of the greatest slopes.
const TRIED: usize = 3;

/// A slope that is not significant is tried where at most this part of its error is noise: the rest is a score that
/// bends or jumps, of which half a degree may gain much.
const OF_NOISE: f64 = 0.5;

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
    /// The places of tiers whose angles follow.
    pub followed: Vec<String>,
}

/// The tiers that can be turned, the greatest slope for an objective first.
pub(super) fn order(objective: usize, slopes: &[Result<Vec<TierSlope>, String>]) -> Vec<usize> {
    let slope = |tier: usize| slopes[tier].as_ref().ok().and_then(|of| of.get(objective));
    let mut order: Vec<usize> = (0..slopes.len()).filter(|tier| slope(*tier).is_some()).collect();
    let size = |tier: &usize| slope(*tier).map_or(0.0, |s| s.per_degree.value.abs());
    order.sort_by(|a, b| size(b).total_cmp(&size(a)));
    order
}

/// A tier turned half a degree.
struct Trial {
    tier: usize,
    degrees: f64,
    solid: Polyhedron,
    /// One an objective; none of a stone that cannot be scored.
    gains: Option<Vec<Gain>>,
}

/// For each objective, of the first tiers in its order the one of which half a degree gains most when it is scored;
/// none if none gains significantly. A slope alone does not say that: scores bend and jump within half a degree.
pub(super) fn first_changes(
    evaluator: &Evaluator,
    editor: &Editor,
    turns: &[Result<Turn, EditError>],
    slopes: &[Result<Vec<TierSlope>, String>],
    orders: &[Vec<usize>],
) -> Vec<Option<FirstChange>> {
    let slope = |tier: usize, objective: usize| Some(slopes[tier].as_ref().ok()?.get(objective)?.per_degree);
    let better_way = |tier: usize, objective: usize| {
        let sign = evaluator.objectives[objective].aim.sign();
        Some(HALF_DEGREE * sign * slope(tier, objective)?.value.signum())
    };
    let tried = |objective: usize| {
        let says_something = move |tier: &&usize| {
            let slope = slopes[**tier].as_ref().ok().and_then(|of| of.get(objective));
            slope.is_some_and(|s| s.is_significant || s.noise <= OF_NOISE * s.per_degree.error)
        };
        orders[objective].iter().filter(says_something).take(TRIED)
    };
    let mut trials: Vec<Trial> = Vec::new();
    for objective in 0..orders.len() {
        for &tier in tried(objective) {
            let Some(degrees) = better_way(tier, objective) else { continue };
            let is_known = trials.iter().any(|trial| trial.tier == tier && trial.degrees == degrees);
            let edited = turns[tier].as_ref().ok().and_then(|turn| turn.edited(editor, degrees).ok());
            if let Some(edited) = edited.filter(|_| !is_known) {
                trials.push(Trial { tier, degrees, solid: edited.solid, gains: None });
            }
        }
    }
    let solids: Vec<Polyhedron> = trials.iter().map(|trial| trial.solid.clone()).collect();
    match evaluator.gains(&editor.solid, &solids) {
        Ok(gains) => trials.iter_mut().zip(gains).for_each(|(trial, gains)| trial.gains = Some(gains)),
        // one of them cannot be scored
        Err(_) => trials.iter_mut().for_each(|trial| {
            let gains = evaluator.gains(&editor.solid, std::slice::from_ref(&trial.solid));
            trial.gains = gains.ok().and_then(|mut gains| gains.pop());
        }),
    }
    let first = |objective: usize| {
        let of_order = |trial: &&Trial| {
            let is_asked = tried(objective).any(|tier| *tier == trial.tier);
            is_asked && better_way(trial.tier, objective) == Some(trial.degrees)
        };
        let gain = |trial: &Trial| trial.gains.as_ref().and_then(|gains| gains.get(objective).copied());
        let gaining = trials.iter().filter(of_order).filter_map(|trial| Some((gain(trial)?, trial)));
        let gaining = gaining.filter(|(gain, _)| gain.is_significant && gain.gain.value > 0.0);
        let (gain, trial) = gaining.max_by(|(a, _), (b, _)| a.gain.value.total_cmp(&b.gain.value))?;
        let (tier, slope) = (&editor.tiers.tiers[trial.tier], slope(trial.tier, objective)?);
        let sign = evaluator.objectives[objective].aim.sign();
        Some(FirstChange {
            place: tier.place.clone(),
            name: tier.name.clone(),
            degrees: trial.degrees,
            predicted: Estimate { value: trial.degrees * slope.value, error: HALF_DEGREE * slope.error },
            scored: Estimate { value: sign * gain.gain.value, ..gain.gain },
            followed: turns[trial.tier].as_ref().map_or_else(|_| Vec::new(), |turn| turn.followed.clone()),
        })
    };
    (0..orders.len()).map(first).collect()
}
