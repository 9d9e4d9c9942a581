//! Validation: published and derivable figures against what this program computes.
//!
//! A [`Figure`] is an expectation with its source; a [`Check`] computes the figures that one run of an
//! estimator gives. The catalogue is [`catalogue`], one file a subject. What does not come out stays
//! in the table, with what explains it.

mod check;
mod context;
mod faceters;
mod facets;
pub mod figures;
mod fire;
mod geometry;
mod indices;
mod returns;
pub mod stones;

pub use check::{
    Axes, Check, CheckReport, ERRORS, Expected, Figure, FigureOutcome, FigureSource, SourceKind, Verdict,
};
use check::{Measured, TRACER};
pub use context::{CheckContext, CheckError};

use super::table::TableError;

/// Every check, in the order of the table.
pub fn catalogue() -> Vec<Check> {
    let chapters =
        [geometry::checks(), indices::checks(), facets::checks(), returns::checks(), faceters::checks()];
    chapters.into_iter().flatten().chain(fire::checks()).collect()
}

/// The checks with a figure whose subject or name has `part` in it, in any case; figures that are
/// computed together stay together.
pub fn only(checks: Vec<Check>, part: &str) -> Vec<Check> {
    let part = part.to_lowercase();
    let has = |text: &str| text.to_lowercase().contains(&part);
    let keeps = |t: &Check| has(t.subject) || t.figures.iter().any(|f| has(&f.name));
    checks.into_iter().filter(keeps).collect()
}

/// The columns of the table.
const COLUMNS: [&str; 11] = [
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
];

/// The table as CSV, the last column `why`.
pub fn csv<'a>(outcomes: impl Iterator<Item = &'a FigureOutcome>) -> Result<Vec<u8>, TableError> {
    let fail = |e: csv::Error| TableError::Row(e.to_string());
    let mut table = csv::Writer::from_writer(Vec::new());
    table.write_record(COLUMNS.iter().chain(&["why"])).map_err(fail)?;
    for o in outcomes {
        let f = &o.figure;
        let number = |x: Option<f64>| x.map_or(String::new(), |x| format!("{}", (x * 1e9).round() / 1e9));
        let [kind, verdict] = [f.source.kind.to_string(), o.verdict.to_string()];
        let [expected, tolerance] = [Some(f.expected.value()), f.expected.tolerance()].map(exactly);
        let [ours, error] = [o.ours.map(|e| e.value), o.ours.map(|e| e.error)].map(number);
        table
            .write_record([
                o.subject,
                &f.name,
                f.source.name,
                &kind,
                f.expected.relation(),
                &expected,
                &tolerance,
                f.unit,
                &ours,
                &error,
                &verdict,
                &o.why,
            ])
            .map_err(fail)?;
    }
    table.into_inner().map_err(|e| TableError::Row(e.to_string()))
}

/// A number of the catalogue as it is written there.
fn exactly(x: Option<f64>) -> String {
    x.map_or(String::new(), |x| if x != 0.0 && x.abs() < 1e-4 { format!("{x:e}") } else { format!("{x}") })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::stats::Estimate;

    #[test]
    fn tolerance_and_three_errors_decide() {
        let is_met = |expected: Expected, value, error| expected.is_met(Estimate { value, error });
        assert!(is_met(Expected::Near(1.0, 0.1), 1.1 - 1e-9, 0.0));
        assert!(!is_met(Expected::Near(1.0, 0.1), 1.11, 0.0));
        assert!(
            is_met(Expected::Near(1.0, 0.1), 1.12, 0.01) && !is_met(Expected::Near(1.0, 0.1), 1.14, 0.01)
        );
        assert!(is_met(Expected::Above(0.0), 0.1, 0.03) && !is_met(Expected::Above(0.0), 0.1, 0.04));
        assert!(is_met(Expected::Below(0.0), -0.1, 0.03) && !is_met(Expected::Below(0.0), 0.0, 0.0));
        assert!(!is_met(Expected::Near(1.0, 0.1), f64::NAN, 0.0));
    }

    #[test]
    fn figures_have_names_of_their_own() {
        let checks = catalogue();
        let names: Vec<_> =
            checks.iter().flat_map(|t| t.figures.iter().map(|f| (t.subject, f.name.clone()))).collect();
        for (i, name) in names.iter().enumerate() {
            assert!(!names[..i].contains(name), "{name:?} twice");
        }
        assert!(checks.iter().all(|t| t.plot.is_some() == t.figures.iter().any(|f| f.at.is_some())));
    }
}
