//! The table of a validation for people.

use crate::batch::validate::{CheckReport, Verdict};
use crate::cli::terminal_table;
use crate::report::validation::{self, count, expectation, written};

/// The table for people; under it what explains the figures that did not come out.
pub fn text(reports: &[CheckReport]) -> String {
    let outcomes = || reports.iter().flat_map(|r| &r.outcomes);
    let mut table = terminal_table::new();
    table.set_header(["figure", "kind", "expected", "ours", "", "verdict", "source"]);
    table.add_rows(outcomes().map(|o| {
        let ours = o.ours.map_or("–".into(), |e| written(e, o.figure.expected.tolerance()));
        let f = &o.figure;
        [
            f.name.clone(),
            f.source.kind.to_string(),
            expectation(f),
            ours,
            f.unit.into(),
            o.verdict.to_string(),
            f.source.name.into(),
        ]
    }));
    let mut out = terminal_table::lines(&table);
    out += "\n";
    for o in outcomes().filter(|o| o.verdict == Verdict::Failed && !o.why.is_empty()) {
        out += &format!("{}: {}\n", o.figure.name, o.why);
    }
    let mut skipped: Vec<&str> =
        outcomes().filter(|o| o.verdict == Verdict::Skipped).map(|o| o.why.as_str()).collect();
    skipped.dedup();
    skipped.iter().for_each(|why| out += &format!("skipped: {why}\n"));
    let [passed, failed, skipped] =
        [Verdict::Passed, Verdict::Failed, Verdict::Skipped].map(|v| count(reports, v));
    out + &format!("{passed} passed, {failed} failed, {skipped} skipped\n{}\n", validation::rule())
}
