//! Tier effects: what a degree more of a tier's angle does to each objective, and the light that is lost through
//! its facets.

use super::comparison::{is_significant, negligible_part};
use super::evaluator::Evaluator;
use super::objective::ObjectiveError;
use super::paired_runs::PairedRuns;
use crate::estimators::facet_leakage::{FacetLeakage, facet_leakage};
use crate::estimators::{TraceOptics, ViewFrame};
use crate::geometry::Polyhedron;
use crate::materials::Material;
use crate::parallel;
use crate::sampling::stats::Estimate;
use crate::trace::ConvexStone;

/// Degrees by which a tier is turned to both sides: small against the angles over which scores bend, large
/// against the noise that is left of differences.
pub const STEP_DEG: f64 = 0.25;

/// The change of an objective with the angle of a tier.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct TierSlope {
    /// The change per degree, in the metric's unit. Its error is that of the random numbers and of the step.
    pub per_degree: Estimate,
    /// The part of that error which more samples make smaller.
    pub noise: f64,
    /// Whether there is a change over the step by which it was measured: beyond chance, and beyond what is
    /// negligible ([`super::comparison::SIGNIFICANT`]).
    pub is_significant: bool,
}

/// What a tier does.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct TierEffect {
    /// One an objective; or why the tier cannot be turned or the turned stone not be scored.
    pub slopes: Result<Vec<TierSlope>, String>,
    /// The share of what one sees face-up that comes from below through facets of the tier.
    pub leakage: Estimate,
}

impl Evaluator {
    /// What each tier of a design does.
    ///
    /// - `tiers`: for each, the numbers of its faces in the stone as it is
    /// - `turned`: the design with a tier's angle more by some degrees, or why there is none
    /// - `leakage`: of the stone as it is ([`Evaluator::leakage`])
    ///
    /// Changes are central differences over ± [`STEP_DEG`] and half of that. Beside the noise their errors
    /// hold what the step leaves out: 4/3 of what halving it changes, as for any function with a third
    /// derivative; of the square of that change its noise is taken off. All stones have the same random numbers.
    pub fn tier_effects<E: ToString>(
        &self,
        tiers: &[Vec<usize>],
        turned: impl Fn(usize, f64) -> Result<Polyhedron, E> + Sync + Send,
        leakage: &FacetLeakage,
    ) -> Vec<TierEffect> {
        let effect = |tier: usize| {
            let at = |degrees: f64| {
                let solid = turned(tier, degrees).map_err(|why| why.to_string())?;
                self.paired(&solid, self.effort().seed).map_err(|why| why.to_string())
            };
            let slopes = slopes(at, STEP_DEG).map(|slopes| {
                let scaled = slopes.into_iter().zip(&self.objectives);
                scaled.map(|(slope, objective)| slope.judged(objective.of.metric.scale)).collect()
            });
            TierEffect { slopes, leakage: leakage.through(tiers[tier].iter().copied()) }
        };
        parallel::map(tiers.len(), effect)
    }

    /// The leakage of a face-up stone, face by face.
    ///
    /// - `material`: what it is made of, whatever the objectives are of
    pub fn leakage(&self, base: &Polyhedron, material: &Material) -> Result<FacetLeakage, ObjectiveError> {
        let stone = ConvexStone::new(self.sized(base, material));
        let optics = TraceOptics { material, polarised: self.effort().polarised };
        let (seed, samples) = (self.effort().seed, self.effort().samples);
        let lost = facet_leakage(&stone, &optics, ViewFrame::FACE_UP, seed, samples);
        lost.map_err(|why| ObjectiveError::NotMeasured { quantity: "leakage".into(), why: why.to_string() })
    }
}

/// A change per degree of a quantity.
#[derive(Debug, PartialEq)]
struct Slope {
    per_degree: Estimate,
    noise: f64,
    is_closed: bool,
}

impl Slope {
    /// With a word on whether it is significant.
    ///
    /// - `scale`: of the metric
    fn judged(self, scale: f64) -> TierSlope {
        let Slope { per_degree, noise, is_closed } = self;
        let over_step = 2.0 * STEP_DEG;
        let change = Estimate { value: per_degree.value * over_step, error: per_degree.error * over_step };
        let is_significant = is_significant(change, scale * negligible_part(is_closed));
        TierSlope { per_degree, noise, is_significant }
    }
}

/// Changes per degree of several quantities at 0°.
///
/// - `at`: the quantities at some degrees
fn slopes(at: impl Fn(f64) -> Result<Vec<PairedRuns>, String>, step: f64) -> Result<Vec<Slope>, String> {
    let slope = |step: f64| -> Result<Vec<PairedRuns>, String> {
        let (more, less) = (at(step)?, at(-step)?);
        let weight = 0.5 / step;
        let pairs = more.iter().zip(&less);
        Ok(pairs.map(|(more, less)| PairedRuns::combined([(weight, more), (-weight, less)])).collect())
    };
    let (whole, half) = (slope(step)?, slope(0.5 * step)?);
    let found = whole.iter().zip(&half).map(|(whole, half)| {
        let halving = PairedRuns::combined([(1.0, whole), (-1.0, half)]).estimate();
        let bend = (halving.value.powi(2) - halving.error.powi(2)).max(0.0).sqrt();
        let found = whole.estimate();
        let per_degree = Estimate { error: found.error.hypot(bend * 4.0 / 3.0), ..found };
        let noise = if whole.is_closed() { 0.0 } else { found.error };
        Slope { per_degree, noise, is_closed: whole.is_closed() }
    });
    Ok(found.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_within_their_errors_where_functions_bend() {
        let at = |degrees: f64| {
            let x = degrees;
            let values = [3.0 * x, x * x, 2.0 * x + 5.0 * x.powi(3), (3.0 * x).sin()];
            Ok(values.map(|value| PairedRuns::new(vec![value], 0.0)).to_vec())
        };
        let found = slopes(at, 0.25).expect("all have values");
        for (found, truth) in found.iter().map(|f| f.per_degree).zip([3.0, 0.0, 2.0, 3.0]) {
            assert!((found.value - truth).abs() <= 1.05 * found.error + 1e-12, "{found:?} {truth}");
            assert!(found.error < 0.5, "{found:?}");
        }
        let fails = |degrees: f64| if degrees < 0.0 { Err("no stone".to_owned()) } else { Ok(Vec::new()) };
        assert_eq!(slopes(fails, 0.25), Err("no stone".into()));
    }
}
