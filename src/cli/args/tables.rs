//! Options of commands that write tables.

use crate::batch::shard::Shard;
use crate::batch::table::TableFormat;
use crate::cli::console::Console;
use crate::cli::error::CliError;
use crate::storage::atomic_write;
use std::path::{Path, PathBuf};

/// The options of a table.
#[derive(Debug, Clone, clap::Args)]
pub struct TableArgs {
    /// Where to write the table: .csv, .jsonl or .ndjson, .json; - is standard output. Beside
    /// NAME.csv goes NAME.csv.meta.json with what the columns mean. Interrupted and started again with
    /// the same command it goes on where it was
    #[arg(long, short, value_name = "FILE", default_value = "-")]
    pub output: PathBuf,
    /// Make the I-th of N interleaved parts; `cutlab merge` joins them
    #[arg(long, value_name = "I/N", default_value = "1/1")]
    pub shard: Shard,
}

impl TableArgs {
    /// How the table is written: by its name's extension; on a stream as CSV, or JSON if that is asked for.
    pub fn format(&self, console: &Console) -> Result<TableFormat, CliError> {
        format_of(&self.output, console)
    }
}

/// How a table at `output` is written.
pub fn format_of(output: &Path, console: &Console) -> Result<TableFormat, CliError> {
    let stream = atomic_write::is_stream(output);
    match stream && console.json {
        true => Ok(TableFormat::Json),
        // a device's or an open file's name has no extension that means anything
        false if stream => Ok(TableFormat::from_path(output).unwrap_or(TableFormat::Csv)),
        false => Ok(TableFormat::from_path(output)?),
    }
}
