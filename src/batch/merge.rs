//! The parts of a table, joined into the bytes that one machine would have written.

use super::shard::Shard;
use super::sidecar::{TableMeta, checksum};
use super::table::{RowReader, TableError, TableFormat};
use super::table_job::TableSummary;
use crate::limits::{self, Limits};
use crate::storage::atomic_write::{self, WriteError};
use crate::storage::find_files::{self, FindError};
use crate::storage::journal::Journal;
use crate::storage::{bounded_read, text};
use std::ffi::OsString;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// One part: a table and what its sidecar says of it.
#[derive(Debug, Clone)]
pub struct TablePart {
    /// The table.
    pub table: PathBuf,
    /// Its sidecar.
    pub meta: TableMeta,
    /// How it is written.
    pub form: TableFormat,
    /// Its text, if the file has that in another encoding or with other ends of lines.
    decoded: Option<Arc<str>>,
    /// The most that is read of one of its rows.
    limits: Limits,
}

/// Parts that cannot be joined.
#[derive(Debug, thiserror::Error)]
pub enum MergeError {
    /// The operating system refused.
    #[error("cannot read {}: {cause}", text::display_name(.path))]
    Read {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        cause: std::io::Error,
    },
    /// A sidecar that is none.
    #[error("{} is not the sidecar of a table that cutlab wrote: {}", text::display_name(.0), .1)]
    Meta(PathBuf, String),
    /// A table that is not what its sidecar says.
    #[error("{} is not as it was written: its checksum is not the one in {}", text::display_name(.0), text::display_name(.1))]
    Changed(PathBuf, PathBuf),
    /// A whole table.
    #[error("{} is a whole table already, not a part of one", text::display_name(.0))]
    Whole(PathBuf),
    /// Parts of different tables.
    #[error("{} and {} are parts of different tables: {}", text::display_name(.0), text::display_name(.1), .2)]
    DifferentTables(PathBuf, PathBuf, String),
    /// The same part twice.
    #[error("{} and {} are both shard {}", text::display_name(.0), text::display_name(.1), .2)]
    Twice(PathBuf, PathBuf, Shard),
    /// Parts that are not there.
    #[error("{}", missing(.0, *.1))]
    Missing(Vec<Shard>, u64),
    /// A row that is none.
    #[error("{}: {}", text::display_name(.0), .1)]
    Row(PathBuf, String),
    /// A part with fewer rows than its sidecar says.
    #[error("{} ends before its rows do", text::display_name(.0))]
    Short(PathBuf),
    /// The operating system refused.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A row that cannot be read.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A pattern that cannot be searched for, or that no name matches.
    #[error(transparent)]
    Find(#[from] FindError),
    /// A pattern that matches no part.
    #[error("no part of a table matches {0}")]
    NoPart(String),
}

/// The tables that are to be joined: a pattern of names is replaced by what it matches, but for sidecars and whole
/// tables; a name stays as it is.
pub fn part_files(names: &[OsString], limits: Limits) -> Result<Vec<PathBuf>, MergeError> {
    let is_whole = |table: &Path| {
        TableMeta::read(&TableMeta::find_for(table), limits).is_ok_and(|meta| meta.shard.is_none())
    };
    let mut all = Vec::new();
    for name in names {
        if find_files::is_pattern(name) {
            let mut found = find_files::matching(name)?;
            found.retain(|table| !TableMeta::is_sidecar(table) && !is_whole(table));
            if found.is_empty() {
                return Err(MergeError::NoPart(text::display_name(name)));
            }
            all.extend(found);
        } else {
            all.push(name.into());
        }
    }
    Ok(all)
}

/// `shard 2/4 is missing: rows 2, 6, 10 … (25 of 100)`
fn missing(shards: &[Shard], total: u64) -> String {
    let one = |s: &Shard| {
        let rows = s.rows(total);
        let mut named: Vec<String> = (0..rows.min(3)).map(|p| (s.index(p) + 1).to_string()).collect();
        if rows > 3 {
            named.push("…".into());
        }
        format!("shard {s} is missing: rows {} ({rows} of {total})", named.join(", "))
    };
    const SHOWN: usize = 8;
    let mut said: Vec<String> = shards.iter().take(SHOWN).map(one).collect();
    if shards.len() > SHOWN {
        said.push(format!("{} more shards are missing", shards.len() - SHOWN));
    }
    said.join("; ")
}

impl TablePart {
    /// The part in the file `table`, with its sidecar beside it.
    pub fn open(table: &Path, limits: Limits) -> Result<TablePart, MergeError> {
        let form = TableFormat::from_path(table)?;
        let beside = TableMeta::find_for(table);
        let fail = |path: &Path, cause| MergeError::Read { path: path.to_owned(), cause };
        let sum = bounded_read::open_regular(table).and_then(checksum).map_err(|e| fail(table, e))?;
        let wrong = |e: String| MergeError::Meta(beside.clone(), e);
        let bytes = bounded_read::read_regular(&beside, limits, &limits::SIDECAR);
        let bytes = bytes.map_err(|e| fail(&beside, e))?.map_err(|e| wrong(e.to_string()))?;
        let meta: TableMeta =
            serde_json::from_str(&text::decode(&bytes)).map_err(|e| wrong(e.to_string()))?;
        let mut part = TablePart { table: table.to_owned(), meta, form, decoded: None, limits };
        if part.meta.crc32 != sum {
            // an editor may have saved the same text anew
            let text = text::decode(&part.bytes()?).replace("\r\n", "\n");
            if format!("{:08x}", crc32fast::hash(text.as_bytes())) != part.meta.crc32 {
                return Err(MergeError::Changed(table.to_owned(), beside));
            }
            part.decoded = Some(text.into());
        }
        Ok(part)
    }

    /// All bytes of the table.
    pub fn bytes(&self) -> Result<Vec<u8>, MergeError> {
        if let Some(text) = &self.decoded {
            return Ok(text.as_bytes().to_vec());
        }
        std::fs::read(&self.table).map_err(|cause| MergeError::Read { path: self.table.clone(), cause })
    }

    /// A reader of the table.
    fn reader(&self) -> Result<Box<dyn BufRead + '_>, MergeError> {
        if let Some(text) = &self.decoded {
            return Ok(Box::new(text.as_bytes()));
        }
        let file = bounded_read::open_regular(&self.table);
        let file = file.map_err(|cause| MergeError::Read { path: self.table.clone(), cause })?;
        Ok(Box::new(BufReader::new(file)))
    }

    fn shard(&self) -> Shard {
        self.meta.shard.unwrap_or(Shard::WHOLE)
    }
}

/// The parts of one table, all of them, in their order.
#[derive(Debug)]
pub struct TableParts {
    parts: Vec<TablePart>,
    /// What the whole table comes to; its checksum is still to be set.
    pub meta: TableMeta,
}

impl TableParts {
    /// Puts the parts in order.
    ///
    /// Refuses parts of different tables, parts given twice and parts that changed, and names those
    /// that are missing. Checked in `tests/program/score_batches.rs`.
    pub fn new(mut parts: Vec<TablePart>) -> Result<TableParts, MergeError> {
        parts.sort_by_key(TablePart::shard);
        let Some(first) = parts.first() else { return Err(MergeError::Missing(Vec::new(), 0)) };
        for part in &parts {
            let strangers =
                |why: String| MergeError::DifferentTables(first.table.clone(), part.table.clone(), why);
            if part.meta.shard.is_none() {
                return Err(MergeError::Whole(part.table.clone()));
            }
            if part.meta.study != first.meta.study {
                let why = match () {
                    () if part.meta.version != first.meta.version => "by different versions of cutlab".into(),
                    () if part.meta.build != first.meta.build => "by different builds of cutlab".into(),
                    () if part.meta.command != first.meta.command => {
                        format!("'{}' and '{}'", first.meta.command, part.meta.command)
                    }
                    () => "the command is the same, what it read is not".into(),
                };
                return Err(strangers(why));
            }
            if part.shard().of != first.shard().of {
                return Err(strangers(format!("shards {} and {}", first.shard(), part.shard())));
            }
        }
        for pair in parts.windows(2) {
            if pair[0].shard() == pair[1].shard() {
                return Err(MergeError::Twice(pair[0].table.clone(), pair[1].table.clone(), pair[0].shard()));
            }
        }
        let (of, total) = (first.shard().of, first.meta.total);
        let there = |s: &Shard| parts.iter().any(|p| p.shard() == *s);
        let absent: Vec<Shard> =
            (1..=of).map(|number| Shard { number, of }).filter(|s| !there(s) && s.rows(total) > 0).collect();
        if !absent.is_empty() {
            return Err(MergeError::Missing(absent, total));
        }
        let mut summary = TableSummary::default();
        parts.iter().for_each(|p| summary.join(&p.meta.summary));
        let meta = TableMeta { shard: None, summary, ..first.meta.clone() };
        Ok(TableParts { parts, meta })
    }

    /// Gives the bytes of the whole table piece by piece.
    fn compose(
        &self,
        form: TableFormat,
        put: &mut dyn FnMut(&[u8]) -> Result<(), WriteError>,
    ) -> Result<(), MergeError> {
        let (columns, total) = (&self.meta.columns, self.meta.total);
        let mut readers = Vec::new();
        for part in &self.parts {
            readers.push((part, RowReader::new(part.form, part.reader()?, part.limits)?));
        }
        put(&form.head(columns)?)?;
        for i in 0..total {
            let of = readers.len() as u64;
            let (part, reader) = &mut readers[(i % of) as usize];
            let wrong = |e: TableError| MergeError::Row(part.table.clone(), e.to_string());
            let row = reader.row().map_err(wrong)?.ok_or_else(|| MergeError::Short(part.table.clone()))?;
            put(form.before(i))?;
            if part.form == form {
                put(&row)?;
            } else {
                put(&form.row(columns, &part.form.cells(columns, &row).map_err(wrong)?)?)?;
            }
        }
        Ok(put(form.tail(total))?)
    }

    /// All bytes of the whole table.
    pub fn bytes(&self, form: TableFormat) -> Result<Vec<u8>, MergeError> {
        let mut bytes = Vec::new();
        self.compose(form, &mut |piece| {
            bytes.extend_from_slice(piece);
            Ok(())
        })?;
        Ok(bytes)
    }

    /// What the progress of a merge is kept under.
    pub fn identity(&self) -> String {
        format!("merge {}", self.meta.study)
    }

    /// Writes the whole table to a stream ([`atomic_write::is_stream`]).
    pub fn write(&self, form: TableFormat, output: &Path) -> Result<(), MergeError> {
        let fail = |cause| WriteError { path: output.to_owned(), cause };
        let mut out = atomic_write::open_stream(output)?;
        self.compose(form, &mut |piece| out.write_all(piece).map_err(fail))?;
        Ok(out.flush().map_err(fail)?)
    }

    /// Puts the whole table in its place, whole, after its sidecar: where the table is, all is.
    pub fn publish(&mut self, form: TableFormat, output: &Path) -> Result<(), MergeError> {
        // the lock of everyone who makes a table here
        let lock = Journal::open(&Journal::path_for(output), &self.identity(), &|_| ())?;
        let mut wrong = None;
        let fail = |cause| WriteError { path: output.to_owned(), cause };
        let written = atomic_write::stream(output, |out| {
            let mut sum = crc32fast::Hasher::new();
            let composed = self.compose(form, &mut |piece| {
                sum.update(piece);
                out.write_all(piece).map_err(fail)
            });
            if let Err(error) = composed {
                wrong = Some(error);
                return Err(fail(std::io::ErrorKind::InvalidData.into()));
            }
            self.meta.crc32 = format!("{:08x}", sum.finalize());
            let bytes = self.meta.bytes().map_err(|e| fail(e.into()))?;
            atomic_write::write(&TableMeta::path_for(output), &bytes)
        });
        match (wrong, written) {
            (Some(error), _) => Err(error),
            (None, written) => Ok(written.and_then(|()| lock.finish())?),
        }
    }
}
