//! Scores of stones: which estimators to run, how long, and one row a stone.

use super::adaptive::{BeamUse, ScoreAccumulator};
pub use super::settings::{
    DEFAULT_SAMPLES, MAX_SAMPLES, ScoreInput, ScoreRequest, ScoreRow, StoneShape, Target, Tilt,
};
use crate::estimators::catalogue::CataloguedEstimator;
use crate::estimators::{ESTIMATORS, EstimatorError, STOP_POWER, Setup, TraceOptics, ViewFrame};
use crate::materials::Material;
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
    let mut row = ScoreRow::empty(subject.stone.clone(), subject.material.name.to_string(), plan);
    let filled = match &subject.shape {
        Ok(StoneShape::Convex(solid)) => {
            let stone = ConvexStone::new(solid.clone());
            row.facets = Some(stone.facet_count());
            let setup = subject.setup(plan);
            let beams = if plan.exact { BeamUse::All } else { BeamUse::None };
            fill(&mut row, &stone, setup, plan, beams).map_err(|e| e.to_string())
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

/// Scores a stone among many like it: beams give what they are quicker at, in one sector of a symmetric stone.
///
/// - `untraced`: share of the light that is left untraced where beams have no noise, as
///   [`crate::estimators::weighted_exits::BeamEffort::untraced`]
pub(super) fn score_candidate(
    stone: &ConvexStone,
    material: &Material,
    tilt: Option<Tilt>,
    plan: &ScoreRequest,
    untraced: f64,
) -> ScoreRow {
    let mut row = ScoreRow::empty(String::new(), String::new(), plan);
    let setup = Setup { by_symmetry: true, ..setup(material, tilt, plan) };
    if let Err(why) = fill(&mut row, stone, setup, plan, BeamUse::OneDirection(untraced)) {
        row.error = Some(why.to_string());
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
    setup: Setup,
    plan: &ScoreRequest,
    beams: BeamUse,
) -> Result<(), EstimatorError> {
    let material = setup.medium.material;
    for (column, metric) in plan.metrics.iter().enumerate() {
        if let MetricSource::Solid(of) = metric.read_from {
            row.scores[column] = of(&stone.solid).map(Estimate::exact);
            if row.scores[column].is_none() {
                row.leave_out(metric, NO_OUTLINE);
            }
        }
    }
    let (clear, dispersive) = (material.is_clear(), material.is_dispersive());
    let asked_for = beams != BeamUse::None;
    let beams = if clear { beams } else { BeamUse::None };
    let mut sheet = ScoreAccumulator { row, plan, beams, convex: Some(stone), unfinished: false };
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
        sheet.row.leave_out(metric, material.no_dispersion());
    }
    if beams != BeamUse::None {
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
    } else if asked_for && plan.metrics.iter().any(|m| m.by_beams) {
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
    let mut sheet = ScoreAccumulator { row, plan, beams: BeamUse::None, convex: None, unfinished: false };
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
        setup(&self.material, self.tilt, plan)
    }
}

/// The light and the eye that a stone is scored with.
fn setup<'a>(material: &'a Material, tilt: Option<Tilt>, plan: &ScoreRequest) -> Setup<'a> {
    Setup {
        medium: TraceOptics { material, polarised: plan.polarised },
        view_frame: tilt.map_or(ViewFrame::FACE_UP, |t| ViewFrame::tilted(t.degrees, t.azimuth)),
        stop_power: plan.stop_power(),
        observer: plan.observer,
        by_symmetry: false,
    }
}
