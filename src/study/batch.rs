//! Long tables: rows computed in parallel, kept as they come, put together at the end.

use super::shard::Shard;
use super::table::{Form, TableError};
use crate::store::progress::{Progress, Remark};
use crate::store::replace::{self, WriteError};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// Rows that are in the making together. No row is begun before all of the window before it are
/// done, so memory does not grow with the table; long rows at its end share their threads.
const WINDOW: u64 = 256;

/// How a row came out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// As asked for.
    Good,
    /// It has scores, and an error that says what is short about them.
    Short,
    /// No scores: the stone is none, or cannot be lit.
    Bad,
    /// No scores: the file could not be read.
    Unreadable,
}

const OUTCOMES: [(Outcome, &str); 4] = [
    (Outcome::Good, "good"),
    (Outcome::Short, "short"),
    (Outcome::Bad, "bad"),
    (Outcome::Unreadable, "unreadable"),
];

/// One finished row.
#[derive(Debug, Clone)]
pub struct Line {
    /// How it came out.
    pub outcome: Outcome,
    /// Points traced for it, by experiment.
    pub samples: Vec<(String, u64)>,
    /// The row as it stands in the table, without the line's end.
    pub text: Vec<u8>,
    /// What to say when it is done, if something went wrong.
    pub complaint: Option<String>,
    /// What to say once, however many rows say it: scores that do not apply.
    pub note: Option<String>,
}

impl Line {
    /// As a record of progress: a line of what is to be summed up, then the text.
    fn record(&self) -> Vec<u8> {
        let name = OUTCOMES.iter().find(|(o, _)| *o == self.outcome).map_or("", |(_, name)| name);
        let samples: String = self.samples.iter().map(|(of, n)| format!(" {of}={n}")).collect();
        [format!("{name}{samples}\n").as_bytes(), &self.text].concat()
    }

    /// What [`Line::record`] made; none if it did not.
    fn parsed(record: &[u8]) -> Option<Line> {
        let cut = record.iter().position(|b| *b == b'\n')?;
        let mut words = std::str::from_utf8(&record[..cut]).ok()?.split(' ');
        let name = words.next()?;
        let outcome = OUTCOMES.iter().find(|(_, n)| *n == name)?.0;
        let sample = |word: &str| {
            let (of, n) = word.split_once('=')?;
            Some((of.to_owned(), n.parse().ok()?))
        };
        let samples = words.map(sample).collect::<Option<_>>()?;
        Some(Line { outcome, samples, text: record[cut + 1..].to_vec(), complaint: None, note: None })
    }
}

/// Points traced for the rows of a table, of one experiment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Samples {
    /// Of the row with fewest.
    pub least: u64,
    /// Of the row with most.
    pub most: u64,
    /// Of all rows together.
    pub total: u64,
}

/// What a table comes to.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Its rows.
    pub rows: u64,
    /// Rows with scores and an error.
    pub short: u64,
    /// Rows without scores.
    pub failed: u64,
    /// Those of them whose file could not be read.
    pub unreadable: u64,
    /// Points traced, by experiment.
    pub samples: BTreeMap<String, Samples>,
}

impl Summary {
    fn add(&mut self, line: &Line) {
        self.rows += 1;
        self.short += u64::from(line.outcome == Outcome::Short);
        self.failed += u64::from(matches!(line.outcome, Outcome::Bad | Outcome::Unreadable));
        self.unreadable += u64::from(line.outcome == Outcome::Unreadable);
        for (of, n) in &line.samples {
            self.count(of, Samples { least: *n, most: *n, total: *n });
        }
    }

    fn count(&mut self, of: &str, n: Samples) {
        let sum = self.samples.entry(of.to_owned()).or_insert(Samples { least: n.least, most: 0, total: 0 });
        let total = sum.total.saturating_add(n.total);
        *sum = Samples { least: sum.least.min(n.least), most: sum.most.max(n.most), total };
    }

    /// Adds what another part of the table comes to, whatever its file says that it does.
    pub fn join(&mut self, other: &Summary) {
        for (sum, n) in [
            (&mut self.rows, other.rows),
            (&mut self.short, other.short),
            (&mut self.failed, other.failed),
            (&mut self.unreadable, other.unreadable),
        ] {
            *sum = sum.saturating_add(n);
        }
        other.samples.iter().for_each(|(of, n)| self.count(of, *n));
    }
}

/// A table that could not be made.
#[derive(Debug, thiserror::Error)]
pub enum BatchError {
    /// The operating system refused.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A row that does not fit the form.
    #[error(transparent)]
    Table(#[from] TableError),
}

/// What may be worth telling while a table is made.
#[derive(Debug)]
pub enum Event<'a> {
    /// About the file of progress.
    Remark(Remark),
    /// So many rows of so many are there from an earlier start.
    Begins {
        /// Rows done.
        done: u64,
        /// Rows in all.
        rows: u64,
    },
    /// A row is done.
    Row(&'a Line),
}

/// A table to be made.
pub struct Batch<'a> {
    /// What the table is a function of: see [`super::identity`].
    pub identity: &'a str,
    /// Rows of the whole table.
    pub total: u64,
    /// The part of them to make.
    pub shard: Shard,
    /// How it is written.
    pub form: Form,
    /// Its columns.
    pub columns: &'a [String],
    /// Makes the row number `i` of the whole table, the same whenever and wherever it is called.
    pub line: &'a (dyn Fn(u64) -> Result<Line, TableError> + Sync),
    /// Hears how it goes on.
    pub tell: &'a (dyn Fn(Event) + Sync),
}

impl Batch<'_> {
    /// Writes the table to a stream ([`replace::is_stream`]), row after row as they are done, in their
    /// order.
    pub fn write(&self, output: &Path) -> Result<Summary, BatchError> {
        let fail = |cause| WriteError { path: output.to_owned(), cause };
        let mut out = replace::open_stream(output)?;
        let rows = self.shard.rows(self.total);
        (self.tell)(Event::Begins { done: 0, rows });
        let mut put = |bytes: &[u8]| out.write_all(bytes).map_err(fail);
        put(&self.form.head(self.columns)?)?;
        let (mut next, mut early, mut summary) = (0, BTreeMap::new(), Summary::default());
        self.compute(
            |_| false,
            |position, line| {
                early.insert(position, line);
                while let Some(line) = early.remove(&next) {
                    put(self.form.before(next))?;
                    put(&line.text)?;
                    summary.add(&line);
                    next += 1;
                }
                Ok(())
            },
        )?;
        put(self.form.tail(rows))?;
        out.flush().map_err(fail)?;
        Ok(summary)
    }

    /// Makes the rows of the table at `output` that are not made yet; each is kept beside it as
    /// soon as it is done. [`Finished::publish`] then puts the table in place.
    pub fn finish(&self, output: &Path) -> Result<Finished, BatchError> {
        let identity = format!("{} {} {:?}", self.identity, self.shard, self.form);
        let tell = |remark| (self.tell)(Event::Remark(remark));
        let mut progress = Progress::open(&Progress::beside(output), &identity, &tell)?;
        let rows = self.shard.rows(self.total);
        (self.tell)(Event::Begins { done: progress.count(), rows });
        let (from, had) = (progress.missing_from(), progress.beyond());
        self.compute(
            |p| p < from || had.contains(&p),
            |position, line| progress.append(position, &line.record()),
        )?;
        let mut finished = Finished {
            progress,
            form: self.form,
            head: self.form.head(self.columns)?,
            rows,
            summary: Summary::default(),
            crc32: 0,
        };
        let (mut summary, mut sum) = (Summary::default(), crc32fast::Hasher::new());
        finished.compose(
            &mut |bytes| {
                sum.update(bytes);
                Ok(())
            },
            &mut |line| summary.add(line),
        )?;
        (finished.summary, finished.crc32) = (summary, sum.finalize());
        Ok(finished)
    }

    /// Makes the rows that are not `had`, on all threads, and hands each over as it is done.
    fn compute(
        &self,
        had: impl Fn(u64) -> bool + Sync,
        take: impl FnMut(u64, Line) -> Result<(), WriteError> + Send,
    ) -> Result<(), BatchError> {
        let take = Mutex::new(take);
        let rows = self.shard.rows(self.total);
        for from in (0..rows).step_by(WINDOW as usize) {
            let length = WINDOW.min(rows - from) as usize;
            (0..length).into_par_iter().with_max_len(1).try_for_each(|i| {
                let position = from + i as u64;
                if had(position) {
                    return Ok(());
                }
                let line = (self.line)(self.shard.index(position))?;
                (self.tell)(Event::Row(&line));
                let mut take = take.lock().unwrap_or_else(PoisonError::into_inner);
                Ok::<_, BatchError>(take(position, line)?)
            })?;
        }
        Ok(())
    }
}

/// A table whose rows are all made and kept beside its output.
#[derive(Debug)]
pub struct Finished {
    progress: Progress,
    form: Form,
    head: Vec<u8>,
    rows: u64,
    /// What it comes to.
    pub summary: Summary,
    /// Checksum of its bytes.
    pub crc32: u32,
}

impl Finished {
    /// Gives the table's bytes piece by piece, and its rows.
    fn compose(
        &mut self,
        put: &mut dyn FnMut(&[u8]) -> std::io::Result<()>,
        see: &mut dyn FnMut(&Line),
    ) -> Result<(), WriteError> {
        let (form, mut next) = (self.form, 0);
        let mut all = |bytes: &[u8]| put(bytes);
        let wrap = |cause| WriteError { path: "the table".into(), cause };
        all(&self.head).map_err(wrap)?;
        self.progress.each(|record| {
            let line = Line::parsed(record).ok_or(std::io::ErrorKind::InvalidData)?;
            all(form.before(next))?;
            all(&line.text)?;
            see(&line);
            next += 1;
            Ok(())
        })?;
        all(form.tail(self.rows)).map_err(wrap)
    }

    /// The whole table, for plots.
    pub fn bytes(&mut self) -> Result<Vec<u8>, WriteError> {
        let mut bytes = Vec::new();
        self.compose(&mut |piece| bytes.write_all(piece), &mut |_| ())?;
        Ok(bytes)
    }

    /// Puts the table in its place, whole, and takes the file of progress away.
    pub fn publish(mut self, output: &Path) -> Result<(), WriteError> {
        replace::stream(output, |out| self.compose(&mut |piece| out.write_all(piece), &mut |_| ()))?;
        self.progress.finish()
    }
}
