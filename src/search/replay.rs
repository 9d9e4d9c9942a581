//! Replay: an interrupted search that goes on.

use super::problem::{Candidate, Evaluate, Outcome};
use std::collections::BTreeMap;

/// An evaluation that knows the outcomes of an earlier run.
///
/// A search that was interrupted is run again from its start with what was found before it ended: it asks for
/// the same points, those known are not evaluated again, and every new outcome is told in the order of
/// evaluation, so that it can be kept for the next time.
pub struct Replay<'a> {
    known: BTreeMap<Vec<u64>, Outcome>,
    inner: &'a dyn Evaluate,
    keep: &'a dyn Fn(&[Candidate]),
}

impl<'a> Replay<'a> {
    /// An evaluation by `inner` of all points that are not known.
    ///
    /// - `known`: candidates of an earlier run of the same search, in any order
    /// - `keep`: is told each batch's new candidates, in the order of evaluation
    pub fn new(known: Vec<Candidate>, inner: &'a dyn Evaluate, keep: &'a dyn Fn(&[Candidate])) -> Self {
        let known = known.into_iter().map(|candidate| (key(&candidate.values), candidate.outcome)).collect();
        Self { known, inner, keep }
    }
}

/// What tells points apart: the bits of their values.
pub(super) fn key(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

impl Evaluate for Replay<'_> {
    fn evaluate(&self, batch: &[Vec<f64>]) -> Vec<Outcome> {
        let known: Vec<Option<&Outcome>> = batch.iter().map(|point| self.known.get(&key(point))).collect();
        let unknown = batch.iter().zip(&known).filter(|(_, outcome)| outcome.is_none());
        let new: Vec<Vec<f64>> = unknown.map(|(point, _)| point.clone()).collect();
        let mut found = Vec::new();
        if !new.is_empty() {
            found = self.inner.evaluate(&new);
            let candidates = new.into_iter().zip(&found);
            let candidates: Vec<Candidate> =
                candidates.map(|(values, outcome)| Candidate { values, outcome: outcome.clone() }).collect();
            (self.keep)(&candidates);
        }
        // where the evaluation was given up, the batch ends at the first point without an outcome
        let mut found = found.into_iter();
        known.into_iter().map_while(|outcome| outcome.cloned().or_else(|| found.next())).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    fn square(point: &[f64]) -> Outcome {
        Outcome::feasible(vec![point[0] * point[0]])
    }

    #[test]
    fn known_points_are_not_evaluated_again() {
        let asked = Mutex::new(Vec::new());
        let counting = |point: &[f64]| {
            asked.lock().expect("no panic").push(point[0]);
            square(point)
        };
        let kept = Mutex::new(Vec::new());
        let keep = |new: &[Candidate]| kept.lock().expect("no panic").extend_from_slice(new);
        let known = vec![Candidate { values: vec![2.0], outcome: square(&[2.0]) }];
        let replay = Replay::new(known, &counting, &keep);
        let outcomes = replay.evaluate(&[vec![1.0], vec![2.0], vec![3.0]]);
        assert_eq!(outcomes, [square(&[1.0]), square(&[2.0]), square(&[3.0])]);
        let mut asked = asked.into_inner().expect("no panic");
        asked.sort_by(f64::total_cmp);
        assert_eq!(asked, [1.0, 3.0]);
        let kept: Vec<f64> = kept.into_inner().expect("no panic").iter().map(|c| c.values[0]).collect();
        assert_eq!(kept, [1.0, 3.0], "in the order of evaluation");
    }

    /// Gives up after one point.
    struct One;

    impl Evaluate for One {
        fn evaluate(&self, batch: &[Vec<f64>]) -> Vec<Outcome> {
            batch.iter().take(1).map(|point| square(point)).collect()
        }
    }

    #[test]
    fn a_batch_that_was_given_up_ends_where_it_was() {
        let known = vec![Candidate { values: vec![4.0], outcome: square(&[4.0]) }];
        let replay = Replay::new(known, &One, &|_| ());
        let outcomes = replay.evaluate(&[vec![1.0], vec![2.0], vec![4.0]]);
        assert_eq!(outcomes, [square(&[1.0])]);
    }
}
