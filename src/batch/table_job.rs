//! Table jobs: rows computed in parallel, kept as they come, put together at the end.

pub use super::finished_row::{FinishedRow, RowStatus};
use super::shard::Shard;
use super::table::{TableError, TableFormat};
use crate::parallel;
use crate::storage::atomic_write::{self, WriteError};
use crate::storage::journal::{Journal, JournalRemark};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// Rows that are in the making together. No row is begun before all of the window before it are
/// done, so memory does not grow with the table; long rows at its end share their threads.
const WINDOW: u64 = 256;

/// Points traced for the rows of a table, of one estimator.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct SampleCounts {
    /// Of the row with fewest.
    pub least: u64,
    /// Of the row with most.
    pub most: u64,
    /// Of all rows together.
    pub total: u64,
}

/// What a table comes to.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TableSummary {
    /// Its rows.
    pub rows: u64,
    /// Rows with scores and an error.
    pub short: u64,
    /// Rows without scores.
    pub failed: u64,
    /// Those of them whose file could not be read.
    pub unreadable: u64,
    /// Points traced, by estimator.
    pub samples: BTreeMap<String, SampleCounts>,
}

impl TableSummary {
    fn add(&mut self, line: &FinishedRow) {
        self.rows += 1;
        self.short += u64::from(line.outcome == RowStatus::TargetMissed);
        self.failed += u64::from(matches!(line.outcome, RowStatus::Failed | RowStatus::IoError));
        self.unreadable += u64::from(line.outcome == RowStatus::IoError);
        for (of, n) in &line.samples {
            self.count(of, SampleCounts { least: *n, most: *n, total: *n });
        }
    }

    fn count(&mut self, of: &str, n: SampleCounts) {
        let sum =
            self.samples.entry(of.to_owned()).or_insert(SampleCounts { least: n.least, most: 0, total: 0 });
        let total = sum.total.saturating_add(n.total);
        *sum = SampleCounts { least: sum.least.min(n.least), most: sum.most.max(n.most), total };
    }

    /// Adds what another part of the table comes to, whatever its file says that it does.
    pub fn join(&mut self, other: &TableSummary) {
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
pub enum TableJobError {
    /// The operating system refused.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A row that does not fit the form.
    #[error(transparent)]
    Table(#[from] TableError),
}

/// What may be worth telling while a table is made.
#[derive(Debug)]
pub enum JobEvent<'a> {
    /// About the file of progress.
    Remark(JournalRemark),
    /// So many rows of so many are there from an earlier start.
    Begins {
        /// Rows done.
        done: u64,
        /// Rows in all.
        rows: u64,
    },
    /// A row is done.
    Row(&'a FinishedRow),
}

/// The order of a table's rows, and how many of them it has, where they are not all as they are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Order {
    /// Whether the least key comes first.
    pub ascending: bool,
    /// So many rows at most.
    pub top: Option<u64>,
}

impl Order {
    /// The rows in this order: by their keys, equal ones as they were, those without a key last.
    fn applied_to(self, mut lines: Vec<FinishedRow>) -> Vec<FinishedRow> {
        lines.sort_by(|a, b| match (a.key, b.key) {
            (Some(a), Some(b)) if self.ascending => a.total_cmp(&b),
            (Some(a), Some(b)) => b.total_cmp(&a),
            (a, b) => a.is_none().cmp(&b.is_none()),
        });
        lines.truncate(self.top.map_or(usize::MAX, |n| usize::try_from(n).unwrap_or(usize::MAX)));
        lines
    }
}

/// A table to be made.
pub struct TableJob<'a> {
    /// What the table is a function of: see [`super::fingerprint`].
    pub identity: &'a str,
    /// Rows of the whole table.
    pub total: u64,
    /// The part of them to make.
    pub shard: Shard,
    /// How it is written.
    pub form: TableFormat,
    /// Its columns.
    pub columns: &'a [String],
    /// How its rows are sorted, if they are; then they are all held in memory at the end.
    pub order: Option<Order>,
    /// Makes the row number `i` of the whole table, the same whenever and wherever it is called.
    pub line: &'a (dyn Fn(u64) -> Result<FinishedRow, TableError> + Sync),
    /// Hears how it goes on.
    pub tell: &'a (dyn Fn(JobEvent) + Sync),
}

impl TableJob<'_> {
    /// Writes the table to a stream ([`atomic_write::open_stream`]), row after row as they are done, in their
    /// order; sorted rows all at the end.
    ///
    /// - `output`: the stream's name, for errors
    pub fn write(&self, out: &mut (dyn Write + Send), output: &Path) -> Result<TableSummary, TableJobError> {
        let fail = |cause| WriteError { path: output.to_owned(), cause };
        let rows = self.shard.rows(self.total);
        (self.tell)(JobEvent::Begins { done: 0, rows });
        let mut put = |bytes: &[u8]| out.write_all(bytes).map_err(fail);
        put(&self.form.head(self.columns)?)?;
        let (mut next, mut early, mut summary) = (0, BTreeMap::new(), TableSummary::default());
        let mut waiting = Vec::new();
        self.compute(
            |_| false,
            |position, line| {
                early.insert(position, line);
                while let Some(line) = early.remove(&next) {
                    summary.add(&line);
                    if self.order.is_some() {
                        waiting.push(line);
                    } else {
                        put(self.form.before(next))?;
                        put(&line.text)?;
                    }
                    next += 1;
                }
                Ok(())
            },
        )?;
        let mut written = rows;
        if let Some(order) = self.order {
            let lines = order.applied_to(waiting);
            written = lines.len() as u64;
            for (i, line) in (0..).zip(&lines) {
                put(self.form.before(i))?;
                put(&line.text)?;
            }
        }
        put(self.form.tail(written))?;
        out.flush().map_err(fail)?;
        Ok(TableSummary { rows: written, ..summary })
    }

    /// What the progress of the table is kept under.
    fn identity_of_part(&self) -> String {
        format!("{} {} {:?}", self.identity, self.shard, self.form)
    }

    /// Whether an earlier start left progress of this table.
    pub fn is_begun(&self, output: &Path) -> bool {
        Journal::belongs_to(&Journal::path_for(output), &self.identity_of_part())
    }

    /// Opens the progress of the table at `output`, to which this process then has the sole right.
    pub fn begin(&self, output: &Path) -> Result<Journal, TableJobError> {
        let tell = |remark| (self.tell)(JobEvent::Remark(remark));
        Ok(Journal::open(&Journal::path_for(output), &self.identity_of_part(), &tell)?)
    }

    /// Makes the rows of the table at `output` that are not made yet; each is kept beside it as
    /// soon as it is done. [`FinishedTable::publish`] then puts the table in place.
    ///
    /// - `progress`: what [`TableJob::begin`] gave
    pub fn finish(&self, mut progress: Journal, output: &Path) -> Result<FinishedTable, TableJobError> {
        let rows = self.shard.rows(self.total);
        (self.tell)(JobEvent::Begins { done: progress.count(), rows });
        let (from, had) = (progress.missing_from(), progress.beyond());
        let fail = |cause| WriteError { path: output.to_owned(), cause };
        self.compute(
            |p| p < from || had.contains(&p),
            |position, line| progress.append(position, &line.record().map_err(fail)?),
        )?;
        let mut finished = FinishedTable {
            progress,
            form: self.form,
            head: self.form.head(self.columns)?,
            order: self.order,
            summary: TableSummary::default(),
            crc32: 0,
        };
        let (mut summary, mut sum) = (TableSummary::default(), crc32fast::Hasher::new());
        summary.rows = finished.compose(
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
        take: impl FnMut(u64, FinishedRow) -> Result<(), WriteError> + Send,
    ) -> Result<(), TableJobError> {
        let take = Mutex::new(take);
        let rows = self.shard.rows(self.total);
        for from in (0..rows).step_by(WINDOW as usize) {
            let length = WINDOW.min(rows - from) as usize;
            parallel::try_for_each(length, |i| {
                let position = from + i as u64;
                if had(position) {
                    return Ok(());
                }
                let line = (self.line)(self.shard.index(position))?;
                (self.tell)(JobEvent::Row(&line));
                let mut take = take.lock().unwrap_or_else(PoisonError::into_inner);
                Ok::<_, TableJobError>(take(position, line)?)
            })?;
        }
        Ok(())
    }
}

/// A table whose rows are all made and kept beside its output.
#[derive(Debug)]
pub struct FinishedTable {
    progress: Journal,
    form: TableFormat,
    head: Vec<u8>,
    order: Option<Order>,
    /// What it comes to.
    pub summary: TableSummary,
    /// Checksum of its bytes.
    pub crc32: u32,
}

impl FinishedTable {
    /// Gives the table's bytes piece by piece, and all rows that were made; how many the table has.
    fn compose(
        &mut self,
        put: &mut dyn FnMut(&[u8]) -> std::io::Result<()>,
        see: &mut dyn FnMut(&FinishedRow),
    ) -> Result<u64, WriteError> {
        let (form, order, mut next) = (self.form, self.order, 0);
        let mut row = |line: &FinishedRow, put: &mut dyn FnMut(&[u8]) -> std::io::Result<()>| {
            put(form.before(next))?;
            put(&line.text)?;
            next += 1;
            Ok(())
        };
        let wrap = |cause| WriteError { path: "the table".into(), cause };
        put(&self.head).map_err(wrap)?;
        let mut waiting = Vec::new();
        self.progress.for_each(|record| {
            let line = FinishedRow::parse(record)?;
            see(&line);
            if order.is_some() {
                waiting.push(line);
                return Ok(());
            }
            row(&line, put)
        })?;
        if let Some(order) = order {
            order.applied_to(waiting).iter().try_for_each(|line| row(line, put)).map_err(wrap)?;
        }
        put(form.tail(next)).map_err(wrap)?;
        Ok(next)
    }

    /// The whole table, for plots.
    pub fn bytes(&mut self) -> Result<Vec<u8>, WriteError> {
        let mut bytes = Vec::new();
        self.compose(&mut |piece| bytes.write_all(piece), &mut |_| ())?;
        Ok(bytes)
    }

    /// Puts the table in its place, whole, and takes the file of progress away.
    pub fn publish(mut self, output: &Path) -> Result<(), WriteError> {
        atomic_write::stream(output, |out| {
            self.compose(&mut |piece| out.write_all(piece), &mut |_| ()).map(|_| ())
        })?;
        self.progress.finish()
    }
}
