//! Arguments and course of commands that write tables: progress, what is written where, how it ends.

use super::stone;
use crate::batch::merge::TablePart;
use crate::batch::request::TableRequest;
use crate::batch::shard::Shard;
use crate::batch::sidecar::TableMeta;
use crate::batch::table::{NumericColumns, TableError, TableFormat};
use crate::batch::table_job::{JobEvent, TableJob, TableJobError, TableSummary};
use crate::batch::table_rows::TableRows;
use crate::cli::console::Console;
use crate::cli::exit_code;
use crate::cli::exit_code::{CliError, ExitStatus};
use crate::cli::limits::limits;
use crate::cli::outputs::Outputs;
use crate::cli::plot_output::Plots;
use crate::cli::terminal_table;
use crate::render::Record;
use crate::storage::atomic_write;
use crate::storage::journal::JournalRemark;
use indicatif::ProgressBar;
use std::collections::BTreeSet;
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

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

/// A table to be made.
pub struct TableCommand<'a> {
    /// What was asked for.
    pub request: &'a TableRequest,
    /// Its rows.
    pub rows: &'a dyn TableRows,
    /// What to say before the work.
    pub notes: Vec<String>,
    /// Word for the progress bar.
    pub what: &'static str,
}

impl TableCommand<'_> {
    /// Makes the table and writes it, with its plots.
    ///
    /// - `outputs`: of the command
    ///
    /// A table that is there already, whole and of just this job, is not made again.
    pub fn run(
        &self,
        table: &TableArgs,
        plots: &Plots,
        outputs: &mut Outputs,
        console: &Console,
    ) -> Result<ExitStatus, CliError> {
        let output = &table.output;
        let form = table.format(console)?;
        plots.claim(&self.record(), outputs)?;
        let bar = console.progress(0, self.what);
        let noted = Mutex::new(BTreeSet::new());
        let waited = AtomicBool::new(false);
        let tell = |event: JobEvent| match event {
            JobEvent::Remark(JournalRemark::Waiting) => bar.suspend(|| {
                waited.store(true, Ordering::Relaxed);
                let output = stone::display_name(output);
                console.note(&format!("another cutlab is making {output}: waiting for it to end"));
            }),
            JobEvent::Remark(JournalRemark::Quarantined(path, why)) => bar.suspend(|| {
                console.note(&format!("progress not used, {why}; it is now {}", stone::display_name(&path)));
            }),
            JobEvent::Begins { done, rows } => {
                if done > 0 {
                    bar.suspend(|| console.note(&format!("{done} of {rows} rows are there: going on")));
                }
                bar.set_length(rows);
                bar.set_position(done);
                bar.reset_eta();
            }
            JobEvent::Row(line) => {
                if let Some(complaint) = &line.complaint {
                    bar.suspend(|| console.complain(complaint));
                }
                if let Some(note) = &line.note
                    && noted.lock().unwrap_or_else(PoisonError::into_inner).insert(kind_of(note).to_owned())
                {
                    bar.suspend(|| console.note(&format!("note: {note}")));
                }
                bar.inc(1);
            }
        };
        let batch = TableJob {
            identity: self.rows.identity(),
            total: self.rows.total(),
            shard: table.shard,
            form,
            columns: self.rows.columns(),
            order: self.rows.order(),
            line: &|i| self.rows.row(i, form),
            tell: &tell,
        };
        let say_notes = || self.notes.iter().for_each(|note| console.note(note));
        if atomic_write::is_stream(output) {
            say_notes();
            return self.stream(&batch, output, plots, console, &bar);
        }
        let begun = batch.is_begun(output);
        self.claim(table, begun, outputs)?;
        say_notes();
        if let Some(part) = self.already(table, begun, console) {
            return self.reused(&part, plots, console);
        }
        exit_code::mark_resumable();
        let progress = batch.begin(output)?;
        if waited.load(Ordering::Relaxed) {
            // the other process may have put a table there, its own or this one
            let claimed = self.claim(table, false, &mut Outputs::new(console));
            let part = self.already(table, false, console);
            if claimed.is_err() || part.is_some() {
                progress.finish()?;
                claimed?;
                return part.map_or(Ok(ExitStatus::Done), |part| self.reused(&part, plots, console));
            }
        }
        let mut finished = batch.finish(progress, output)?;
        bar.finish_and_clear();
        let mut written = self.draw(plots, || Ok(finished.bytes()?), form)?;
        let meta = self.meta(table.shard, &finished.summary, finished.crc32);
        let bytes = meta.bytes().map_err(|e| CliError::input(e.to_string()))?;
        atomic_write::write(&TableMeta::path_for(output), &bytes)?;
        let summary = finished.summary.clone();
        finished.publish(output)?; // last: where the table is, all is
        written.insert(0, output.clone());
        tell_written(&written, &summary, "", console)?;
        Ok(code(&summary))
    }

    /// Writes the table to a stream; to a terminal so that it can be read.
    fn stream(
        &self,
        batch: &TableJob,
        output: &Path,
        plots: &Plots,
        console: &Console,
        bar: &ProgressBar,
    ) -> Result<ExitStatus, CliError> {
        let to_read = atomic_write::is_stdout(output) && std::io::stdout().is_terminal() && !console.json;
        let out = if to_read { Box::new(std::io::sink()) } else { atomic_write::open_stream(output)? };
        let mut copied = Tee { out, copy: (to_read || !plots.is_empty()).then(Vec::new) };
        let summary = batch.write(&mut copied, output)?;
        bar.finish_and_clear();
        let bytes = copied.copy.unwrap_or_default();
        if to_read {
            let table = NumericColumns::read(&bytes, batch.form, limits())?;
            console.print(&terminal_table::text(
                self.rows.columns(),
                &table,
                &self.request.scores().metrics,
            ))?;
        }
        let drawn = self.draw(plots, || Ok(bytes), batch.form)?;
        drawn.iter().for_each(|file| console.note(&format!("wrote {}", stone::display_name(file))));
        Ok(code(&summary))
    }

    /// What plots of the table say of where they come from.
    fn record(&self) -> Record {
        Record::of_request(self.request.command(), self.request)
    }

    fn draw(
        &self,
        plots: &Plots,
        bytes: impl FnOnce() -> Result<Vec<u8>, CliError>,
        form: TableFormat,
    ) -> Result<Vec<PathBuf>, CliError> {
        match self.rows.layout() {
            Some(layout) if !plots.is_empty() => plots.draw(&bytes()?, form, &layout, &self.record()),
            _ => Ok(Vec::new()),
        }
    }

    /// The table that is there already, if it is whole and of just this job.
    fn already(&self, table: &TableArgs, begun: bool, console: &Console) -> Option<TablePart> {
        let part = TablePart::open(&table.output, limits()).ok().filter(|_| !begun && !console.force)?;
        let is_same = part.meta.study == self.rows.identity() && part.meta.shard == self.shard_of(table);
        is_same.then_some(part)
    }

    /// What is still to be done for a table that is there already.
    fn reused(&self, part: &TablePart, plots: &Plots, console: &Console) -> Result<ExitStatus, CliError> {
        let mut files = self.draw(plots, || Ok(part.bytes()?), part.form)?;
        console
            .note(&format!("{} is there already: its rows are used again", stone::display_name(&part.table)));
        files.insert(0, part.table.clone());
        tell_written(&files, &part.meta.summary, "", console)?;
        Ok(code(&part.meta.summary))
    }

    fn shard_of(&self, table: &TableArgs) -> Option<Shard> {
        (table.shard != Shard::WHOLE).then_some(table.shard)
    }

    /// Takes the places of the table and its sidecar.
    ///
    /// - `begun`: whether an earlier start of the same command left its progress there
    fn claim(&self, table: &TableArgs, begun: bool, outputs: &mut Outputs) -> Result<(), CliError> {
        claim_table(&table.output, &|meta| meta.is_of(self.request), self.shard_of(table), begun, outputs)
    }

    fn meta(&self, shard: Shard, summary: &TableSummary, crc32: u32) -> TableMeta {
        TableMeta {
            layout: self.rows.layout(),
            total: self.rows.total(),
            shard: (shard != Shard::WHOLE).then_some(shard),
            summary: summary.clone(),
            crc32: format!("{crc32:08x}"),
            ..TableMeta::new(self.request, self.rows.identity().into(), self.rows.columns().to_vec())
        }
    }
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

/// Takes the places of a table and of its sidecar.
///
/// - `is_of`: whether a sidecar that is there is one of this table
/// - `begun`: whether an earlier start of the same command left its progress there
pub fn claim_table(
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

impl From<TableError> for CliError {
    fn from(error: TableError) -> CliError {
        CliError::input(error.to_string())
    }
}

impl From<TableJobError> for CliError {
    fn from(error: TableJobError) -> CliError {
        match error {
            TableJobError::Write(error) => error.into(),
            TableJobError::Table(error) => error.into(),
        }
    }
}

/// What a note has in common with those of other stones that differ in their index alone.
fn kind_of(note: &str) -> &str {
    note.split(" (n = ").next().unwrap_or(note)
}
