//! A table written to a stream; to a terminal so that it can be read.

use crate::batch::table::NumericColumns;
use crate::batch::table_job::{TableJob, TableSummary};
use crate::cli::console::Console;
use crate::cli::error::CliError;
use crate::cli::limits::limits;
use crate::cli::score_text;
use crate::metrics::Metric;
use crate::storage::atomic_write;
use std::io::{IsTerminal, Write};
use std::path::Path;

/// Writes the table; what it comes to, and its bytes if they are asked for.
///
/// - `keeps`: whether the bytes are asked for
/// - `end`: called when all rows are written
pub fn write(
    job: &TableJob,
    output: &Path,
    (metrics, keeps): (&[&'static Metric], bool),
    console: &Console,
    end: impl FnOnce(),
) -> Result<(TableSummary, Vec<u8>), CliError> {
    let to_read = atomic_write::is_stdout(output) && std::io::stdout().is_terminal() && !console.json;
    let out = if to_read { Box::new(std::io::sink()) } else { atomic_write::open_stream(output)? };
    let mut copied = Tee { out, copy: (to_read || keeps).then(Vec::new) };
    let summary = job.write(&mut copied, output)?;
    end();
    let bytes = copied.copy.unwrap_or_default();
    if to_read {
        let table = NumericColumns::read(&bytes, job.form, limits())?;
        console.print(&score_text::text(job.columns, &table, metrics))?;
    }
    Ok((summary, bytes))
}

/// A stream, and a copy of what went there.
struct Tee {
    out: Box<dyn Write + Send>,
    copy: Option<Vec<u8>>,
}

impl Write for Tee {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let n = self.out.write(bytes)?;
        if let Some(copy) = &mut self.copy {
            copy.extend_from_slice(&bytes[..n]);
        }
        Ok(n)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.out.flush()
    }
}
