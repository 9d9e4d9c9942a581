//! Tables of material files: their rows, from the file itself or from one beside it.

use crate::parse::data_file::ValueProblem;
use crate::parse::spectral_table::{TableEntry, TableLayout, TableRow, from_pairs, from_text};

/// Reads the text of the table that a data file names, or says why it cannot be read.
pub type TableReader<'a> = &'a dyn Fn(&str) -> Result<String, String>;

/// The rows of a table, by rising wavelength.
pub fn read_rows(
    table: &TableEntry,
    layout: TableLayout,
    tables: TableReader,
) -> Result<Vec<TableRow>, ValueProblem> {
    let rows = match table {
        TableEntry::Rows(_) if layout.columns.is_some() => {
            return Err(ValueProblem::new("columns", "a table in a file beside it", "rows of two"));
        }
        TableEntry::Rows(pairs) => from_pairs(pairs, layout.wavelength),
        TableEntry::File(name) => {
            let text = tables(name).map_err(|why| {
                ValueProblem::new(
                    "table",
                    "a table beside the file",
                    format!("'{}': {why}", name.escape_debug()),
                )
            })?;
            from_text(&text, layout)
        }
    };
    rows.map_err(|e| at(table, e.line, e.expected, e.found))
}

/// What is wrong with a row of a table.
///
/// - `line`: of the file, or the row's number in a list
pub fn at(table: &TableEntry, line: usize, expected: impl Into<String>, found: String) -> ValueProblem {
    let place = match table {
        TableEntry::Rows(_) => format!("row {line}"),
        TableEntry::File(name) => format!("line {line} of {}", name.escape_debug()),
    };
    ValueProblem::new("table", expected, format!("{found} in {place}"))
}
