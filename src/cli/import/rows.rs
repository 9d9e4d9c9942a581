//! What became of the files of an import.

use crate::cli::args::stone;
use crate::cli::error::CliError;
use crate::cli::terminal_table;
use crate::storage::terminal::in_line;
use comfy_table::{Cell, CellAlignment};
use serde::Serialize;
use std::ffi::OsStr;

/// It was written.
pub const WRITTEN: &str = "written";
/// A file of the same bytes was there.
pub const THERE: &str = "there already";
/// It is no stone, and nobody asked for it.
pub const PASSED_OVER: &str = "passed over";
const FAILED: &str = "failed";

/// What happened to one file.
#[derive(Debug, Clone, Default, Serialize)]
pub struct ImportRow {
    pub file: String,
    pub outcome: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub format: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub facets: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wrote: Option<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
}

impl ImportRow {
    /// Of a stone that could not be imported.
    pub fn failed(stone: &OsStr, failure: &CliError) -> ImportRow {
        let (file, error) = (stone::display_name(stone), Some(failure.message()));
        ImportRow { file, outcome: FAILED, error, ..ImportRow::default() }
    }
}

/// The rows in columns, then how many had which outcome.
pub fn table(rows: &[ImportRow]) -> String {
    let mut table = terminal_table::new();
    let right = |text: String| Cell::new(text).set_alignment(CellAlignment::Right);
    table.set_header(["file".into(), "format".into(), right("facets".into()), Cell::new("wrote")]);
    table.add_rows(rows.iter().filter(|r| r.outcome != PASSED_OVER).map(|r| {
        let wrote = r.wrote.as_ref().map_or_else(|| r.outcome.into(), |wrote| in_line(wrote));
        let facets = r.facets.map_or_else(String::new, |n| n.to_string());
        [in_line(&r.file).into(), r.format.unwrap_or_default().into(), right(facets), Cell::new(wrote)]
    }));
    let mut text = terminal_table::lines(&table);
    let counts: Vec<String> = [WRITTEN, THERE, FAILED, PASSED_OVER]
        .iter()
        .map(|outcome| (rows.iter().filter(|r| r.outcome == *outcome).count(), outcome))
        .filter(|(n, _)| *n > 0)
        .map(|(n, outcome)| format!("{n} {outcome}"))
        .collect();
    text += &counts.join(", ");
    text
}
