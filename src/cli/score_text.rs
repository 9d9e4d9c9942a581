//! A table of scores for a terminal.

use super::terminal_table::{NONE, format_estimate, lines, new};
use crate::batch::table::NumericColumns;
use crate::metrics::Metric;
use crate::sampling::stats::Estimate;
use crate::storage::terminal::in_line;

/// The column of what went wrong.
const ERROR: &str = "error";

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
