//! A surrogate model: the objectives and the violation that are expected at a point, from what was evaluated.

use super::proposer::distance;
use super::radial_basis::RadialBasis;
use crate::search::problem::Outcome;

/// A point that was evaluated.
#[derive(Debug, Clone)]
pub struct Sample {
    /// In the unit cube.
    pub point: Vec<f64>,
    /// What was found there.
    pub outcome: Outcome,
}

/// The most samples of a model: the time to make it grows with their third power.
const MOST_SAMPLES: usize = 400;

/// Samples nearer than this to another of the model are left out: they say nothing more.
const NEAREST: f64 = 1e-5;

/// The expected violation that is taken for none, as a share of the largest: a function that is level where
/// no constraint is broken is never met exactly there.
const TOLERANCE: f64 = 1e-3;

/// Objectives and violation as smooth functions.
pub struct SurrogateModel {
    functions: RadialBasis,
    /// Whether the last function is the violation.
    has_violation: bool,
}

impl SurrogateModel {
    /// The model of samples; none, if they do not determine one.
    ///
    /// - `order`: numbers of samples, those that matter most first
    /// - `levelled`: the share of an objective's values below which the model takes them all for the same. Of one
    ///   objective nobody wants the lowest, and a cliff there would make waves elsewhere; of several the least of one
    ///   may be the best of another
    pub fn fit(samples: &[Sample], order: &[usize], levelled: f64) -> Option<SurrogateModel> {
        let mut chosen: Vec<&Sample> = Vec::new();
        for sample in order.iter().filter_map(|&number| samples.get(number)) {
            if chosen.iter().all(|other| distance(&other.point, &sample.point) > NEAREST) {
                chosen.push(sample);
            }
            if chosen.len() == MOST_SAMPLES {
                break;
            }
        }
        let valued = || chosen.iter().map(|sample| &sample.outcome).filter(|o| o.violation.is_finite());
        let objectives = valued().next()?.objectives.len();
        let floors: Vec<f64> = (0..objectives)
            .map(|j| floor(valued().filter_map(|o| o.objectives.get(j).copied()), levelled))
            .collect();
        let largest = valued().map(|outcome| outcome.violation).fold(0.0, f64::max);
        let has_violation = chosen.iter().any(|sample| !sample.outcome.is_feasible());
        let unit = if largest > 0.0 { largest } else { 1.0 };
        // where there is nothing, objectives and violation are as bad as the model knows
        let values = |sample: &&Sample| -> Vec<f64> {
            let found = sample.outcome.objectives.iter().copied().chain(std::iter::repeat(f64::NEG_INFINITY));
            let objectives = found.zip(&floors).map(|(value, floor)| value.max(*floor));
            objectives.chain(has_violation.then_some(sample.outcome.violation.min(unit) / unit)).collect()
        };
        let values: Vec<Vec<f64>> = chosen.iter().map(values).collect();
        let points = chosen.iter().map(|sample| sample.point.clone()).collect();
        Some(SurrogateModel { functions: RadialBasis::fit(points, &values)?, has_violation })
    }

    /// The outcome that is expected at a point; its violation is a share of the largest.
    pub fn predict(&self, point: &[f64]) -> Outcome {
        let mut objectives = self.functions.at(point);
        let violation = if self.has_violation { objectives.pop().unwrap_or(0.0) } else { 0.0 };
        Outcome { objectives, violation: if violation <= TOLERANCE { 0.0 } else { violation } }
    }
}

/// The value below which a share of the values lies.
fn floor(values: impl Iterator<Item = f64>, share: f64) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.get((values.len() as f64 * share) as usize).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::methods::random::point;

    /// Left of a half there is nothing, left of 0.7 a constraint is broken.
    fn sample(point: Vec<f64>) -> Sample {
        let x = point[0];
        let outcome = match x {
            x if x < 0.5 => Outcome::nothing(),
            x => Outcome { objectives: vec![x, point[1]], violation: (0.7 - x).max(0.0) },
        };
        Sample { point, outcome }
    }

    #[test]
    fn a_model_expects_what_constraints_forbid() {
        let samples: Vec<Sample> = (0..80).map(|i| sample(point(2, 3, i))).collect();
        let order: Vec<usize> = (0..samples.len()).collect();
        let model = SurrogateModel::fit(&samples, &order, 0.0).expect("80 samples determine one");
        assert!(model.predict(&[0.1, 0.5]).violation > 0.5);
        assert!(model.predict(&[0.55, 0.5]).violation > 0.2);
        let good = model.predict(&[0.9, 0.6]);
        assert!(good.is_feasible() && (good.objectives[0] - 0.9).abs() < 0.05, "{good:?}");
    }

    #[test]
    fn nothing_anywhere_is_no_model() {
        let nothing = |i| Sample { point: point(2, 3, i), outcome: Outcome::nothing() };
        let samples: Vec<Sample> = (0..20).map(nothing).collect();
        assert!(SurrogateModel::fit(&samples, &[0, 1, 2, 3, 4, 5], 0.0).is_none());
        assert!(SurrogateModel::fit(&[], &[], 0.0).is_none());
    }
}
