//! Adaptive sampling: a row of scores, estimator by estimator, each as far as the settings ask.

use super::score::{ScoreRequest, ScoreRow, Target};
use crate::estimators::weighted_exits::BeamEffort as Work;
use crate::estimators::{BATCHES, BatchedEstimate, Estimator, EstimatorError};
use crate::metrics::{Metric, MetricSource};
use crate::parse::format_number;
use crate::sampling::statistic::Statistic;
use crate::sampling::stats::{Accumulate, Estimate};

/// So many points of the hemisphere are as dear as one photon that finishes beams, which then outweigh it.
const PHOTON_COST: u64 = 16;

/// Points of the hemisphere, or as much of other estimators, before its error is looked at: enough for
/// every batch to have seen something.
const FIRST_SAMPLES: u64 = 1 << 13;

/// Why scores of the table are left out.
const NO_TABLE: &str = "the stone has no table";

/// Why a score is left out that nothing was seen for: a share of no light has no value.
const NOTHING_SEEN: &str = "no light is seen that it could be measured on";

/// By how much samples grow from one look at the error to the next.
const LEAST_STEP: f64 = 1.1;
const LARGEST_STEP: f64 = 16.0;

/// The same for a median, whose error falls at once when samples can tell two peaks apart.
const LARGEST_STEP_OF_MEDIAN: f64 = 4.0;

/// A row that is being filled in.
pub(super) struct ScoreAccumulator<'a> {
    pub row: &'a mut ScoreRow,
    pub plan: &'a ScoreRequest,
    /// Whether beams are used.
    pub exact: bool,
    /// Whether the stone is not convex.
    pub nonconvex: bool,
    /// Whether the stone has a table.
    pub table: bool,
    /// Whether photons fill in what beams were to give and did not.
    pub unfinished: bool,
}

/// A column: its number, its metric's scale, and what it reads from a tally.
type Column<T> = (usize, f64, Statistic<T>);

impl ScoreAccumulator<'_> {
    /// The columns that read a tally.
    ///
    /// - `of`: what a metric reads from it, if it does; `by_beams`: whether beams have filled it in
    fn columns<T>(
        &self,
        of: impl Fn(MetricSource) -> Option<Statistic<T>>,
        by_beams: bool,
    ) -> Vec<Column<T>> {
        let exact = |m: &Metric| self.exact && m.by_beams;
        let asked = |i: usize, m: &Metric| match self.unfinished {
            true => exact(m) && self.row.scores[i].is_none(),
            false => exact(m) == by_beams && (m.nonconvex || !self.nonconvex),
        };
        let metrics = self.plan.metrics.iter().enumerate().filter(|(i, m)| asked(*i, m));
        metrics.filter_map(|(i, m)| Some((i, m.scale, of(m.read_from)?))).collect()
    }

    /// Traces an estimator as far as the settings ask and fills in the columns that read it, if there
    /// are any.
    ///
    /// - `of`, `by_beams`: as [`ScoreAccumulator::columns`] has them
    /// - `cost`: so many points of the hemisphere are as dear as one of this estimator
    pub fn fill<E: Estimator>(
        &mut self,
        name: &'static str,
        of: impl Fn(MetricSource) -> Option<Statistic<E::Tally>>,
        by_beams: bool,
        cost: u64,
        make: impl FnOnce() -> Result<E, EstimatorError>,
    ) -> Result<(), EstimatorError> {
        let columns = self.columns(of, by_beams);
        if columns.is_empty() {
            return Ok(());
        }
        let mut traced = BatchedEstimate::new(make()?, self.plan.seed);
        let estimate = |t: &BatchedEstimate<E>, of: &Statistic<E::Tally>| {
            if by_beams { t.exact(of) } else { t.score(of) }
        };
        match self.plan.target {
            Target::Samples(samples) => traced.extend_to((samples / cost).max(1)),
            Target::Error(target) => {
                let worst = |t: &BatchedEstimate<E>| worst(&columns, |of| estimate(t, of));
                let (first, cap) = (FIRST_SAMPLES / cost, self.plan.cap / cost);
                let median = columns.iter().any(|(.., of)| matches!(of, Statistic::Median(..)));
                let step = if median { LARGEST_STEP_OF_MEDIAN } else { LARGEST_STEP };
                if let Some(error) = sample_to_target(&mut traced, target, [first.max(1), cap], step, worst) {
                    self.complain(name, target, error, traced.samples());
                }
            }
        }
        self.record(name, traced.samples(), &columns, |of| estimate(&traced, of));
        Ok(())
    }

    /// Fills in the columns that beams of one direction give, with photons for what is left over as
    /// far as the settings ask.
    ///
    /// - `of`, `by_beams`: as [`ScoreAccumulator::columns`] has them
    pub fn finish<T: Accumulate>(
        &mut self,
        name: &'static str,
        of: impl Fn(MetricSource) -> Option<Statistic<T>>,
        by_beams: bool,
        tallies: impl Fn(&Work) -> Result<Vec<T>, EstimatorError>,
    ) -> Result<(), EstimatorError> {
        let columns = self.columns(of, by_beams);
        if columns.is_empty() {
            return Ok(());
        }
        let cap = self.plan.cap / PHOTON_COST;
        let mut photons = match self.plan.target {
            Target::Samples(samples) => samples / PHOTON_COST,
            Target::Error(_) => FIRST_SAMPLES / PHOTON_COST,
        };
        loop {
            // fewer than two a batch would leave the remainder out
            photons = photons.max(2 * BATCHES as u64);
            let work = Work { photons: photons as usize, seed: self.plan.seed, ..Work::default() };
            let found = tallies(&work)?;
            let estimate = |of: &Statistic<T>| of.computed(&found);
            let error = worst(&columns, estimate);
            match self.plan.target {
                Target::Error(target) if error > target && photons < cap => {
                    photons = next_samples(photons, error / target, LARGEST_STEP).min(cap);
                    continue;
                }
                Target::Error(target) if error > target => self.complain(name, target, error, photons),
                _ => (),
            }
            self.record(name, photons, &columns, estimate);
            return Ok(());
        }
    }

    fn record<T>(
        &mut self,
        name: &'static str,
        samples: u64,
        columns: &[Column<T>],
        estimate: impl Fn(&Statistic<T>) -> Option<Estimate>,
    ) {
        for (column, _, of) in columns {
            let (least, most) = self.plan.metrics[*column].range;
            match estimate(of).filter(|e| e.error.is_finite()) {
                // sums may be out by their rounding; + 0 takes the sign from a zero
                Some(e) => {
                    self.row.scores[*column] =
                        Some(Estimate { value: e.value.clamp(least, most) + 0.0, ..e });
                }
                None => {
                    let metric = self.plan.metrics[*column];
                    let tableless = !self.table && matches!(metric.read_from, MetricSource::FaceterView(_));
                    self.row.leave_out(metric, if tableless { NO_TABLE } else { NOTHING_SEEN });
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
fn worst<T>(columns: &[Column<T>], estimate: impl Fn(&Statistic<T>) -> Option<Estimate>) -> f64 {
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
