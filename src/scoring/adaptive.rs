//! Adaptive sampling: a row of scores, estimator by estimator, each as far as the settings ask.

use super::score::{ScoreRequest, ScoreRow, Target};
use crate::estimators::catalogue::BeamNoise;
use crate::estimators::kind::{BeamTallies, EstimatorKind, MakeEstimator, Method, NOTHING_SEEN, Procedure};
use crate::estimators::weighted_exits::BeamEffort;
use crate::estimators::{BATCHES, BatchedEstimate, Estimator, EstimatorError};
use crate::metrics::{Metric, MetricSource, Statistic};
use crate::parse::format_number;
use crate::sampling::stats::Estimate;
use crate::trace::ConvexStone;

/// So many points of the hemisphere are as dear as one photon that finishes beams, which then outweigh it.
const PHOTON_COST: u64 = 16;

/// Points of the hemisphere, or as much of other estimators, before its error is looked at: enough for
/// every batch to have seen something.
const FIRST_SAMPLES: u64 = 1 << 13;

/// By how much samples grow from one look at the error to the next.
const LEAST_STEP: f64 = 1.1;
const LARGEST_STEP: f64 = 16.0;

/// The same for a median, whose error falls at once when samples can tell two peaks apart.
const LARGEST_STEP_OF_MEDIAN: f64 = 4.0;

/// Which metrics are taken from beams.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum BeamUse {
    /// None.
    None,
    /// All that beams give.
    All,
    /// Those of one direction, for which beams are quicker than photons; what is left untraced of those
    /// without noise is this share of the light.
    OneDirection(f64),
}

impl BeamUse {
    fn gives(self, metric: &Metric) -> bool {
        match self {
            BeamUse::None => false,
            BeamUse::All => metric.by_beams,
            BeamUse::OneDirection(_) => metric.beam_noise().is_some_and(|n| n != BeamNoise::Directions),
        }
    }

    fn untraced(self) -> f64 {
        if let BeamUse::OneDirection(untraced) = self { untraced } else { 0.0 }
    }
}

/// A row that is being filled in.
pub(super) struct ScoreAccumulator<'a> {
    pub row: &'a mut ScoreRow,
    pub plan: &'a ScoreRequest,
    /// Which metrics are taken from beams.
    pub beams: BeamUse,
    /// The stone; none if it is not convex.
    pub convex: Option<&'a ConvexStone>,
    /// Whether photons fill in what beams were to give and did not.
    pub unfinished: bool,
}

/// A column of the row: its number, its metric's scale, and what it is of the sums.
type RowColumn = (usize, f64, Statistic);

impl ScoreAccumulator<'_> {
    /// The columns of the row that a method fills in.
    ///
    /// - `by_beams`: whether it is a method by beams
    fn columns(&self, kind: &dyn EstimatorKind, method: &Method, by_beams: bool) -> Vec<RowColumn> {
        let exact = |m: &Metric| self.beams.gives(m);
        let asked = |i: usize, m: &Metric| match self.unfinished {
            true => exact(m) && self.row.scores[i].is_none(),
            false => exact(m) == by_beams && (m.nonconvex || self.convex.is_some()),
        };
        let given = |m: &Metric| m.is_of(kind) && (method.gives)(m);
        let metrics = self.plan.metrics.iter().enumerate().filter(|(i, m)| given(m) && asked(*i, m));
        let column = |(i, m): (usize, &&'static Metric)| match m.read_from {
            MetricSource::Sums(of) => Some((i, m.scale, of)),
            MetricSource::Solid(_) => None,
        };
        metrics.filter_map(column).collect()
    }

    /// Goes through with a method as far as the settings ask and fills in the columns that it gives, if there
    /// are any.
    ///
    /// - `by_beams`: as [`ScoreAccumulator::columns`] has it
    pub fn fill(
        &mut self,
        kind: &dyn EstimatorKind,
        method: Method,
        by_beams: bool,
    ) -> Result<(), EstimatorError> {
        let columns = self.columns(kind, &method, by_beams);
        if columns.is_empty() {
            return Ok(());
        }
        match method.procedure {
            Procedure::Samples(cost, make) => self.sample(kind, method.name, &columns, by_beams, cost, make),
            Procedure::Beams(tallies) => self.follow_beams(kind, method.name, &columns, &tallies),
        }
    }

    /// Fills in columns by samples.
    ///
    /// - `cost`: so many points of the hemisphere are as dear as one of them
    fn sample(
        &mut self,
        kind: &dyn EstimatorKind,
        name: &'static str,
        columns: &[RowColumn],
        by_beams: bool,
        cost: u64,
        make: MakeEstimator,
    ) -> Result<(), EstimatorError> {
        let mut traced = BatchedEstimate::new(make()?, self.plan.seed);
        let estimate = |t: &BatchedEstimate<Box<dyn Estimator + '_>>, of: &Statistic| {
            if by_beams { t.exact(of) } else { t.score(of) }
        };
        match self.plan.target {
            Target::Samples(samples) => traced.extend_to((samples / cost).max(1)),
            Target::Error(target) => {
                let worst =
                    |t: &BatchedEstimate<Box<dyn Estimator + '_>>| worst(columns, |of| estimate(t, of));
                let (first, cap) = (FIRST_SAMPLES / cost, self.plan.cap / cost);
                let median = columns.iter().any(|(.., of)| matches!(of, Statistic::Median(_)));
                let step = if median { LARGEST_STEP_OF_MEDIAN } else { LARGEST_STEP };
                if let Some(error) = sample_to_target(&mut traced, target, [first.max(1), cap], step, worst) {
                    self.complain(name, target, error, traced.samples());
                }
            }
        }
        self.record(kind, name, traced.samples(), columns, |of| estimate(&traced, of));
        Ok(())
    }

    /// Fills in columns by beams of one direction, with photons for what is left over as far as the settings
    /// ask.
    fn follow_beams(
        &mut self,
        kind: &dyn EstimatorKind,
        name: &'static str,
        columns: &[RowColumn],
        tallies: &BeamTallies,
    ) -> Result<(), EstimatorError> {
        let cap = self.plan.cap / PHOTON_COST;
        let mut photons = match self.plan.target {
            Target::Samples(samples) => samples / PHOTON_COST,
            Target::Error(_) => FIRST_SAMPLES / PHOTON_COST,
        };
        loop {
            // fewer than two a batch would leave the remainder out
            photons = photons.max(2 * BATCHES as u64);
            let effort = BeamEffort {
                photons: photons as usize,
                seed: self.plan.seed,
                untraced: self.beams.untraced(),
                ..BeamEffort::default()
            };
            let found = tallies(&effort)?;
            let estimate = |of: &Statistic| of.computed(&found, |sums| kind.bounds_of_untraced(sums));
            let error = worst(columns, estimate);
            match self.plan.target {
                Target::Error(target) if error > target && photons < cap => {
                    photons = next_samples(photons, error / target, LARGEST_STEP).min(cap);
                    continue;
                }
                Target::Error(target) if error > target => self.complain(name, target, error, photons),
                _ => (),
            }
            self.record(kind, name, photons, columns, estimate);
            return Ok(());
        }
    }

    fn record(
        &mut self,
        kind: &dyn EstimatorKind,
        name: &'static str,
        samples: u64,
        columns: &[RowColumn],
        estimate: impl Fn(&Statistic) -> Option<Estimate>,
    ) {
        for (column, _, of) in columns {
            let metric = self.plan.metrics[*column];
            let (least, most) = metric.range;
            match estimate(of).filter(|e| e.error.is_finite()) {
                // sums may be out by their rounding; + 0 takes the sign from a zero
                Some(e) => {
                    self.row.scores[*column] =
                        Some(Estimate { value: e.value.clamp(least, most) + 0.0, ..e });
                }
                None => {
                    let why = self.convex.map_or(NOTHING_SEEN, |stone| kind.why_unseen(stone));
                    self.row.leave_out(metric, why);
                }
            }
        }
        self.row.samples.push((name, samples));
    }

    /// Notes an error that was not reached.
    fn complain(&mut self, name: &str, target: f64, error: f64, samples: u64) {
        let target = format_number(target);
        let note = format!(
            "{name}: standard error {target} times the metric's scale not reached: {error:.2e} of it after {samples} samples"
        );
        let before = self.row.error.take();
        self.row.error = Some(before.map_or(note.clone(), |e| format!("{e}; {note}")));
    }
}

/// The largest error of any column, measured against its scale.
fn worst(columns: &[RowColumn], estimate: impl Fn(&Statistic) -> Option<Estimate>) -> f64 {
    columns.iter().filter_map(|(_, scale, of)| Some(estimate(of)?.error / scale)).fold(0.0, f64::max)
}

/// How many samples are likely to bring an error down that is `times` too large: the errors of evenly
/// spread points fall with the root of the samples or faster, about as samples to the power of 2/3.
fn next_samples(samples: u64, times: f64, largest: f64) -> u64 {
    (samples as f64 * times.powf(1.5).clamp(LEAST_STEP, largest)) as u64
}

/// Traces until the error is below the target; the error if the cap comes first.
///
/// - `first`, `cap`: samples at the first look at the error, and at the last; `step`: the largest
///   growth between two looks
fn sample_to_target<E: Estimator>(
    traced: &mut BatchedEstimate<E>,
    target: f64,
    [first, cap]: [u64; 2],
    step: f64,
    worst: impl Fn(&BatchedEstimate<E>) -> f64,
) -> Option<f64> {
    traced.extend_to(first.min(cap));
    loop {
        let error = worst(traced);
        if error <= target {
            return None;
        }
        if traced.samples() >= cap {
            return Some(error);
        }
        traced.extend_to(next_samples(traced.samples(), error / target, step).min(cap));
    }
}
