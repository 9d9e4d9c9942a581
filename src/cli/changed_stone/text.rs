//! Tiers, proportions and scores before and after, for people.

use crate::cli::terminal_table::{self, NONE, format_estimate};
use crate::design::edit::{BeforeAfter, MeasureChange, TierChange, TierState};
use crate::parse::format_number;
use crate::report::estimates::plus;
use crate::sampling::stats::Estimate;
use crate::scoring::edit_report::{EditReport, ScoreChange};
use crate::storage::terminal::in_line;

/// A report, written for people.
pub struct ChangedText<'a> {
    report: &'a EditReport,
    /// Lines above the tables.
    pub head: Vec<String>,
}

impl ChangedText<'_> {
    /// Of a report.
    pub fn new(report: &EditReport) -> ChangedText<'_> {
        ChangedText { report, head: Vec::new() }
    }

    /// What is to be said of the scores.
    pub fn warnings(&self) -> &[String] {
        &self.report.warnings
    }

    /// The tables.
    pub fn text(&self) -> String {
        let report = self.report;
        let mut text = format!("{} ({})\n", in_line(&report.stone), report.material);
        self.head.iter().for_each(|line| text += &format!("{line}\n"));
        text += &table(&["tier", "", "facets", "angle", "depth", ""], report.changes.tiers.iter().map(tier));
        let followed = report.changes.followed();
        if !followed.is_empty() {
            text += &format!("{} followed, so that what met still meets\n", followed.join(", "));
        }
        if report.changes.is_outline_changed {
            text += "the outline changed, so that what met still meets\n";
        }
        if report.changes.is_empty() {
            text += "nothing changed\n";
        }
        text += &format!(
            "\n{}",
            table(&["", "before", "after", ""], report.changes.measures.iter().map(measure))
        );
        if !report.scores.is_empty() {
            let head = ["", "before", "after", "difference", "unit", "better", ""];
            text += &format!("\n{}", table(&head, report.scores.iter().map(score)));
            for change in &report.scores {
                if let Some(why) = &change.left_out {
                    text += &format!("{} left out: {why}\n", change.metric.name);
                }
            }
            text += "after ± one standard error; significant: beyond three errors of the difference, and not \
                     negligible\n";
        }
        text
    }
}

fn table(head: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let mut table = terminal_table::new();
    table.set_header(head.iter().copied());
    table.add_rows(rows);
    terminal_table::lines(&table)
}

/// A value, or both where they are shown differently.
fn both(before: Option<String>, after: Option<String>) -> String {
    let shown = |value: &Option<String>| value.clone().unwrap_or_else(|| NONE.into());
    if before == after { shown(&before) } else { format!("{} → {}", shown(&before), shown(&after)) }
}

fn tier(tier: &TierChange) -> Vec<String> {
    let BeforeAfter { before, after } = tier.state;
    let each = |of: fn(&TierState) -> String| both(before.as_ref().map(of), after.as_ref().map(of));
    let depth = |s: &TierState| match s.most_depth_percent - s.depth_percent > 0.005 {
        true => format!("{:.2}–{:.2} %", s.depth_percent, s.most_depth_percent),
        false => format!("{:.2} %", s.depth_percent),
    };
    let mut said = Vec::new();
    if tier.index_shift != 0.0 {
        let sign = if tier.index_shift > 0.0 { "+" } else { "" };
        said.push(format!("index {sign}{}", format_number(tier.index_shift)));
    }
    if tier.followed {
        said.push("followed".into());
    }
    match (before, after) {
        (None, Some(_)) => said.push("new".into()),
        (Some(_), None) => said.push("gone".into()),
        _ => {}
    }
    vec![
        format!("{}{}", tier.place, if tier.is_changed() { " *" } else { "" }),
        in_line(&tier.name),
        each(|s| s.facets.to_string()),
        each(|s| format!("{:.2}°", s.angle_deg)),
        each(depth),
        said.join(", "),
    ]
}

fn measure(measure: &MeasureChange) -> Vec<String> {
    let decimals = if measure.unit.is_empty() { 4 } else { 2 };
    let shown = |value: Option<f64>| value.map_or_else(|| NONE.into(), |v| format!("{v:.decimals$}"));
    let BeforeAfter { before, after } = measure.value;
    let after = if measure.is_changed() { format!("{} *", shown(after)) } else { shown(after) };
    vec![measure.name.into(), shown(before), after, measure.unit.into()]
}

fn score(change: &ScoreChange) -> Vec<String> {
    let shown = |e: Option<Estimate>| e.map_or_else(|| NONE.into(), format_estimate);
    let difference = change.difference;
    let said = match change.significant {
        Some(true) => "significant",
        Some(false) => "not significant",
        None => "",
    };
    vec![
        change.metric.name.into(),
        shown(change.score.before),
        shown(change.score.after),
        format!("{}{}", difference.map_or("", plus), shown(difference)),
        change.unit.into(),
        change.better.unwrap_or_default().into(),
        said.into(),
    ]
}
