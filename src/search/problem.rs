//! Problems: variables with their ranges, and what is known of a point.

use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::ops::RangeInclusive;

/// The most objectives of a problem: the exact hypervolume of more takes too long.
pub const MOST_OBJECTIVES: usize = 5;

/// A box of variables, the point where the search starts, and the number of objectives.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    ranges: Vec<RangeInclusive<f64>>,
    start: Vec<f64>,
    objectives: usize,
}

/// Why there is nothing to search.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProblemError {
    /// No variable.
    #[error("there is nothing to vary")]
    NoVariables,
    /// None, or more than [`MOST_OBJECTIVES`].
    #[error("{0} objectives: from 1 to {MOST_OBJECTIVES} can be searched for at once")]
    Objectives(usize),
    /// Ends that are not finite, or not in order.
    #[error("variable {}: {low} to {high} is not a range", index + 1)]
    Range {
        /// Of the variable, from 0.
        index: usize,
        /// The lower end.
        low: f64,
        /// The upper end.
        high: f64,
    },
    /// The start has not one finite value for each variable.
    #[error("the start has {found} finite values for {variables} variables")]
    Start {
        /// Of the problem.
        variables: usize,
        /// Of the start.
        found: usize,
    },
}

impl Problem {
    /// A problem whose search begins at `start`.
    ///
    /// - `ranges`: of each variable, in its own unit, the ends included
    /// - `start`: a value for each variable. It may lie outside its range: it is evaluated as it is, and the
    ///   search goes on from the nearest point inside
    /// - `objectives`: how many an outcome has, at most [`MOST_OBJECTIVES`]
    ///
    /// # Errors
    ///
    /// Nothing to vary, no objective or too many, a range that is none.
    pub fn new(
        ranges: Vec<RangeInclusive<f64>>,
        start: Vec<f64>,
        objectives: usize,
    ) -> Result<Problem, ProblemError> {
        if ranges.is_empty() {
            return Err(ProblemError::NoVariables);
        }
        if objectives == 0 || objectives > MOST_OBJECTIVES {
            return Err(ProblemError::Objectives(objectives));
        }
        for (index, range) in ranges.iter().enumerate() {
            let (low, high) = (*range.start(), *range.end());
            // a range of one value leaves nothing to vary, and a difference beyond f64 no coordinate
            if low.partial_cmp(&high) != Some(Ordering::Less) || !(high - low).is_finite() {
                return Err(ProblemError::Range { index, low, high });
            }
        }
        let found = start.iter().filter(|value| value.is_finite()).count();
        if found != ranges.len() || start.len() != ranges.len() {
            return Err(ProblemError::Start { variables: ranges.len(), found });
        }
        Ok(Problem { ranges, start, objectives })
    }

    /// The ranges of the variables.
    pub fn ranges(&self) -> &[RangeInclusive<f64>] {
        &self.ranges
    }

    /// The point of candidate 0.
    pub fn start(&self) -> &[f64] {
        &self.start
    }

    /// How many objectives an outcome has.
    pub fn objectives(&self) -> usize {
        self.objectives
    }

    /// The coordinates of a point in the unit cube: 0 at the lower end of each range, 1 at the upper. A point
    /// outside has those of the nearest point inside.
    pub fn to_unit(&self, values: &[f64]) -> Vec<f64> {
        let scaled = |(range, value): (&RangeInclusive<f64>, &f64)| {
            ((value - range.start()) / (range.end() - range.start())).clamp(0.0, 1.0)
        };
        self.ranges.iter().zip(values).map(scaled).collect()
    }

    /// The point at coordinates of the unit cube; 0 and 1 are the ends exactly.
    pub fn from_unit(&self, unit: &[f64]) -> Vec<f64> {
        let scaled = |(range, u): (&RangeInclusive<f64>, &f64)| {
            let (low, high) = (*range.start(), *range.end());
            if *u >= 1.0 { high } else { (low + u * (high - low)).clamp(low, high) }
        };
        self.ranges.iter().zip(unit).map(scaled).collect()
    }

    /// The outcome as the search takes it: nothing there, if an objective or the violation is not a number, an
    /// objective is not finite, or one is missing.
    pub(super) fn checked(&self, outcome: Outcome) -> Outcome {
        let whole = outcome.objectives.len() == self.objectives
            && outcome.objectives.iter().all(|value| value.is_finite())
            && outcome.violation >= 0.0
            && outcome.violation.is_finite();
        if whole { outcome } else { Outcome::nothing() }
    }
}

/// What was found at a point.
///
/// As JSON a violation that is infinite is `null`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(from = "OutcomeRecord", into = "OutcomeRecord")]
pub struct Outcome {
    /// The value of each objective; more is better. Empty where there is nothing to value.
    pub objectives: Vec<f64>,
    /// By how much constraints are broken in all: 0 is feasible, infinite is nothing there (no stone). Sums of
    /// different constraints are comparable if each is measured in shares of its bound.
    pub violation: f64,
}

/// An outcome as data, without an infinite number.
#[derive(Serialize, Deserialize)]
struct OutcomeRecord {
    objectives: Vec<f64>,
    violation: Option<f64>,
}

impl From<OutcomeRecord> for Outcome {
    fn from(record: OutcomeRecord) -> Outcome {
        Outcome { objectives: record.objectives, violation: record.violation.unwrap_or(f64::INFINITY) }
    }
}

impl From<Outcome> for OutcomeRecord {
    fn from(outcome: Outcome) -> OutcomeRecord {
        let violation = Some(outcome.violation).filter(|v| v.is_finite());
        OutcomeRecord { objectives: outcome.objectives, violation }
    }
}

impl Outcome {
    /// The outcome of a feasible point.
    pub fn feasible(objectives: Vec<f64>) -> Outcome {
        Outcome { objectives, violation: 0.0 }
    }

    /// The outcome of a point where there is nothing to value.
    pub fn nothing() -> Outcome {
        Outcome { objectives: Vec::new(), violation: f64::INFINITY }
    }

    /// Whether no constraint is broken.
    pub fn is_feasible(&self) -> bool {
        self.violation == 0.0
    }

    /// Whether this outcome is at least as good as the other in all, and better in something: feasible before
    /// infeasible, then the smaller violation, then no objective smaller and one larger (K. Deb, Comput.
    /// Methods Appl. Mech. Engrg. 186 (2000) 311).
    pub fn dominates(&self, other: &Outcome) -> bool {
        match self.violation.total_cmp(&other.violation) {
            Ordering::Less => true,
            Ordering::Greater => false,
            Ordering::Equal => {
                let pairs = || self.objectives.iter().zip(&other.objectives);
                pairs().all(|(a, b)| a >= b) && pairs().any(|(a, b)| a > b)
            }
        }
    }
}

/// A point that was evaluated.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Candidate {
    /// The value of each variable, in its own unit.
    pub values: Vec<f64>,
    /// What was found there.
    pub outcome: Outcome,
}

/// Gives the outcomes of points.
pub trait Evaluate {
    /// The outcomes of a batch of points, in their order. They must not depend on which batch a point is in.
    ///
    /// Fewer outcomes than points mean that the evaluation was given up: the search ends with what it has.
    ///
    /// - `batch`: a value for each variable of each point, in the variable's own unit
    fn evaluate(&self, batch: &[Vec<f64>]) -> Vec<Outcome>;
}

/// A function of one point is evaluated on all threads.
impl<F: Fn(&[f64]) -> Outcome + Sync + Send> Evaluate for F {
    fn evaluate(&self, batch: &[Vec<f64>]) -> Vec<Outcome> {
        crate::parallel::map(batch.len(), |i| self(&batch[i]))
    }
}
