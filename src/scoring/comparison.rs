//! Stones against each other: the same random numbers for all, differences with errors of their own.

use super::score::{ScoreInput, ScoreRequest, ScoreRow, Target, score};
use crate::metrics::{Metric, MetricSource, Statistic};
use crate::sampling::stats::Estimate;
use std::borrow::Cow;

/// Short runs that a comparison is made of. Each has other random numbers, the same for every
/// stone, so the spread of the differences is an honest error of them, and smaller than the errors
/// of the two scores together where the stones are alike.
pub const RUNS: u64 = 32;

/// Beyond so many standard errors a difference is called significant: of differences that are none,
/// 1 in 190 is (Student's t with 31 degrees of freedom).
pub const SIGNIFICANT: f64 = 3.0;

/// A closed form or a sum of beams decides about differences larger than this times the metric's scale:
/// a millionth, as files with seven digits hold a stone's planes.
const OF_STORAGE: f64 = 1e-6;

/// Photons decide about differences larger than this times the metric's scale: a ray is followed until
/// it has 1e-4 of its light, and what is given up is never more.
const OF_TRACING: f64 = 1e-4;

/// The scores of several stones.
///
/// ```
/// use cutlab::advanced::scoring::ScoreInput;
/// use cutlab::advanced::scoring::comparison::compare;
/// use cutlab::{Comparison, ScoreRequest, Stone};
///
/// let stones = [Stone::parse("tolkowsky")?, Stone::parse("cube")?];
/// let inputs = stones.map(|stone| ScoreInput::from_stone(&stone, None));
/// let comparison: Comparison = compare(&inputs, &ScoreRequest::new(["leakage"]).samples(1 << 14), &|| ());
/// assert!(comparison.differences[0][0].is_some_and(|of_cube| of_cube.value > 0.3));
/// assert_eq!(comparison.is_significant(0, 0), Some(true));
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Comparison {
    /// One a stone: name, material and facets are of it; the scores are means over the runs.
    pub rows: Vec<ScoreRow>,
    /// For each stone but the first, one a metric: its score less the first stone's.
    pub differences: Vec<Vec<Option<Estimate>>>,
    /// One a metric: smaller differences are never significant ([`negligible`]).
    pub negligible: Vec<f64>,
}

impl Comparison {
    /// Whether the difference between a stone and the first in a metric is significant, both by number:
    /// beyond [`SIGNIFICANT`] of its errors, and not negligible. None if there is no difference.
    ///
    /// - `other`: from 0, without the first stone
    pub fn is_significant(&self, other: usize, metric: usize) -> Option<bool> {
        let difference = self.differences[other][metric]?;
        Some(is_significant(difference, self.negligible[metric]))
    }
}

/// Whether a difference is beyond chance, and beyond what is negligible.
pub fn is_significant(difference: Estimate, negligible: f64) -> bool {
    difference.value.abs() > negligible.max(SIGNIFICANT * difference.error)
}

/// Differences of this metric that say nothing of the stones: those that come of the digits in which a
/// stone is stored, and, where photons are traced, of the light that they give up.
pub fn negligible(metric: &Metric, plan: &ScoreRequest) -> f64 {
    let closed = matches!(metric.read_from, MetricSource::Solid(_)) || (plan.exact && metric.by_beams);
    metric.scale * negligible_part(closed)
}

/// The part of a metric's scale below which differences say nothing of the stones.
///
/// - `closed`: whether it is a closed form or a sum of beams
pub(super) fn negligible_part(closed: bool) -> f64 {
    if closed { OF_STORAGE } else { OF_TRACING }
}

/// Whether the mean of short runs is not what a long one gives: a median that jumps from peak to peak.
fn is_for_long_runs(metric: &Metric) -> bool {
    matches!(metric.read_from, MetricSource::Sums(Statistic::Median(_)))
}

/// Scores the stones and takes their differences.
///
/// - `plan`: its effort is that of all runs together
/// - `step`: called after each of the [`RUNS`] runs
///
/// With exact metrics there is one run, and errors of differences are those of both scores together; so
/// it is for medians, which have a run of their own. Checked in `tests/program/compare.rs`.
pub fn compare(subjects: &[ScoreInput], plan: &ScoreRequest, step: &dyn Fn()) -> Comparison {
    let each = runs_while(subjects, plan, &|| {
        step();
        true
    });
    together(subjects, plan, &each)
}

/// As [`compare`], for work that may be ended early; none if it was.
///
/// - `goes_on`: called after each run; whether there is to be another
pub fn compare_while(
    subjects: &[ScoreInput],
    plan: &ScoreRequest,
    goes_on: &dyn Fn() -> bool,
) -> Option<Comparison> {
    let each = runs_while(subjects, plan, goes_on);
    (each.len() as u64 == runs(plan)).then(|| together(subjects, plan, &each))
}

/// How many runs a comparison has.
pub fn runs(plan: &ScoreRequest) -> u64 {
    if plan.exact { 1 } else { RUNS }
}

/// The metrics of the one long run, and those of the short ones.
fn long_and_short(plan: &ScoreRequest) -> (Vec<&'static Metric>, Vec<&'static Metric>) {
    plan.metrics.iter().copied().partition(|m| !plan.exact && is_for_long_runs(m))
}

fn scores_of_all(subjects: &[ScoreInput], plan: ScoreRequest) -> Vec<ScoreRow> {
    subjects.iter().map(|s| score(s, &plan)).collect()
}

/// The short runs, up to the one after which `goes_on` says no.
fn runs_while(
    subjects: &[ScoreInput],
    plan: &ScoreRequest,
    goes_on: &dyn Fn() -> bool,
) -> Vec<Vec<ScoreRow>> {
    let runs = runs(plan);
    let effort = match plan.target {
        Target::Samples(n) => Target::Samples((n / runs).max(1)),
        Target::Error(e) => Target::Error(e * (runs as f64).sqrt()),
    };
    let (_, metrics) = long_and_short(plan);
    let mut each = Vec::new();
    for run in 0..runs {
        let seed = plan.seed.wrapping_mul(RUNS).wrapping_add(run);
        let run = ScoreRequest { seed, target: effort, metrics: metrics.clone(), ..plan.clone() };
        each.push(scores_of_all(subjects, run));
        if !goes_on() {
            break;
        }
    }
    each
}

/// The scores and differences of all runs.
fn together(subjects: &[ScoreInput], plan: &ScoreRequest, each: &[Vec<ScoreRow>]) -> Comparison {
    let runs = each.len() as u64;
    let (long, short) = long_and_short(plan);
    let once = [scores_of_all(subjects, ScoreRequest { metrics: long.clone(), ..plan.clone() })];
    // where a metric's runs are, and its column there
    let place = |m: &Metric| {
        let (metrics, runs) =
            if long.iter().any(|l| l.name == m.name) { (&long, &once[..]) } else { (&short, each) };
        (runs, metrics.iter().position(|o| o.name == m.name).unwrap_or_default())
    };
    let mean = |runs: &[Vec<ScoreRow>], of: &dyn Fn(&[ScoreRow]) -> Option<Estimate>| -> Option<Estimate> {
        let values: Vec<Estimate> = runs.iter().map(|rows| of(rows)).collect::<Option<_>>()?;
        let first = *values.first()?;
        if values.iter().all(|e| *e == first) {
            return Some(first); // one run, or a closed form
        }
        let n = values.len() as f64;
        let value = values.iter().map(|e| e.value).sum::<f64>() / n;
        let spread = values.iter().map(|e| (e.value - value).powi(2)).sum::<f64>();
        Some(Estimate { value, error: (spread / (n * (n - 1.0))).sqrt() })
    };
    let metrics = || plan.metrics.iter().map(|m| place(m));
    let row = |s: usize| {
        let samples = each[0][s].samples.iter().map(|(of, n)| (*of, n * runs));
        let every = || each.iter().chain(&once).map(|rows| &rows[s]);
        ScoreRow {
            scores: metrics().map(|(runs, m)| mean(runs, &|rows| rows[s].scores[m])).collect(),
            samples: samples.chain(once[0][s].samples.iter().copied()).collect(),
            error: every().find_map(|row| row.error.clone()),
            left_out: left_out(every(), &plan.metrics),
            ..each[0][s].clone()
        }
    };
    let difference = |s: usize, (runs, m): (&[Vec<ScoreRow>], usize)| {
        mean(runs, &|rows| {
            let (first, other) = (rows[0].scores[m]?, rows[s].scores[m]?);
            Some(Estimate { value: other.value - first.value, error: other.error.hypot(first.error) })
        })
    };
    Comparison {
        rows: (0..subjects.len()).map(row).collect(),
        differences: (1..subjects.len()).map(|s| metrics().map(|at| difference(s, at)).collect()).collect(),
        negligible: plan.metrics.iter().map(|m| negligible(m, plan)).collect(),
    }
}

/// What any of the runs leaves out, each metric once.
fn left_out<'a>(
    rows: impl Iterator<Item = &'a ScoreRow> + Clone,
    metrics: &[&Metric],
) -> Vec<(&'static str, Cow<'static, str>)> {
    let why = |m: &&Metric| {
        let said = rows.clone().find_map(|row| row.why_left_out(m))?;
        Some((m.name, said.to_owned().into()))
    };
    metrics.iter().filter_map(why).collect()
}
