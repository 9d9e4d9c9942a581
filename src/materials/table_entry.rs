//! Tables of material files: their rows, from the file itself or from one beside it.

use crate::parse::data_file::ValueProblem;
use crate::parse::spectral_table::{SpectrumEntry, SpectrumLayout, SpectrumRow, from_pairs, from_text};

/// Reads the text of the table that a data file names, or says why it cannot be read.
pub type TableReader<'a> = &'a dyn Fn(&str) -> Result<String, String>;

/// The rows of a table, by rising wavelength.
pub fn read_rows(
    table: &SpectrumEntry,
    layout: SpectrumLayout,
    tables: TableReader,
) -> Result<Vec<SpectrumRow>, ValueProblem> {
    let rows = match table {
        SpectrumEntry::Rows(_) if layout.columns.is_some() => {
            return Err(ValueProblem::new("columns", "a table in a file beside it", "rows of two"));
        }
        SpectrumEntry::Rows(pairs) => from_pairs(pairs, layout.wavelength),
        SpectrumEntry::File(name) => {
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
pub fn at(table: &SpectrumEntry, line: usize, expected: impl Into<String>, found: String) -> ValueProblem {
    let place = match table {
        SpectrumEntry::Rows(_) => format!("row {line}"),
        SpectrumEntry::File(name) => format!("line {line} of {}", name.escape_debug()),
    };
    ValueProblem::new("table", expected, format!("{found} in {place}"))
}
