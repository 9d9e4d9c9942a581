//! Long tables on the command line: progress, what is written where, how it ends.

use super::console::Console;
use super::outcome::{self, Code, Failure};
use crate::store::progress::Remark;
use crate::store::replace;
use crate::study::batch::{Batch, BatchError, Event, Line, Summary};
use crate::study::meta::Meta;
use crate::study::score::{Plan, Row};
use crate::study::shard::Shard;
use crate::study::table::{Form, TableError};
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

/// The options of a table.
#[derive(Debug, Clone, clap::Args)]
pub struct Table {
    /// Where to write the table: .csv, .jsonl or .ndjson, .json; - is standard output. Beside
    /// NAME.csv goes NAME.meta.json with what the columns mean. Interrupted and started again with
    /// the same command it goes on where it was
    #[arg(long, short, value_name = "FILE", default_value = "-")]
    pub output: PathBuf,
    /// Make the I-th of N interleaved parts; `cutlab merge` joins them
    #[arg(long, value_name = "I/N", default_value = "1/1")]
    pub shard: Shard,
}

/// A table to be made.
pub struct Study<'a> {
    /// The command with every setting spelled out.
    pub command: String,
    /// What the table is a function of.
    pub identity: String,
    /// How the scores are made.
    pub plan: &'a Plan,
    /// The table's columns.
    pub columns: Vec<String>,
    /// Rows of the whole table.
    pub total: u64,
    /// Word for the progress bar.
    pub what: &'static str,
    /// Makes a row.
    pub line: &'a (dyn Fn(u64, Form) -> Result<Line, TableError> + Sync),
}

/// Draws what belongs to a finished table, of the bytes given, and names the files it wrote.
pub type Plot<'a> = &'a dyn Fn(&[u8], Form) -> Result<Vec<PathBuf>, Failure>;

impl Study<'_> {
    /// Makes the table and writes it.
    ///
    /// - `plot`: called with the table's bytes when all rows are there, before it is put in place;
    ///   it may write more files and give their names
    pub fn run(&self, table: &Table, console: &Console, plot: Option<Plot>) -> Result<Code, Failure> {
        let stream = replace::is_stream(&table.output);
        let form = if stream && console.json { Form::Json } else { Form::of(&table.output)? };
        let bar = console.progress(0, self.what);
        let noted = Mutex::new(BTreeSet::new());
        let tell = |event: Event| match event {
            Event::Remark(Remark::Waiting) => bar.suspend(|| {
                console.note(&format!(
                    "another cutlab is making {}: waiting for it to end",
                    table.output.display()
                ));
            }),
            Event::Remark(Remark::SetAside(path, why)) => bar.suspend(|| {
                console.note(&format!("progress not used, {why}; it is now {}", path.display()));
            }),
            Event::Begins { done, rows } => {
                if done > 0 {
                    bar.suspend(|| console.note(&format!("{done} of {rows} rows are there: going on")));
                }
                bar.set_length(rows);
                bar.set_position(done);
                bar.reset_eta();
            }
            Event::Row(line) => {
                if let Some(complaint) = &line.complaint {
                    bar.suspend(|| console.complain(complaint));
                }
                if let Some(note) = &line.note
                    && noted.lock().unwrap_or_else(PoisonError::into_inner).insert(note.clone())
                {
                    bar.suspend(|| console.note(&format!("note: {note}")));
                }
                bar.inc(1);
            }
        };
        let batch = Batch {
            identity: &self.identity,
            total: self.total,
            shard: table.shard,
            form,
            columns: &self.columns,
            line: &|i| (self.line)(i, form),
            tell: &tell,
        };
        if stream {
            let summary = batch.write(&table.output)?;
            bar.finish_and_clear();
            return Ok(code(&summary));
        }
        outcome::goes_on();
        let mut finished = batch.finish(&table.output)?;
        bar.finish_and_clear();
        let mut written = match plot {
            Some(plot) => plot(&finished.bytes()?, form)?,
            None => Vec::new(),
        };
        let meta = self.meta(table.shard, &finished.summary, finished.crc32);
        let bytes = meta.bytes().map_err(|e| Failure::input(e.to_string()))?;
        replace::write(&Meta::beside(&table.output), &bytes)?;
        let summary = finished.summary.clone();
        finished.publish(&table.output)?; // last: where the table is, all is
        written.insert(0, table.output.clone());
        let names: Vec<String> = written.iter().map(|p| p.display().to_string()).collect();
        let failed = if summary.failed > 0 { format!(", {} failed", summary.failed) } else { String::new() };
        console.note(&format!("wrote {}: {} rows{failed}", names.join(", "), summary.rows));
        Ok(code(&summary))
    }

    fn meta(&self, shard: Shard, summary: &Summary, crc32: u32) -> Meta {
        Meta {
            program: "cutlab".into(),
            version: env!("CARGO_PKG_VERSION").into(),
            command: self.command.clone(),
            seed: self.plan.seed,
            study: self.identity.clone(),
            columns: self.columns.clone(),
            total: self.total,
            shard: (shard != Shard::WHOLE).then_some(shard),
            summary: summary.clone(),
            crc32: format!("{crc32:08x}"),
            metrics: Meta::definitions(self.plan),
        }
    }
}

/// What to say of a row with an error.
pub fn complaint(stone: &str, row: &Row) -> Option<String> {
    let error = row.error.as_ref()?;
    Some(if error.contains(stone) { error.clone() } else { format!("{stone}: {error}") })
}

/// Done, or how many failed: a row whose error was not reached still has its scores.
pub fn code(summary: &Summary) -> Code {
    match summary.failed {
        0 if summary.short == 0 => Code::Done,
        n if n < summary.rows => Code::SomeFailed,
        n if n == summary.unreadable => Code::Io,
        _ => Code::NoGoodInput,
    }
}

impl From<TableError> for Failure {
    fn from(error: TableError) -> Failure {
        Failure::input(error.to_string())
    }
}

impl From<BatchError> for Failure {
    fn from(error: BatchError) -> Failure {
        match error {
            BatchError::Write(error) => error.into(),
            BatchError::Table(error) => error.into(),
        }
    }
}
