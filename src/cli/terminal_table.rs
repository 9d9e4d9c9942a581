//! Tables for a terminal: of scores, of labels with their texts, of anything in columns.

use crate::batch::table::NumericColumns;
use crate::metrics::Metric;
use crate::sampling::stats::Estimate;
use crate::storage::terminal::in_line;
use comfy_table::presets::NOTHING;
use comfy_table::{CellAlignment, ColumnConstraint, Table, Width};

/// Tables of up to so many rows have a line for each metric, else a line for each row.
const MOST_COLUMNS: usize = 4;

/// The table as text.
///
/// - `columns`: of the table, as [`crate::batch::table::columns`] made them
///
/// Few stones have a column each and a line for each metric, with its unit; many have a line each.
pub fn text(columns: &[String], table: &NumericColumns, metrics: &[&'static Metric]) -> String {
    let is_score = |column: &String| {
        let name = column.strip_suffix("_se").unwrap_or(column);
        column == ERROR || metrics.iter().any(|m| m.name == name)
    };
    let leading: Vec<&String> = columns.iter().filter(|c| !is_score(c)).collect();
    let rows = table.texts(ERROR).len();
    let score = |metric: &Metric, row: usize| {
        let cell = |name: &str| table.column(name).get(row).copied().flatten();
        let estimate = Estimate { value: cell(metric.name)?, error: cell(&format!("{}_se", metric.name))? };
        Some(format_estimate(estimate))
    };
    let mut text = new();
    let lead = |column: &str, row: usize| in_line(&table.texts(column).get(row).cloned().unwrap_or_default());
    if rows <= MOST_COLUMNS {
        for column in leading {
            let cells = (0..rows).map(|row| lead(column, row));
            text.add_row([column.clone()].into_iter().chain(cells));
        }
        for metric in metrics {
            let cells = (0..rows).map(|row| score(metric, row).unwrap_or_else(|| NONE.into()));
            text.add_row([metric.name.to_owned()].into_iter().chain(cells).chain([metric.unit.to_owned()]));
        }
    } else {
        text.set_header(
            leading.iter().map(|c| c.to_string()).chain(metrics.iter().map(|m| m.name.to_owned())),
        );
        for row in 0..rows {
            let cells = metrics.iter().map(|metric| score(metric, row).unwrap_or_else(|| NONE.into()));
            text.add_row(leading.iter().map(|column| lead(column, row)).chain(cells));
        }
    }
    lines(&text) + "after ± one standard error\n"
}

/// The column of what went wrong.
const ERROR: &str = "error";

/// Stands where there is no score.
pub const NONE: &str = "–";

/// A score with its standard error.
pub fn format_estimate(estimate: Estimate) -> String {
    estimate.to_string()
}

/// An empty table without lines.
pub fn new() -> Table {
    let mut table = Table::new();
    table.load_style(NOTHING);
    table
}

/// A table's lines; columns to the left but for cells that ask otherwise, none padded at its end.
pub fn lines(table: &Table) -> String {
    indented(table, 0)
}

/// As [`lines`], further in.
///
/// - `indent`: columns left of the table
fn indented(table: &Table, indent: usize) -> String {
    let mut table = table.clone();
    for column in table.column_iter_mut() {
        column.set_padding((0, GAP));
        column.set_cell_alignment(CellAlignment::Left);
    }
    table.lines().map(|line| format!("{}\n", format!("{:indent$}{line}", "").trim_end())).collect()
}

/// Columns between two cells.
const GAP: u16 = 2;

/// Labels with their texts, a line each or as many as the text has.
///
/// - `indent`: columns left of the labels
/// - `least`: columns that the labels take at least, so that several lists line up
pub fn labelled<L: Into<String>>(
    rows: impl IntoIterator<Item = (L, String)>,
    indent: usize,
    least: u16,
) -> String {
    let mut table = new();
    table.add_rows(rows.into_iter().map(|(label, text)| [label.into(), text]));
    if let Some(labels) = table.column_mut(0) {
        labels.set_constraint(ColumnConstraint::LowerBoundary(Width::Fixed(least + GAP)));
    }
    indented(&table, indent)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_stand_beside_their_texts() {
        let rows =
            || [("a", "one\ntwo".to_owned()), ("longer", "  three ".to_owned()), ("", "four".to_owned())];
        assert_eq!(labelled(rows(), 1, 0), " a       one\n         two\n longer    three\n         four\n");
        let wide = labelled(rows(), 0, 9);
        assert!(
            wide.lines()
                .all(|line| line.find(char::is_alphabetic) == Some(0) || line[..11].trim().is_empty())
        );
        assert_eq!(wide.lines().next(), Some("a          one"));
    }
}
