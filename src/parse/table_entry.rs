//! Tables in data files of materials and illuminants: their rows, from the file itself or from one beside it.

use super::data_file::ValueProblem;
use super::spectral_table::{SpectrumEntry, SpectrumLayout, SpectrumRow, from_pairs, from_text};

/// A table of the visible covers at least this, nm: beyond it the eye sees a thousandth of all light.
const COVERED_NM: (f64, f64) = (400.0, 700.0);

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

/// As [`read_rows`], of a table that covers the visible.
pub fn read_visible_rows(
    table: &SpectrumEntry,
    layout: SpectrumLayout,
    tables: TableReader,
) -> Result<Vec<SpectrumRow>, ValueProblem> {
    let rows = read_rows(table, layout, tables)?;
    let (first, last) = (rows[0].nm, rows[rows.len() - 1].nm);
    if first > COVERED_NM.0 || last < COVERED_NM.1 {
        let expected = format!("a table from {} to {} nm or more", COVERED_NM.0, COVERED_NM.1);
        return Err(ValueProblem::new("table", expected, format!("{first} to {last} nm")));
    }
    Ok(rows)
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
