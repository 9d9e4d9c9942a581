//! Tables for a terminal: of labels with their texts, of anything in columns.

use crate::sampling::stats::Estimate;
use comfy_table::presets::NOTHING;
use comfy_table::{CellAlignment, ColumnConstraint, Table, Width};

/// Stands where there is no score.
pub const NONE: &str = "–";

/// A score with its standard error.
pub fn format_estimate(estimate: Estimate) -> String {
    match Estimate::text(estimate) {
        (value, Some(error)) => format!("{value} ± {error}"),
        (value, None) => value,
    }
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
