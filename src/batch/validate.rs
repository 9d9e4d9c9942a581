//! Validation: published and derivable figures against what this program computes.
//!
//! A [`Figure`] is an expectation with its source; a [`Check`] computes the figures that one run of an
//! estimator gives. The catalogue is [`catalogue`], one file a subject. What does not come out stays
//! in the table, with what explains it.

mod check;
mod context;
mod faceters;
mod facets;
mod figure_rows;
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
pub use figure_rows::{FigureRow, csv};

use crate::progress::Progress;

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

/// Runs the checks, one after the other.
pub fn run(checks: Vec<Check>, context: &CheckContext, progress: &dyn Progress) -> Vec<CheckReport> {
    progress.begin("validating", checks.len() as u64);
    let run = |check: Check| {
        let report = check.run(context);
        progress.advance(1);
        report
    };
    let reports = checks.into_iter().map(run).collect();
    progress.end();
    reports
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
