//! Tables of a quantity against wavelength, as spectrometers and their programs write them.
//!
//! Columns are separated by commas, semicolons, tabs or blanks; a decimal comma is understood; lines before
//! and after the numbers are left out.

use super::MINUS_SIGNS;
use serde::Deserialize;
use serde::de::{Deserializer, Error, SeqAccess, Visitor};

/// What the first column counts.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WavelengthUnit {
    /// Wavelength in nanometres.
    #[default]
    Nm,
    /// Wavelength in micrometres.
    Um,
    /// Wavenumber in cm⁻¹.
    PerCm,
}

/// How a table is read.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct SpectrumLayout {
    /// Unit of the wavelengths.
    pub wavelength: WavelengthUnit,
    /// The columns of wavelength and value, from 1; none for the first two.
    pub columns: Option<[usize; 2]>,
}

/// A row of a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpectrumRow {
    /// Wavelength, nm.
    pub nm: f64,
    /// The value, in the table's own unit.
    pub value: f64,
    /// The line of the file that it stands in, or its number in a list, from 1.
    pub line: usize,
}

/// A table that cannot be used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SpectrumError {
    /// The line of the file, or the number of the row in a list, from 1.
    pub line: usize,
    /// What belongs there.
    pub expected: String,
    /// What stands there.
    pub found: String,
}

impl SpectrumError {
    fn new(line: usize, expected: &str, found: impl Into<String>) -> SpectrumError {
        SpectrumError { line, expected: expected.into(), found: found.into() }
    }
}

/// A table as a data file has it: in rows of its own, or in a file beside it.
#[derive(Debug, Clone, PartialEq)]
pub enum SpectrumEntry {
    /// Pairs of wavelength and value.
    Rows(Vec<[f64; 2]>),
    /// A file's name.
    File(String),
}

impl<'de> Deserialize<'de> for SpectrumEntry {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<SpectrumEntry, D::Error> {
        struct Either;
        impl<'de> Visitor<'de> for Either {
            type Value = SpectrumEntry;

            fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                f.write_str("a list of pairs [wavelength, value], or a file's name in quotes")
            }

            fn visit_str<E: Error>(self, name: &str) -> Result<SpectrumEntry, E> {
                Ok(SpectrumEntry::File(name.into()))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut pairs: A) -> Result<SpectrumEntry, A::Error> {
                let mut rows = Vec::new();
                while let Some(row) = pairs.next_element()? {
                    rows.push(row);
                }
                Ok(SpectrumEntry::Rows(rows))
            }
        }
        deserializer.deserialize_any(Either)
    }
}

/// The rows of a list of pairs of wavelength and value, by rising wavelength.
pub fn from_pairs(pairs: &[[f64; 2]], wavelength: WavelengthUnit) -> Result<Vec<SpectrumRow>, SpectrumError> {
    let rows = pairs.iter().zip(1..).map(|([x, value], line)| row(*x, *value, line, wavelength));
    in_order(rows.collect::<Result<_, _>>()?)
}

/// The rows of a table as text, by rising wavelength.
pub fn from_text(text: &str, layout: SpectrumLayout) -> Result<Vec<SpectrumRow>, SpectrumError> {
    let columns = layout.columns.unwrap_or([1, 2]);
    if columns.contains(&0) || columns[0] == columns[1] {
        return Err(SpectrumError::new(1, "two different columns, counted from 1", format!("{columns:?}")));
    }
    let cell = |record: &Record, column: usize| record.cells.get(column - 1).and_then(|cell| number(cell));
    let is_row = |record: &Record| columns.iter().all(|column| cell(record, *column).is_some());
    let splits = [Separator::Byte(b';'), Separator::Byte(b'\t'), Separator::Byte(b','), Separator::Blanks];
    let splits = splits.map(|separator| records(text, separator));
    // of several that give as many rows the first
    let best = splits.iter().rev().max_by_key(|records| records.iter().filter(|r| is_row(r)).count());
    let records = best.map_or(&[][..], Vec::as_slice);
    let Some(first) = records.iter().position(is_row) else {
        let found = text.lines().find(|line| !line.trim().is_empty()).unwrap_or("nothing");
        return Err(SpectrumError::new(1, "rows of a wavelength and a value", excerpt(found)));
    };
    let mut rows = Vec::new();
    let mut ended = false;
    for record in &records[first..] {
        match (cell(record, columns[0]), cell(record, columns[1])) {
            (Some(x), Some(value)) if !ended => rows.push(row(x, value, record.line, layout.wavelength)?),
            (Some(_), Some(_)) => {
                return Err(SpectrumError::new(record.line, "the end of the table", excerpt(&record.text())));
            }
            (Some(_), None) if !ended => {
                return Err(SpectrumError::new(
                    record.line,
                    "a wavelength and a value",
                    excerpt(&record.text()),
                ));
            }
            _ => ended = true,
        }
    }
    in_order(rows)
}

/// How the cells of a line are told apart.
#[derive(Debug, Clone, Copy)]
enum Separator {
    Byte(u8),
    Blanks,
}

/// A line of a table.
struct Record {
    line: usize,
    cells: Vec<String>,
}

impl Record {
    fn text(&self) -> String {
        self.cells.join(" ")
    }
}

/// The lines that hold something, each in its cells.
fn records(text: &str, separator: Separator) -> Vec<Record> {
    let Separator::Byte(byte) = separator else {
        let lines = text.lines().zip(1..).filter(|(line, _)| !line.trim().is_empty());
        return lines
            .map(|(text, line)| Record { line, cells: text.split_whitespace().map(String::from).collect() })
            .collect();
    };
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .delimiter(byte)
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let (mut line, mut counted) = (1, 0);
    let mut all = Vec::new();
    for record in reader.records().map_while(Result::ok) {
        // the reader's position may be that of blank lines before the record
        let at = record.position().map_or(counted, |p| p.byte() as usize);
        let bytes = text.as_bytes().get(at..).unwrap_or_default();
        let at = at + bytes.iter().take_while(|b| matches!(b, b'\n' | b'\r')).count();
        let between = text.as_bytes().get(counted..at).unwrap_or_default();
        line += between.iter().filter(|b| **b == b'\n').count();
        counted = at.max(counted);
        if record.iter().any(|cell| !cell.is_empty()) {
            all.push(Record { line, cells: record.iter().map(String::from).collect() });
        }
    }
    all
}

/// A finite number with a decimal point or comma.
fn number(cell: &str) -> Option<f64> {
    let text = cell.trim().replace(MINUS_SIGNS, "-");
    let text = match text.split_once(',') {
        Some((whole, rest)) if rest.starts_with(|c: char| c.is_ascii_digit()) && !whole.contains('.') => {
            format!("{whole}.{rest}")
        }
        _ => text,
    };
    text.parse().ok().filter(|x: &f64| x.is_finite())
}

fn row(x: f64, value: f64, line: usize, unit: WavelengthUnit) -> Result<SpectrumRow, SpectrumError> {
    let nm = match unit {
        WavelengthUnit::Nm => x,
        WavelengthUnit::Um => 1e3 * x,
        WavelengthUnit::PerCm => 1e7 / x,
    };
    if !(nm > 0.0 && nm.is_finite() && value.is_finite()) {
        return Err(SpectrumError::new(line, "a wavelength above 0 and a value", format!("{x}, {value}")));
    }
    Ok(SpectrumRow { nm, value, line })
}

/// The rows by rising wavelength; they rise or fall from first to last.
fn in_order(mut rows: Vec<SpectrumRow>) -> Result<Vec<SpectrumRow>, SpectrumError> {
    if let [first, .., last] = rows[..]
        && first.nm > last.nm
    {
        rows.reverse();
        if let Some(pair) = rows.windows(2).find(|pair| pair[0].nm >= pair[1].nm) {
            return Err(out_of_order(pair[0]));
        }
    }
    match rows.windows(2).find(|pair| pair[0].nm >= pair[1].nm) {
        Some(pair) => Err(out_of_order(pair[1])),
        None if rows.len() < 2 => Err(SpectrumError::new(
            rows.first().map_or(1, |row| row.line),
            "two rows or more",
            rows.len().to_string(),
        )),
        None => Ok(rows),
    }
}

fn out_of_order(row: SpectrumRow) -> SpectrumError {
    SpectrumError::new(row.line, "wavelengths that rise, or fall, from row to row", format!("{} nm", row.nm))
}

/// The beginning of a line, for a message.
fn excerpt(line: &str) -> String {
    const MOST: usize = 40;
    let line: String = line.trim().chars().filter(|c| !c.is_control()).take(MOST).collect();
    format!("'{line}'")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<(f64, f64)>, SpectrumError> {
        let rows = from_text(text, SpectrumLayout::default())?;
        Ok(rows.iter().map(|row| (row.nm, row.value)).collect())
    }

    #[test]
    fn every_separator_and_decimal_sign_gives_the_same_rows() {
        let wanted = [(400.0, 0.5), (410.5, 0.25), (420.0, 0.0)];
        for text in [
            "400,0.5\n410.5,0.25\n420,0\n",
            "400, 0.5\r\n410.5, 0.25\r\n\r\n420, 0",
            "nm;A\n400;0,5\n410,5;0,25\n420;0\n",
            "Wavelength\tAbs\n400\t0,5\n410,5\t0,25\n420\t0",
            "  400   0.5\n  410.5  0.25\n 420 0\n",
            "400,0 0,5\n410,5 0,25\n420 0\n",
            "\"nm\",\"A\"\n\"400,0\",\"0,5\"\n\"410,5\",\"0,25\"\n\"420\",\"0\"\n",
            "Instrument: 7\nDate,2026-01-05\n400,0.5\n410.5,0.25\n420,0\n\nend of data\n",
            "420 0\n410.5 0.25\n400 5e-1\n",
        ] {
            assert_eq!(read(text).as_deref(), Ok(&wanted[..]), "{text}");
        }
    }

    #[test]
    fn units_and_columns_are_as_stated() {
        let layout = SpectrumLayout { wavelength: WavelengthUnit::PerCm, columns: Some([2, 3]) };
        let rows = from_text("n,k,a\n1,25000,7\n2,20000,8\n", layout).expect("a table");
        assert_eq!(
            rows.iter().map(|r| (r.nm, r.value, r.line)).collect::<Vec<_>>(),
            [(400.0, 7.0, 2), (500.0, 8.0, 3)].into_iter().collect::<Vec<_>>()
        );
        let rows = from_pairs(&[[0.5, 1.0], [0.25, 2.0]], WavelengthUnit::Um).expect("a table");
        assert_eq!((rows[0].nm, rows[0].value), (250.0, 2.0));
    }

    #[test]
    fn errors_name_the_line() {
        for (text, line, found) in [
            ("nm,A\n\n400,1\n390,2\n410,3\n", 4, "390 nm"),
            ("400,1\n410,1\n410,2\n", 3, "410 nm"),
            ("400,1\n410,x\n420,2\n", 2, "'410 x'"),
            ("400,1\n410,1\nend\n420,2\n", 4, "'420 2'"),
            ("nothing here\n", 1, "'nothing here'"),
            ("400,1\n", 1, "1"),
            ("-400,1\n500,1\n", 1, "-400, 1"),
        ] {
            let error = read(text).expect_err(text);
            assert_eq!((error.line, &*error.found), (line, found), "{text}");
        }
    }
}
