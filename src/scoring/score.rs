//! Scores of stones: which estimators to run, how long, and one row a stone.

use super::adaptive::ScoreAccumulator;
pub use super::settings::{
    DEFAULT_SAMPLES, MAX_SAMPLES, ScoreInput, ScoreRequest, ScoreRow, StoneShape, Target, Tilt,
};
use crate::estimators::catalogue::CataloguedEstimator;
use crate::estimators::{ESTIMATORS, EstimatorError, STOP_POWER, Setup, TraceOptics, ViewFrame};
use crate::metrics::{Metric, MetricSource};
use crate::sampling::stats::Estimate;
use crate::trace::ConvexStone;
use crate::trace::nonconvex::MeshStone;

/// Why scores that look at single rays are left out.
const NONCONVEX: &str = "not known for stones that are not convex";

/// Why scores that compare with the Tolkowsky stone are left out.
const NO_OUTLINE: &str = "the stone has no outline to compare";

/// Scores one stone.
///
/// The result is a pure function of subject and plan: the number of threads shows in no bit.
/// Never fails; a stone that cannot be scored says so in [`ScoreRow::error`].
/// Checked against published and reference figures in `tests/library/scores.rs`.
pub fn score(subject: &ScoreInput, plan: &ScoreRequest) -> ScoreRow {
    let mut row = ScoreRow {
        stone: subject.stone.clone(),
        material: subject.material.name.to_string(),
        facets: None,
        scores: vec![None; plan.metrics.len()],
        samples: Vec::new(),
        note: None,
        error: None,
        left_out: Vec::new(),
    };
    let filled = match &subject.shape {
        Ok(StoneShape::Convex(solid)) => {
            let stone = ConvexStone::new(solid.clone());
            row.facets = Some(stone.facet_count());
            fill(&mut row, &stone, subject, plan).map_err(|e| e.to_string())
        }
        Ok(StoneShape::Nonconvex(_)) if !plan.metrics.iter().any(|m| m.nonconvex) => {
            Err("not convex: it has none of the scores asked for (cutlab list metrics tells which it has)"
                .into())
        }
        Ok(StoneShape::Nonconvex(body)) => {
            row.facets = Some(body.facets.len());
            MeshStone::new(&body.mesh())
                .map_err(|e| e.to_string())
                .and_then(|stone| fill_nonconvex(&mut row, &stone, subject, plan).map_err(|e| e.to_string()))
        }
        Err(why) => Err(why.clone()),
    };
    if let Err(why) = filled {
        row.error = Some(why);
    }
    row
}

/// Scores stones one after the other, each on all threads.
pub fn score_all(subjects: &[ScoreInput], plan: &ScoreRequest) -> Vec<ScoreRow> {
    subjects.iter().map(|s| score(s, plan)).collect()
}

/// The estimators whose sums a plan's metrics read: in the order of the catalogue, then those of metrics that
/// no catalogue has.
fn estimators(plan: &ScoreRequest) -> Vec<CataloguedEstimator> {
    let reads = |e: &&CataloguedEstimator| plan.metrics.iter().any(|m| m.is_of(e.kind));
    let mut needed: Vec<CataloguedEstimator> = ESTIMATORS.iter().filter(reads).copied().collect();
    for metric in &plan.metrics {
        if !needed.iter().any(|e| metric.is_of(e.kind)) {
            needed.push(CataloguedEstimator::new(metric.estimator));
        }
    }
    needed
}

fn fill(
    row: &mut ScoreRow,
    stone: &ConvexStone,
    subject: &ScoreInput,
    plan: &ScoreRequest,
) -> Result<(), EstimatorError> {
    let setup = subject.setup(plan);
    for (column, metric) in plan.metrics.iter().enumerate() {
        if let MetricSource::Solid(of) = metric.read_from {
            row.scores[column] = of(&stone.solid).map(Estimate::exact);
            if row.scores[column].is_none() {
                row.leave_out(metric, NO_OUTLINE);
            }
        }
    }
    let (clear, dispersive) = (subject.material.is_clear(), subject.material.is_dispersive());
    let exact = plan.exact && clear;
    let mut sheet = ScoreAccumulator { row, plan, exact, convex: Some(stone), unfinished: false };
    let estimators = estimators(plan);
    let asked = |e: &CataloguedEstimator| -> Vec<&Metric> {
        plan.metrics.iter().copied().filter(|m| m.is_of(e.kind)).collect()
    };
    let (fit, unfit): (Vec<_>, Vec<_>) =
        estimators.into_iter().partition(|e| dispersive || !e.kind.needs_dispersion());
    for estimator in &fit {
        let methods = match estimator.in_clear_stones.filter(|_| clear) {
            Some(methods) => methods(stone, setup, &asked(estimator)),
            None => estimator.kind.methods(stone, setup, &asked(estimator)),
        };
        for method in methods {
            sheet.fill(estimator.kind, method, false)?;
        }
    }
    for metric in unfit.iter().flat_map(asked) {
        sheet.row.leave_out(metric, subject.material.no_dispersion());
    }
    if exact {
        for estimator in &fit {
            let methods = estimator.by_beams.map(|methods| methods(stone, setup, &asked(estimator)));
            for method in methods.into_iter().flatten() {
                sheet.fill(estimator.kind, method, true)?;
            }
        }
        sheet.unfinished = true;
        let finished = sheet.row.samples.len();
        for estimator in fit.iter().filter(|e| e.completes_beams) {
            for method in estimator.kind.methods(stone, setup, &asked(estimator)) {
                sheet.fill(estimator.kind, method, false)?;
            }
        }
        if row.samples.len() > finished {
            // what beams did not give photons have
            let scored = |name: &str| {
                plan.metrics.iter().zip(&row.scores).any(|(m, score)| m.name == name && score.is_some())
            };
            row.left_out.retain(|(name, _)| !scored(name));
            row.note = Some(TOO_MANY_BEAMS);
        }
    } else if plan.exact && plan.metrics.iter().any(|m| m.by_beams) {
        row.note = Some(NO_BEAMS_IN_COLOUR);
    }
    Ok(())
}

/// Notes of rows that have photons where beams were asked for.
const TOO_MANY_BEAMS: &str =
    "too many beams to follow each point's strongest path: by photons, with their error";
const NO_BEAMS_IN_COLOUR: &str = "beams do not follow absorption: --exact has no effect on a coloured stone";
const NO_BEAMS_IN_NONCONVEX: &str = "beams need a convex stone: --exact has no effect on this one";

/// The scores of a stone that is not convex.
fn fill_nonconvex(
    row: &mut ScoreRow,
    stone: &MeshStone,
    subject: &ScoreInput,
    plan: &ScoreRequest,
) -> Result<(), EstimatorError> {
    let setup = subject.setup(plan);
    plan.metrics.iter().filter(|m| !m.nonconvex).for_each(|m| row.leave_out(m, NONCONVEX));
    if plan.exact && plan.metrics.iter().any(|m| m.by_beams && m.nonconvex) {
        row.note = Some(NO_BEAMS_IN_NONCONVEX);
    }
    let mut sheet = ScoreAccumulator { row, plan, exact: false, convex: None, unfinished: false };
    for estimator in estimators(plan) {
        for method in estimator.nonconvex.into_iter().flat_map(|methods| methods(stone, setup)) {
            sheet.fill(estimator.kind, method, false)?;
        }
    }
    Ok(())
}

impl ScoreRequest {
    /// The share of a ray's light below which it is given up: no more than half of an error that is
    /// asked for, so that what is given up does not stand in the way of it.
    fn stop_power(&self) -> f32 {
        /// Below this the roundings of `f32` count for as much.
        const LEAST: f32 = 1e-8;
        match self.target {
            Target::Samples(_) => STOP_POWER,
            Target::Error(target) => ((0.5 * target) as f32).clamp(LEAST, STOP_POWER),
        }
    }
}

impl ScoreInput {
    /// The light and the eye that the stone is scored with.
    pub fn setup(&self, plan: &ScoreRequest) -> Setup<'_> {
        Setup {
            medium: TraceOptics { material: &self.material, polarised: plan.polarised },
            view_frame: self.tilt.map_or(ViewFrame::FACE_UP, |t| ViewFrame::tilted(t.degrees, t.azimuth)),
            stop_power: plan.stop_power(),
            observer: plan.observer,
            by_symmetry: false,
        }
    }
}
