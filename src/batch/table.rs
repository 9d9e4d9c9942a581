//! Tables of scores: one row a line, as CSV or JSON.

use crate::limits::{self, Limits};
use crate::metrics::Metric;
use crate::scoring::score::ScoreRow;
use crate::storage::text;
use serde::ser::{SerializeMap, Serializer};
use std::collections::BTreeMap;
use std::io::{BufRead, Read};
use std::path::Path;

/// A number of a table: a fraction or degrees to 1e-9, far below any error. A zero has no sign.
pub(super) fn rounded(x: f64) -> f64 {
    (x * 1e9).round() / 1e9 + 0.0
}

/// How a table is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TableFormat {
    /// Comma-separated values with a header.
    Csv,
    /// One JSON object a line, keyed by column.
    JsonLines,
    /// One JSON array of such objects, one a line.
    Json,
}

/// Extensions of table files, with their forms.
const EXTENSIONS: [(&str, TableFormat); 4] = [
    ("csv", TableFormat::Csv),
    ("jsonl", TableFormat::JsonLines),
    ("ndjson", TableFormat::JsonLines),
    ("json", TableFormat::Json),
];

/// A table that could not be put into bytes, or a file name that says not how.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    /// A row that the form cannot hold.
    #[error("cannot write the table: {0}")]
    Row(String),
    /// A file extension without a form.
    #[error("'{0}': a table's extension is .csv, .jsonl, .ndjson or .json")]
    Ending(String),
}

/// One cell.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
#[serde(untagged)]
pub enum TableCell {
    /// Words.
    Text(String),
    /// A whole number.
    Count(usize),
    /// A number, nine decimals at most.
    Number(f64),
    /// Nothing to say here.
    Empty(()),
}

impl TableCell {
    /// The cell in a CSV: a text that a spreadsheet would compute (it begins with `=`, `+`, `-`, `@`, a tab
    /// or an end of a line) has an apostrophe before it, which makes it text; one that begins so after
    /// apostrophes has one more, so that none is lost. Checked in `tests/program/words.rs`.
    fn for_spreadsheet(&self) -> TableCell {
        match self {
            TableCell::Text(text) if is_formula(text.trim_start_matches('\'')) => {
                TableCell::Text(format!("'{text}"))
            }
            cell => cell.clone(),
        }
    }

    /// The text that stands so in a CSV, without what [`TableCell::for_spreadsheet`] put before it.
    fn without_apostrophe(text: &str) -> &str {
        text.strip_prefix('\'').filter(|_| is_formula(text.trim_start_matches('\''))).unwrap_or(text)
    }

    /// A number as tables show it.
    pub fn number(x: f64) -> TableCell {
        TableCell::Number(rounded(x))
    }

    fn of_csv(column: &str, text: &str) -> TableCell {
        match (text.parse(), text.parse()) {
            _ if text.is_empty() => TableCell::Empty(()),
            _ if TEXT_COLUMNS.contains(&column) => TableCell::without_apostrophe(text).into(),
            (Ok(count), _) => TableCell::Count(count),
            (Err(_), Ok(number)) => TableCell::Number(number),
            _ => text.into(),
        }
    }

    fn of_json(value: serde_json::Value) -> TableCell {
        use serde_json::Value;
        match value {
            Value::Null => TableCell::Empty(()),
            Value::String(text) => TableCell::Text(text),
            Value::Number(n) if n.is_u64() => {
                n.as_u64().map_or(TableCell::Empty(()), |n| TableCell::Count(n as usize))
            }
            Value::Number(n) => n.as_f64().map_or(TableCell::Empty(()), TableCell::Number),
            other => TableCell::Text(other.to_string()),
        }
    }
}

/// Whether a spreadsheet would compute a text.
fn is_formula(text: &str) -> bool {
    text.len() > 1 && text.starts_with(['=', '+', '-', '@', '\t', '\r', '\n'])
}

/// Columns whose cells are words, even those that look like numbers.
const TEXT_COLUMNS: [&str; 5] = ["stone", "material", "name", "weighed_as", "error"];

impl From<&str> for TableCell {
    fn from(text: &str) -> TableCell {
        TableCell::Text(text.into())
    }
}

impl<T: Into<TableCell>> From<Option<T>> for TableCell {
    fn from(cell: Option<T>) -> TableCell {
        cell.map_or(TableCell::Empty(()), Into::into)
    }
}

impl From<usize> for TableCell {
    fn from(count: usize) -> TableCell {
        TableCell::Count(count)
    }
}

impl TableFormat {
    /// The form of a file by its extension; CSV without one.
    pub fn from_path(path: &Path) -> Result<TableFormat, TableError> {
        let Some(extension) = path.extension().map(|e| e.to_string_lossy().to_lowercase()) else {
            return Ok(TableFormat::Csv);
        };
        let known = EXTENSIONS.iter().find(|(e, _)| *e == extension).map(|(_, form)| *form);
        known.ok_or_else(|| TableError::Ending(text::display_name(path)))
    }

    /// What stands before the first row.
    pub fn head(self, columns: &[String]) -> Result<Vec<u8>, TableError> {
        Ok(match self {
            TableFormat::Csv => {
                let mut head = record(columns)?;
                head.push(b'\n');
                head
            }
            TableFormat::JsonLines => Vec::new(),
            TableFormat::Json => b"[\n".into(),
        })
    }

    /// One row, without the line's end. No line's end is in it either, unless a CSV text has one.
    pub fn row(self, columns: &[String], cells: &[TableCell]) -> Result<Vec<u8>, TableError> {
        if self == TableFormat::Csv {
            return record(cells.iter().map(TableCell::for_spreadsheet).collect::<Vec<_>>());
        }
        let mut out = Vec::new();
        let fail = |e: serde_json::Error| TableError::Row(e.to_string());
        let mut json = serde_json::Serializer::new(&mut out);
        let mut map = json.serialize_map(Some(cells.len())).map_err(fail)?;
        for (column, cell) in columns.iter().zip(cells) {
            map.serialize_entry(column, cell).map_err(fail)?;
        }
        map.end().map_err(fail)?;
        Ok(out)
    }

    /// The cells of a row that [`TableFormat::row`] made.
    pub fn cells(self, columns: &[String], row: &[u8]) -> Result<Vec<TableCell>, TableError> {
        if self == TableFormat::Csv {
            let mut reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(row);
            let record = reader.records().next().transpose().map_err(|e| TableError::Row(e.to_string()))?;
            let record = record.unwrap_or_default();
            return Ok(columns
                .iter()
                .zip(&record)
                .map(|(column, cell)| TableCell::of_csv(column, cell))
                .collect());
        }
        let mut row: serde_json::Map<String, serde_json::Value> =
            serde_json::from_slice(row).map_err(|e| TableError::Row(e.to_string()))?;
        Ok(columns.iter().map(|column| TableCell::of_json(row.remove(column).unwrap_or_default())).collect())
    }

    /// What stands before row number `i`, from 0.
    pub fn before(self, i: u64) -> &'static [u8] {
        match self {
            TableFormat::Json if i > 0 => b",\n",
            TableFormat::Csv | TableFormat::JsonLines if i > 0 => b"\n",
            _ => b"",
        }
    }

    /// What stands after the last of `rows` rows.
    pub fn tail(self, rows: u64) -> &'static [u8] {
        match self {
            TableFormat::Json if rows > 0 => b"\n]\n",
            TableFormat::Json => b"]\n",
            _ if rows > 0 => b"\n",
            _ => b"",
        }
    }
}

/// A CSV record without the line's end.
fn record(cells: impl serde::Serialize) -> Result<Vec<u8>, TableError> {
    let mut writer = csv::WriterBuilder::new().has_headers(false).from_writer(Vec::new());
    writer.serialize(cells).map_err(|e| TableError::Row(e.to_string()))?;
    let mut line = writer.into_inner().map_err(|e| TableError::Row(e.to_string()))?;
    line.pop();
    Ok(line)
}

/// Reads the rows of a table back, one by one, as [`TableFormat::row`] made them.
pub struct RowReader<R> {
    inner: RowSource<R>,
    limits: Limits,
}

enum RowSource<R> {
    Csv(csv::Reader<MeteredReader<R>>),
    Lines(R),
}

/// What a row is read through, so that none without end fills the memory.
struct MeteredReader<R> {
    inner: R,
    since: u64,
    limits: Limits,
}

impl<R: Read> Read for MeteredReader<R> {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        self.limits.check(&limits::ROW, self.since).map_err(std::io::Error::other)?;
        let read = self.inner.read(into)?;
        self.since += read as u64;
        Ok(read)
    }
}

impl<R: BufRead> RowReader<R> {
    /// A reader after the head of a table.
    pub fn new(form: TableFormat, reader: R, limits: Limits) -> Result<RowReader<R>, TableError> {
        let inner = match form {
            TableFormat::Csv => {
                let metered = MeteredReader { inner: reader, since: 0, limits };
                RowSource::Csv(csv::ReaderBuilder::new().flexible(true).from_reader(metered))
            }
            TableFormat::JsonLines | TableFormat::Json => RowSource::Lines(reader),
        };
        Ok(RowReader { inner, limits })
    }

    /// The next row; none after the last.
    pub fn row(&mut self) -> Result<Option<Vec<u8>>, TableError> {
        match &mut self.inner {
            RowSource::Csv(reader) => {
                reader.get_mut().since = 0;
                let mut row = csv::StringRecord::new();
                let found = reader.read_record(&mut row).map_err(|e| TableError::Row(e.to_string()))?;
                if found { record(row.iter().collect::<Vec<_>>()).map(Some) } else { Ok(None) }
            }
            RowSource::Lines(reader) => loop {
                let mut line = Vec::new();
                let mut part = reader.by_ref().take(self.limits.max(&limits::ROW) + 1);
                let read = part.read_until(b'\n', &mut line).map_err(|e| TableError::Row(e.to_string()))?;
                self.limits.check(&limits::ROW, read).map_err(|e| TableError::Row(e.to_string()))?;
                if read == 0 {
                    return Ok(None);
                }
                if line.first() == Some(&b'{') {
                    line.truncate(line.iter().rposition(|b| *b == b'}').map_or(0, |end| end + 1));
                    return Ok(Some(line));
                }
            },
        }
    }
}

/// The cells of a table, column by column: numbers, and the same as text.
#[derive(Debug, Clone, Default)]
pub struct NumericColumns {
    numbers: BTreeMap<String, Vec<Option<f64>>>,
    texts: BTreeMap<String, Vec<String>>,
}

impl NumericColumns {
    /// Those of a table's bytes.
    pub fn read(bytes: &[u8], form: TableFormat, limits: Limits) -> Result<NumericColumns, TableError> {
        let mut table = NumericColumns::default();
        let mut add = |column: &str, number: Option<f64>, text: String| {
            table.numbers.entry(column.to_owned()).or_default().push(number);
            table.texts.entry(column.to_owned()).or_default().push(text);
        };
        if form == TableFormat::Csv {
            let mut reader = csv::Reader::from_reader(bytes);
            let fail = |e: csv::Error| TableError::Row(e.to_string());
            let head = reader.headers().map_err(fail)?.clone();
            for row in reader.records() {
                let row = row.map_err(fail)?;
                for (column, cell) in head.iter().zip(&row) {
                    let text = TableCell::without_apostrophe(cell);
                    add(column, cell.parse().ok(), text.into());
                }
            }
            return Ok(table);
        }
        let mut rows = RowReader::new(form, bytes, limits)?;
        while let Some(row) = rows.row()? {
            let row: serde_json::Map<String, serde_json::Value> =
                serde_json::from_slice(&row).map_err(|e| TableError::Row(e.to_string()))?;
            for (column, cell) in &row {
                let text = cell.as_str().map_or_else(|| cell.to_string(), str::to_owned);
                add(column, cell.as_f64(), text);
            }
        }
        Ok(table)
    }

    /// A column's numbers, none where a cell is no number; empty if there is no such column.
    pub fn column(&self, name: &str) -> &[Option<f64>] {
        self.numbers.get(name).map_or(&[], Vec::as_slice)
    }

    /// A column's cells as text; empty if there is no such column.
    pub fn texts(&self, name: &str) -> &[String] {
        self.texts.get(name).map_or(&[], Vec::as_slice)
    }
}

/// The columns of scores: those in `leading`, then `<metric>` and `<metric>_se` for each metric,
/// then `error`.
pub fn columns(leading: &[&str], metrics: &[&Metric]) -> Vec<String> {
    let mut columns: Vec<String> = leading.iter().map(|c| c.to_string()).collect();
    for m in metrics {
        columns.extend([m.name.to_owned(), format!("{}_se", m.name)]);
    }
    columns.push("error".into());
    columns
}

/// The cells of [`columns`]: those in `leading`, the row's scores and its error. A score that does
/// not apply leaves its two cells empty, and the last cell says why.
pub fn cells(mut leading: Vec<TableCell>, row: &ScoreRow) -> Vec<TableCell> {
    for score in &row.scores {
        leading.extend(match score {
            Some(e) => [TableCell::number(e.value), TableCell::number(e.error)],
            None => [TableCell::Empty(()), TableCell::Empty(())],
        });
    }
    let remarks: Vec<String> = row.error.clone().into_iter().chain(row.omissions()).collect();
    leading.push(if remarks.is_empty() { TableCell::Empty(()) } else { TableCell::Text(remarks.join("; ")) });
    leading
}

/// What stands first in a table of stones.
pub const STONE_COLUMNS: [&str; 3] = ["stone", "material", "facets"];

/// The cells of [`STONE_COLUMNS`].
pub fn stone_cells(row: &ScoreRow) -> Vec<TableCell> {
    vec![row.stone.as_str().into(), row.material.as_str().into(), row.facets.into()]
}

/// Rows as CSV: `stone, material, facets`, then as [`columns`] has it.
///
/// - `metrics`: those that the rows were scored for, in the same order
///
/// The caller writes the bytes with [`crate::storage::atomic_write::write`]. Checked in `tests/library/score_promises.rs`.
pub fn csv(metrics: &[&Metric], rows: &[ScoreRow]) -> Result<Vec<u8>, TableError> {
    let columns = columns(&STONE_COLUMNS, metrics);
    let mut out = TableFormat::Csv.head(&columns)?;
    for (i, row) in rows.iter().enumerate() {
        out.extend_from_slice(TableFormat::Csv.before(i as u64));
        out.extend(TableFormat::Csv.row(&columns, &cells(stone_cells(row), row))?);
    }
    out.extend_from_slice(TableFormat::Csv.tail(rows.len() as u64));
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_zero_has_no_sign() {
        for x in [-0.0, -1e-12] {
            let TableCell::Number(shown) = TableCell::number(x) else { panic!("{x} is a number") };
            assert!(shown == 0.0 && shown.is_sign_positive(), "{x}: {shown}");
        }
    }
}
