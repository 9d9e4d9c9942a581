//! A changed stone beside what it was: tiers, proportions, and scores by the same random numbers.

use super::comparison::{self, compare_while};
use super::settings::{ScoreInput, ScoreRequest};
use crate::design::Design;
use crate::design::edit::{BeforeAfter, DesignChanges};
use crate::metrics::Metric;
use crate::progress::Progress;
use crate::sampling::stats::Estimate;
use crate::stone::{Stone, StoneError};
use serde::Serialize;

/// A score before and after a change.
///
/// ```
/// use cutlab::advanced::scoring::edit_report::EditReport;
/// use cutlab::{EditRequest, ScoreRequest, Stone};
///
/// let stone = Stone::parse("classic")?;
/// let change = EditRequest::new(["pavilion.scale=0.8"])?.changes(stone.convex_design()?)?;
/// let mut report = EditReport::new(&stone, &change.0.design, change.1)?;
/// report.score(&ScoreRequest::new(["windowing"]).samples(1 << 12), None, &())?;
/// assert!(report.scores[0].difference.is_some_and(|more| more.value > 0.1));
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone, Serialize)]
pub struct ScoreChange {
    /// The metric, in JSON by its name.
    pub metric: &'static Metric,
    /// The metric's unit.
    pub unit: &'static str,
    /// `more` or `less`, if either is better by itself.
    pub better: Option<&'static str>,
    /// The scores; none where the metric does not apply.
    #[serde(flatten)]
    pub score: BeforeAfter<Option<Estimate>>,
    /// After less before, with the error of the difference.
    pub difference: Option<Estimate>,
    /// Whether the difference is beyond chance and not negligible.
    pub significant: Option<bool>,
    /// Why there is no score.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_out: Option<String>,
}

/// A changed stone beside what it was.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct EditReport {
    /// The stone as it is named.
    pub stone: String,
    /// What it is made of, before and after.
    pub material: String,
    /// Tiers and proportions before and after.
    #[serde(flatten)]
    pub changes: DesignChanges,
    /// The scores, if any were asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub scores: Vec<ScoreChange>,
    /// What is to be said of the scores: an error that was not reached.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
    #[serde(skip)]
    stones: [Stone; 2],
}

/// The work was ended early by [`Progress::is_cancelled`], or a stone cannot be scored.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EditScoreError {
    /// A stone that is not convex any more, or a size that cannot be.
    #[error(transparent)]
    Stone(#[from] StoneError),
    /// Ended early.
    #[error("cancelled")]
    Cancelled,
}

impl EditReport {
    /// A report without scores.
    ///
    /// - `before`: of the material that both are scored in
    /// - `after`: the changed design
    pub fn new(before: &Stone, after: &Design, changes: DesignChanges) -> Result<EditReport, StoneError> {
        Ok(EditReport {
            stone: before.name().into(),
            material: before.material().name.to_string(),
            changes,
            scores: Vec::new(),
            warnings: Vec::new(),
            stones: [before.clone(), before.clone().with_design(after.clone())?],
        })
    }

    /// The changed stone.
    pub fn stone_after(&self) -> &Stone {
        &self.stones[1]
    }

    /// Scores both stones with the same random numbers.
    ///
    /// - `width_mm`: of both; none for each stone's own, or where it has none the usual one
    pub fn score(
        &mut self,
        plan: &ScoreRequest,
        width_mm: Option<f64>,
        progress: &dyn Progress,
    ) -> Result<(), EditScoreError> {
        let mut inputs = Vec::new();
        for stone in &self.stones {
            let stone = match width_mm {
                Some(mm) => stone.clone().with_width(mm)?,
                None => stone.clone().convex_in_mm()?,
            };
            inputs.push(ScoreInput::from_stone(&stone, None));
        }
        progress.begin("comparing", comparison::runs(plan));
        let compared = compare_while(&inputs, plan, &|| {
            progress.advance(1);
            !progress.is_cancelled()
        });
        progress.end();
        let compared = compared.ok_or(EditScoreError::Cancelled)?;
        let change = |(m, metric): (usize, &&'static Metric)| ScoreChange {
            metric,
            unit: metric.unit,
            better: Some(metric.better.word()).filter(|word| !word.is_empty()),
            score: BeforeAfter::new(compared.rows[0].scores[m], compared.rows[1].scores[m]),
            difference: compared.differences[0][m],
            significant: compared.is_significant(0, m),
            left_out: compared.rows.iter().find_map(|row| Some(row.why_left_out(metric)?.to_owned())),
        };
        self.scores = plan.metrics.iter().enumerate().map(change).collect();
        self.warnings = compared.rows.iter().filter_map(|row| row.error.clone()).collect();
        self.warnings.dedup();
        Ok(())
    }
}
