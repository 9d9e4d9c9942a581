//! Independent batches of one estimator, traced side by side.

use crate::parallel;
use crate::sampling::statistic::Statistic;
use crate::sampling::stats::{self, Estimate};
use crate::sampling::tally::Tally;
use std::ops::Range;

/// Independent batches of an estimator. Errors come from their spread: with 64 the error itself
/// is known to 9 %.
pub const BATCHES: usize = 64;

/// One estimator on one stone.
pub trait Estimator: Sync {
    /// Traces the points numbered `points` of a batch and adds them to its tally.
    ///
    /// The result must depend on the arguments alone, and batches must be independent.
    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Tally);

    /// What sums would be had all the light that was given up gone one way, for each way that it may have
    /// gone; none if they hold no light.
    fn bounds_of_untraced(&self, _sums: &Tally) -> Vec<Tally> {
        Vec::new()
    }
}

impl<E: Estimator + ?Sized> Estimator for Box<E> {
    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Tally) {
        self.as_ref().trace(seed, batch, points, tally);
    }

    fn bounds_of_untraced(&self, sums: &Tally) -> Vec<Tally> {
        self.as_ref().bounds_of_untraced(sums)
    }
}

/// An estimator with what it has added up so far.
///
/// A pure function of estimator, seed and the calls of [`BatchedEstimate::extend_to`]: threads take whole
/// batches, so neither their number nor their order shows in a single bit. Checked in
/// `tests/library/score_promises.rs` with one, two and five threads.
#[derive(Debug, Clone)]
pub struct BatchedEstimate<E: Estimator> {
    estimator: E,
    seed: u64,
    tallies: Vec<Tally>,
    points: u64,
}

impl<E: Estimator> BatchedEstimate<E> {
    /// The estimator before the first point.
    pub fn new(estimator: E, seed: u64) -> Self {
        Self { estimator, seed, tallies: vec![Tally::default(); BATCHES], points: 0 }
    }

    /// Traces on until at least `samples` points are done in all batches together.
    pub fn extend_to(&mut self, samples: u64) {
        let points = samples.div_ceil(BATCHES as u64);
        if points <= self.points {
            return;
        }
        let (from, seed, estimator) = (self.points, self.seed, &self.estimator);
        parallel::for_each_mut(&mut self.tallies, |batch, tally| {
            estimator.trace(seed, batch as u64, from..points, tally);
        });
        self.points = points;
    }

    /// Points traced, all batches together.
    pub fn samples(&self) -> u64 {
        self.points * BATCHES as u64
    }

    /// The estimator.
    pub fn estimator(&self) -> &E {
        &self.estimator
    }

    /// What the batches have added up, in their order.
    pub fn tallies(&self) -> &[Tally] {
        &self.tallies
    }

    /// A score, with the error that its kind of statistic has; none if nothing was seen that it could be
    /// a score of.
    pub fn score(&self, of: &Statistic) -> Option<Estimate> {
        of.sampled(&self.tallies, |sums| self.estimator.bounds_of_untraced(sums))
    }

    /// The same where directions are random and the rest is known: see [`Statistic::computed`].
    pub fn exact(&self, of: &Statistic) -> Option<Estimate> {
        of.computed(&self.tallies, |sums| self.estimator.bounds_of_untraced(sums))
    }

    /// A smooth function of the sums over all batches, with its standard error (see
    /// [`stats::jackknife`]); 0 where the function is not a number, because nothing was seen. The error
    /// holds what was given up ([`stats::with_given_up`]).
    pub fn estimate(&self, of: impl Fn(&Tally) -> f64) -> Estimate {
        let number = |x: f64| if x.is_finite() { x } else { 0.0 };
        let of = |sum: &Tally| number(of(sum));
        let all = stats::all(&self.tallies);
        let bounds = self.estimator.bounds_of_untraced(&all);
        stats::with_given_up(stats::jackknife(&self.tallies, of), &all, &bounds, of)
    }
}
