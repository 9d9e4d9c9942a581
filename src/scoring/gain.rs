//! Gains: finalists of a search against its start, scored again with fresh random numbers.

use super::comparison::{is_significant, negligible_part};
use super::evaluator::Evaluator;
use super::objective::ObjectiveError;
use super::paired_runs::PairedRuns;
use crate::geometry::Polyhedron;
use crate::sampling::stats::Estimate;

/// What a finalist gains in one objective.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Gain {
    /// The objective at the start.
    pub start: Estimate,
    /// The objective of the finalist.
    pub value: Estimate,
    /// By how much the finalist is better: positive where more of it is wanted and there is more, or less is
    /// wanted and there is less. Its error is of the difference, by paired runs.
    pub gain: Estimate,
    /// Whether it is beyond chance and beyond what is negligible, for better or for worse
    /// ([`super::comparison::SIGNIFICANT`]).
    pub is_significant: bool,
}

impl Gain {
    /// `significant` or `not significant`.
    pub fn said(&self) -> &'static str {
        if self.is_significant { "significant" } else { "not significant" }
    }
}

impl Evaluator {
    /// What finalists gain over the start: for each, one [`Gain`] an objective.
    ///
    /// Random numbers are others than those of [`Evaluator::values`], so that a candidate that was chosen
    /// for its luck loses it; start and finalists have the same ones.
    pub fn gains(
        &self,
        start: &Polyhedron,
        finalists: &[Polyhedron],
    ) -> Result<Vec<Vec<Gain>>, ObjectiveError> {
        let each: Vec<Vec<Polyhedron>> = finalists.iter().map(|solid| vec![solid.clone()]).collect();
        self.gains_over(std::slice::from_ref(start), &each)
    }

    /// As [`Evaluator::gains`], of a start and finalists that are each cut as any of several stones
    /// ([`Evaluator::values_over`]).
    pub fn gains_over(
        &self,
        start: &[Polyhedron],
        finalists: &[Vec<Polyhedron>],
    ) -> Result<Vec<Vec<Gain>>, ObjectiveError> {
        let seed = !self.effort().seed;
        let before = self.paired_over(start, seed)?;
        let against = |finalist: &Vec<Polyhedron>| {
            let after = self.paired_over(finalist, seed)?;
            let each = before.iter().zip(&after).zip(&self.objectives);
            let gains = each.map(|((before, after), objective)| {
                let sign = objective.aim.sign();
                let gain = PairedRuns::combined([(sign, after), (-sign, before)]).estimate();
                let metric = objective.of.metric;
                let negligible = metric.scale * negligible_part(before.is_closed() && after.is_closed());
                Gain {
                    start: before.estimate(),
                    value: after.estimate(),
                    gain,
                    is_significant: is_significant(gain, negligible),
                }
            });
            Ok(gains.collect())
        };
        finalists.iter().map(against).collect()
    }
}
