//! A comparison as `--json` prints it.

use crate::batch::comparison::StoneComparison;
use crate::metrics::Metric;
use crate::sampling::stats::Estimate;
use crate::scoring::score::ScoreRow;
use serde::Serialize;

/// One metric of all stones.
#[derive(Serialize)]
pub struct MetricEntry<'a> {
    metric: &'static str,
    unit: &'static str,
    /// `more` or `less`, if either is better by itself.
    better: Option<&'static str>,
    /// Differences up to this are never significant.
    negligible: f64,
    scores: Vec<Scored<'a>>,
    differences: Vec<Differs<'a>>,
}

#[derive(Serialize)]
struct Scored<'a> {
    stone: &'a str,
    material: &'a str,
    #[serde(flatten)]
    score: Option<Estimate>,
    /// Why there is no score.
    #[serde(skip_serializing_if = "Option::is_none")]
    left_out: Option<&'a str>,
}

#[derive(Serialize)]
struct Differs<'a> {
    stone: &'a str,
    from: &'a str,
    #[serde(flatten)]
    difference: Option<Estimate>,
    significant: Option<bool>,
}

/// An entry for each metric.
pub fn of(compared: &StoneComparison) -> Vec<MetricEntry<'_>> {
    compared.scores().metrics.iter().enumerate().map(|(m, metric)| entry(compared, m, metric)).collect()
}

fn entry<'a>(compared: &'a StoneComparison, m: usize, metric: &'static Metric) -> MetricEntry<'a> {
    let comparison = &compared.comparison;
    let rows = &comparison.rows;
    let scored = |row: &'a ScoreRow| Scored {
        stone: &row.stone,
        material: &row.material,
        score: row.scores[m],
        left_out: row.why_left_out(metric),
    };
    let differs = |(other, row): (usize, &'a ScoreRow)| Differs {
        stone: &row.stone,
        from: &rows[0].stone,
        difference: comparison.differences[other][m],
        significant: comparison.is_significant(other, m),
    };
    MetricEntry {
        metric: metric.name,
        unit: metric.unit,
        better: Some(metric.better.word()).filter(|word| !word.is_empty()),
        negligible: comparison.negligible[m],
        scores: rows.iter().map(scored).collect(),
        differences: rows[1..].iter().enumerate().map(differs).collect(),
    }
}
