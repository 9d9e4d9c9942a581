//! The table of a validation: a row for each figure.

use super::FigureOutcome;
use crate::batch::table::TableError;
use serde::Serialize;

/// The columns of the table.
const COLUMNS: [&str; 12] = [
    "subject",
    "figure",
    "source",
    "kind",
    "relation",
    "expected",
    "tolerance",
    "unit",
    "ours",
    "ours_se",
    "verdict",
    "why",
];

/// A figure: what was expected, and what came out.
#[derive(Debug, Serialize)]
pub struct FigureRow<'a> {
    /// What it is about.
    pub subject: &'a str,
    /// Its name.
    pub figure: &'a str,
    /// Where the expectation is from.
    pub source: &'a str,
    /// Kind of the source.
    pub kind: String,
    /// How ours is to compare with what is expected.
    pub relation: &'a str,
    /// What is expected.
    pub expected: f64,
    /// How far ours may be off; none of a bound.
    pub tolerance: Option<f64>,
    /// Unit of the numbers.
    pub unit: &'a str,
    /// What came out; none if nothing could be computed.
    pub ours: Option<f64>,
    /// Its standard error.
    pub ours_se: Option<f64>,
    /// Whether it passes.
    pub verdict: String,
    /// What explains a figure that does not.
    pub why: &'a str,
}

impl<'a> FigureRow<'a> {
    /// Of what a check gave.
    pub fn new(outcome: &'a FigureOutcome) -> FigureRow<'a> {
        let figure = &outcome.figure;
        FigureRow {
            subject: outcome.subject,
            figure: &figure.name,
            source: figure.source.name,
            kind: figure.source.kind.to_string(),
            relation: figure.expected.relation(),
            expected: figure.expected.value(),
            tolerance: figure.expected.tolerance(),
            unit: figure.unit,
            ours: outcome.ours.map(|e| e.value),
            ours_se: outcome.ours.map(|e| e.error),
            verdict: outcome.verdict.to_string(),
            why: &outcome.why,
        }
    }
}

/// The table as CSV.
pub fn csv<'a>(outcomes: impl Iterator<Item = &'a FigureOutcome>) -> Result<Vec<u8>, TableError> {
    let fail = |e: csv::Error| TableError::Row(e.to_string());
    let mut table = csv::Writer::from_writer(Vec::new());
    table.write_record(COLUMNS).map_err(fail)?;
    for row in outcomes.map(FigureRow::new) {
        let number = |x: Option<f64>| x.map_or(String::new(), |x| format!("{}", (x * 1e9).round() / 1e9));
        let [expected, tolerance] = [Some(row.expected), row.tolerance].map(exactly);
        let [ours, error] = [row.ours, row.ours_se].map(number);
        table
            .write_record([
                row.subject,
                row.figure,
                row.source,
                &row.kind,
                row.relation,
                &expected,
                &tolerance,
                row.unit,
                &ours,
                &error,
                &row.verdict,
                row.why,
            ])
            .map_err(fail)?;
    }
    table.into_inner().map_err(|e| TableError::Row(e.to_string()))
}

/// A number of the catalogue as it is written there.
fn exactly(x: Option<f64>) -> String {
    x.map_or(String::new(), |x| if x != 0.0 && x.abs() < 1e-4 { format!("{x:e}") } else { format!("{x}") })
}
