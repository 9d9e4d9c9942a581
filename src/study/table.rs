//! The table of scores as CSV.

use super::score::Row;
use crate::metrics::Metric;
use serde::Serialize;

/// A number of a table: a fraction or degrees to 1e-9, far below any error.
fn rounded(x: f64) -> f64 {
    (x * 1e9).round() / 1e9
}

/// One cell.
#[derive(Serialize)]
#[serde(untagged)]
enum Cell<'a> {
    Text(&'a str),
    Count(usize),
    Number(f64),
    Empty(()),
}

/// A table that could not be put into bytes.
#[derive(Debug, thiserror::Error)]
#[error("cannot write the table: {0}")]
pub struct TableError(String);

/// Rows as CSV: `stone, material, facets`, then `<metric>` and `<metric>_se` for each metric, then
/// `error`, a header first.
///
/// - `metrics`: those that the rows were scored for, in the same order
///
/// A score that does not apply leaves its two cells empty. Numbers have nine decimals at most.
/// The caller writes the bytes with [`crate::store::replace::write`]. Checked in `tests/score_promises.rs`.
pub fn csv(metrics: &[&Metric], rows: &[Row]) -> Result<Vec<u8>, TableError> {
    let fail = |e: csv::Error| TableError(e.to_string());
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut header: Vec<String> = ["stone", "material", "facets"].map(String::from).into();
    for m in metrics {
        header.extend([m.name.to_owned(), format!("{}_se", m.name)]);
    }
    header.push("error".into());
    writer.write_record(&header).map_err(fail)?;
    for row in rows {
        let mut cells = vec![Cell::Text(&row.stone), Cell::Text(&row.material)];
        cells.push(row.facets.map_or(Cell::Empty(()), Cell::Count));
        for score in &row.scores {
            match score {
                Some(e) => cells.extend([Cell::Number(rounded(e.value)), Cell::Number(rounded(e.error))]),
                None => cells.extend([Cell::Empty(()), Cell::Empty(())]),
            }
        }
        cells.push(row.error.as_deref().map_or(Cell::Empty(()), Cell::Text));
        writer.serialize(cells).map_err(fail)?;
    }
    writer.into_inner().map_err(|e| TableError(e.to_string()))
}
