//! The run of a search: batches within the budget, one after the other.

use super::front;
use super::method::{SearchError, SearchSettings};
use super::methods;
use super::problem::{Candidate, Evaluate, Outcome, Problem};
use super::replay::key;
use crate::progress::Progress;
use std::collections::BTreeMap;

/// Rounds in a row in which a method asks only for points that are known, before the search ends: it has
/// nothing new to ask for.
const MOST_IDLE_ROUNDS: usize = 100;

/// What a search has found.
#[derive(Debug, Clone, PartialEq)]
pub struct SearchResult {
    /// All points evaluated, in the order of evaluation; the first is the start.
    pub candidates: Vec<Candidate>,
    /// Whether it was ended before its time.
    pub is_cancelled: bool,
}

impl SearchResult {
    /// The number of the best candidate for the first objective: feasible before infeasible, then the smaller
    /// violation, then the larger objective, then the earlier.
    pub fn best(&self) -> Option<usize> {
        front::ranked(&self.candidates).first().copied()
    }

    /// The numbers of the feasible candidates that none dominates, one for equal objectives, by the first
    /// objective from the best.
    pub fn front(&self) -> Vec<usize> {
        front::front(&self.candidates)
    }
}

/// Searches a problem.
///
/// Candidate 0 is the start as it is. A point that was evaluated is not evaluated again, and does not count
/// again. Progress has one part for each evaluation, and hears of the best after each batch.
///
/// # Errors
///
/// The method is none for so many objectives.
pub fn search(
    problem: &Problem,
    settings: &SearchSettings,
    evaluate: &dyn Evaluate,
    progress: &dyn Progress,
) -> Result<SearchResult, SearchError> {
    let objectives = problem.objectives();
    let method = settings.method;
    if !method.takes(objectives) {
        return Err(SearchError::Method { method, objectives });
    }
    let mut run = Run {
        problem,
        budget: settings.evaluations,
        evaluate,
        progress,
        known: BTreeMap::new(),
        result: SearchResult { candidates: Vec::new(), is_cancelled: false },
    };
    progress.begin("searching", settings.evaluations as u64);
    let ended = run.rounds(settings);
    progress.end();
    ended.map(|()| run.result)
}

/// Where a search stands.
struct Run<'a> {
    problem: &'a Problem,
    budget: usize,
    evaluate: &'a dyn Evaluate,
    progress: &'a dyn Progress,
    /// The candidates by their coordinates in the unit cube.
    known: BTreeMap<Vec<u64>, usize>,
    result: SearchResult,
}

impl Run<'_> {
    /// Asks for points and tells their outcomes until the budget is spent or there is nothing new to ask for.
    fn rounds(&mut self, settings: &SearchSettings) -> Result<(), SearchError> {
        let start = self.problem.to_unit(self.problem.start());
        if self.outcomes(std::slice::from_ref(&start)).is_none() {
            return Ok(());
        }
        let mut proposer = methods::proposer(self.problem, start, settings)?;
        let mut idle = 0;
        while self.result.candidates.len() < self.budget && idle < MOST_IDLE_ROUNDS {
            let points = proposer.ask()?;
            let before = self.result.candidates.len();
            let Some(outcomes) = self.outcomes(&points) else { break };
            idle = if self.result.candidates.len() == before { idle + 1 } else { 0 };
            proposer.tell(&outcomes)?;
        }
        Ok(())
    }

    /// The outcomes of points of the unit cube; none, if the search ends before all of them are there.
    fn outcomes(&mut self, points: &[Vec<f64>]) -> Option<Vec<Outcome>> {
        let left = self.budget - self.result.candidates.len();
        let mut new: Vec<Vec<f64>> = Vec::new();
        let mut numbers = Vec::with_capacity(points.len());
        for point in points {
            let next = self.result.candidates.len() + new.len();
            let number = *self.known.entry(key(point)).or_insert(next);
            numbers.push(number);
            if number == next && new.len() == left {
                break;
            }
            if number == next {
                // candidate 0 is the start as it is, which may lie outside the box
                let is_start = number == 0;
                new.push(if is_start {
                    self.problem.start().to_vec()
                } else {
                    self.problem.from_unit(point)
                });
            }
        }
        if !self.evaluate(new) {
            return None;
        }
        let outcome = |number: usize| self.result.candidates.get(number).map(|c| c.outcome.clone());
        let outcomes: Vec<Outcome> = numbers.into_iter().map_while(outcome).collect();
        Some(outcomes).filter(|outcomes| outcomes.len() == points.len())
    }

    /// Evaluates points that are new; whether the search goes on.
    fn evaluate(&mut self, new: Vec<Vec<f64>>) -> bool {
        if new.is_empty() {
            return true;
        }
        if self.progress.is_cancelled() {
            self.result.is_cancelled = true;
            return false;
        }
        let asked = new.len();
        let outcomes = self.evaluate.evaluate(&new);
        let checked = outcomes.into_iter().map(|outcome| self.problem.checked(outcome));
        let candidates = new.into_iter().zip(checked);
        let candidates: Vec<Candidate> =
            candidates.map(|(values, outcome)| Candidate { values, outcome }).collect();
        let found = candidates.len();
        self.result.candidates.extend(candidates);
        self.progress.advance(found as u64);
        self.progress.say(&self.summary());
        self.result.is_cancelled = found < asked;
        found == asked
    }

    /// The best so far, in a few words.
    fn summary(&self) -> String {
        let best = self.result.best().and_then(|number| self.result.candidates.get(number));
        match best.map(|candidate| &candidate.outcome) {
            Some(outcome) if !outcome.is_feasible() => {
                format!("nothing feasible yet, violation {:.4}", outcome.violation)
            }
            Some(outcome) if outcome.objectives.len() == 1 => {
                outcome.objectives.iter().map(|value| format!("best {value:.4}")).collect()
            }
            Some(_) => format!("front of {}", self.result.front().len()),
            None => String::new(),
        }
    }
}
