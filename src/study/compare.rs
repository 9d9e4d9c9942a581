//! Stones against each other: the same random numbers for all, differences with errors of their own.

use super::score::{Effort, Plan, Row, Subject, score};
use crate::math::stats::Estimate;

/// Short runs that a comparison is made of. Each has other random numbers, the same for every
/// stone, so the spread of the differences is an honest error of them, and smaller than the errors
/// of the two scores together where the stones are alike.
pub const RUNS: u64 = 32;

/// Beyond so many standard errors a difference is called significant: of differences that are none,
/// 1 in 190 is (Student's t with 31 degrees of freedom).
pub const SIGNIFICANT: f64 = 3.0;

/// The scores of several stones.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// One a stone: name, material and facets are of it; the scores are means over the runs.
    pub rows: Vec<Row>,
    /// For each stone but the first, one a metric: its score less the first stone's.
    pub differences: Vec<Vec<Option<Estimate>>>,
}

/// Whether a difference is beyond chance.
pub fn is_significant(difference: Estimate) -> bool {
    difference.value.abs() > SIGNIFICANT * difference.error
}

/// Scores the stones and takes their differences.
///
/// - `plan`: its effort is that of all runs together
/// - `step`: called after each of the [`RUNS`] runs
///
/// With exact metrics there is one run, and errors of differences are those of both scores together.
/// Checked in `tests/compare.rs`.
pub fn compare(subjects: &[Subject], plan: &Plan, step: &dyn Fn()) -> Comparison {
    let runs = if plan.exact { 1 } else { RUNS };
    let effort = match plan.effort {
        Effort::Samples(n) => Effort::Samples((n / runs).max(1)),
        Effort::Error(e) => Effort::Error(e * (runs as f64).sqrt()),
    };
    let each: Vec<Vec<Row>> = (0..runs)
        .map(|run| {
            let seed = plan.seed.wrapping_mul(RUNS).wrapping_add(run);
            let plan = Plan { seed, effort, ..plan.clone() };
            let rows = subjects.iter().map(|s| score(s, &plan)).collect();
            step();
            rows
        })
        .collect();
    let metrics = plan.metrics.len();
    let mean = |of: &dyn Fn(&[Row]) -> Option<Estimate>| -> Option<Estimate> {
        let values: Vec<Estimate> = each.iter().map(|rows| of(rows)).collect::<Option<_>>()?;
        let first = *values.first()?;
        if values.iter().all(|e| *e == first) {
            return Some(first); // one run, or a closed form
        }
        let n = values.len() as f64;
        let value = values.iter().map(|e| e.value).sum::<f64>() / n;
        let spread = values.iter().map(|e| (e.value - value).powi(2)).sum::<f64>();
        Some(Estimate { value, error: (spread / (n * (n - 1.0))).sqrt() })
    };
    let rows = (0..subjects.len())
        .map(|s| Row {
            scores: (0..metrics).map(|m| mean(&|rows| rows[s].scores[m])).collect(),
            samples: each[0][s].samples.iter().map(|(of, n)| (*of, n * runs)).collect(),
            error: each.iter().find_map(|rows| rows[s].error.clone()),
            ..each[0][s].clone()
        })
        .collect();
    let difference = |s: usize, m: usize| {
        mean(&|rows| {
            let (first, other) = (rows[0].scores[m]?, rows[s].scores[m]?);
            Some(Estimate { value: other.value - first.value, error: other.error.hypot(first.error) })
        })
    };
    let differences = (1..subjects.len()).map(|s| (0..metrics).map(|m| difference(s, m)).collect()).collect();
    Comparison { rows, differences }
}
