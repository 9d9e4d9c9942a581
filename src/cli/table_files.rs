//! A table and its sidecar: their places, and what is said of them.

use super::args::stone;
use super::console::Console;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::limits::limits;
use super::outputs::Outputs;
use crate::batch::shard::Shard;
use crate::batch::sidecar::TableMeta;
use crate::batch::table_job::TableSummary;
use std::path::{Path, PathBuf};

/// Takes the places of a table and of its sidecar.
///
/// - `is_of`: whether a sidecar that is there is one of this table
/// - `begun`: whether an earlier start of the same command left its progress there
pub fn claim(
    output: &Path,
    is_of: &dyn Fn(&TableMeta) -> bool,
    shard: Option<Shard>,
    begun: bool,
    outputs: &mut Outputs,
) -> Result<(), CliError> {
    // a kill may have come between the new sidecar and the new table
    let says_so = |sidecar: &Path| TableMeta::read(sidecar, limits()).is_ok_and(|meta| is_of(&meta));
    let is_own = |there: &Path| {
        TableMeta::belongs_to(there, is_of, shard, limits())
            || (begun && says_so(&TableMeta::find_for(there)))
    };
    outputs.claim(output, is_own)?;
    outputs.claim(&TableMeta::path_for(output), says_so)
}

/// What was written, for `--json`.
#[derive(serde::Serialize)]
struct WrittenTable<'a> {
    files: &'a [String],
    #[serde(flatten)]
    summary: &'a TableSummary,
}

/// Says which files a table was written to and what it comes to.
///
/// - `of`: more about its rows, as ` of 3 parts`
pub fn tell_written(
    files: &[PathBuf],
    summary: &TableSummary,
    of: &str,
    console: &Console,
) -> Result<(), CliError> {
    let names: Vec<String> = files.iter().map(stone::display_name).collect();
    if console.json {
        return console.print_json(&WrittenTable { files: &names, summary });
    }
    let failed = if summary.failed > 0 { format!(", {} failed", summary.failed) } else { String::new() };
    let short = match summary.short {
        0 => String::new(),
        n => format!(", {n} with scores missing or less exact than asked for"),
    };
    console.note(&format!("wrote {}: {} rows{of}{failed}{short}", names.join(", "), summary.rows));
    Ok(())
}

/// Done, or how many failed: a row whose error was not reached still has its scores.
pub fn code(summary: &TableSummary) -> ExitStatus {
    match summary.failed {
        0 if summary.short == 0 => ExitStatus::Done,
        n if n < summary.rows => ExitStatus::SomeFailed,
        n if n == summary.unreadable => ExitStatus::Io,
        _ => ExitStatus::NoGoodInput,
    }
}
