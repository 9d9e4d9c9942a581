//! The parts of a table, joined into the bytes that one machine would have written.

use super::batch::Summary;
use super::meta::Meta;
use super::shard::Shard;
use super::table::{Form, RowReader, TableError};
use crate::store::limits;
use crate::store::progress::Progress;
use crate::store::replace::{self, WriteError};
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};

/// One part: a table and what its companion says of it.
#[derive(Debug, Clone)]
pub struct Part {
    /// The table.
    pub table: PathBuf,
    /// Its companion.
    pub meta: Meta,
    form: Form,
}

/// Parts that cannot be joined.
#[derive(Debug, thiserror::Error)]
pub enum MergeError {
    /// The operating system refused.
    #[error("cannot read {path}: {cause}")]
    Read {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        cause: std::io::Error,
    },
    /// A companion that is none.
    #[error("{0} is not the companion of a table that cutlab wrote: {1}")]
    Meta(PathBuf, String),
    /// A table that is not what its companion says.
    #[error("{0} is not as it was written: its checksum is not the one in {1}")]
    Changed(PathBuf, PathBuf),
    /// A whole table.
    #[error("{0} is a whole table already, no part of one")]
    Whole(PathBuf),
    /// Parts of different tables.
    #[error("{0} and {1} are parts of different tables: {2}")]
    Strangers(PathBuf, PathBuf, String),
    /// The same part twice.
    #[error("{0} and {1} are both shard {2}")]
    Twice(PathBuf, PathBuf, Shard),
    /// Parts that are not there.
    #[error("{}", missing(.0, *.1))]
    Missing(Vec<Shard>, u64),
    /// The operating system refused.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A row that cannot be read.
    #[error(transparent)]
    Table(#[from] TableError),
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

impl Part {
    /// The part in the file `table`, with its companion beside it.
    pub fn open(table: &Path) -> Result<Part, MergeError> {
        let form = Form::of(table)?;
        let beside = Meta::beside(table);
        let fail = |path: &Path, cause| MergeError::Read { path: path.to_owned(), cause };
        let sum = limits::regular(table).and_then(checksum).map_err(|e| fail(table, e))?;
        let wrong = |e: String| MergeError::Meta(beside.clone(), e);
        let text = limits::COMPANION.read_regular(&beside).map_err(|e| fail(&beside, e))?;
        let text = text.map_err(|e| wrong(e.to_string()))?;
        let meta: Meta = serde_json::from_slice(&text).map_err(|e| wrong(e.to_string()))?;
        if meta.crc32 != format!("{sum:08x}") {
            return Err(MergeError::Changed(table.to_owned(), beside));
        }
        Ok(Part { table: table.to_owned(), meta, form })
    }

    fn shard(&self) -> Shard {
        self.meta.shard.unwrap_or(Shard::WHOLE)
    }
}

fn checksum(file: File) -> std::io::Result<u32> {
    let (mut sum, mut piece) = (crc32fast::Hasher::new(), vec![0; 1 << 16]);
    let mut file = file;
    loop {
        match file.read(&mut piece)? {
            0 => return Ok(sum.finalize()),
            n => sum.update(&piece[..n]),
        }
    }
}

/// Joins the parts into `output` with its companion; what the whole table comes to.
///
/// Refuses parts of different tables, parts given twice and parts that changed, and names those that
/// are missing. Checked in `tests/sweep.rs`.
pub fn merge(parts: &[Part], output: &Path) -> Result<Meta, MergeError> {
    let mut parts: Vec<&Part> = parts.iter().collect();
    parts.sort_by_key(|p| p.shard());
    let Some(first) = parts.first().copied() else { return Err(MergeError::Missing(Vec::new(), 0)) };
    for part in &parts {
        let strangers = |why: String| MergeError::Strangers(first.table.clone(), part.table.clone(), why);
        if part.meta.shard.is_none() {
            return Err(MergeError::Whole(part.table.clone()));
        }
        if (part.meta.study.as_str(), part.form) != (first.meta.study.as_str(), first.form) {
            let why = match () {
                () if part.meta.version != first.meta.version => "by different versions of cutlab".into(),
                () if part.meta.command != first.meta.command => {
                    format!("'{}' and '{}'", first.meta.command, part.meta.command)
                }
                () if part.form != first.form => "in different forms".into(),
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
    let mut summary = Summary::default();
    parts.iter().for_each(|p| summary.join(&p.meta.summary));
    let mut meta = Meta { shard: None, summary, ..first.meta.clone() };
    // the lock of everyone who makes a table here
    let lock = Progress::open(&Progress::beside(output), &format!("merge {}", meta.study), &|_| ())?;
    replace::stream(output, |out| {
        let mut sum = crc32fast::Hasher::new();
        let fail = |cause| WriteError { path: output.to_owned(), cause };
        let mut put = |bytes: &[u8]| {
            sum.update(bytes);
            out.write_all(bytes).map_err(fail)
        };
        let broken = |e: String| fail(std::io::Error::other(e));
        let mut readers = Vec::new();
        for part in &parts {
            let file = File::open(&part.table).map_err(fail)?;
            let reader = RowReader::new(part.form, BufReader::new(file));
            readers.push(reader.map_err(|e| broken(e.to_string()))?);
        }
        put(&first.form.head(&meta.columns).map_err(|e| broken(e.to_string()))?)?;
        for i in 0..total {
            let reader = &mut readers[(i % of) as usize];
            let row = reader.row().map_err(|e| broken(e.to_string()))?;
            let part = &parts[(i % of) as usize].table;
            put(first.form.before(i))?;
            put(&row.ok_or_else(|| broken(format!("{} ends before its rows do", part.display())))?)?;
        }
        put(first.form.tail(total))?;
        meta.crc32 = format!("{:08x}", sum.finalize());
        Ok(())
    })?;
    let bytes = meta.bytes().map_err(|e| TableError::Row(e.to_string()))?;
    replace::write(&Meta::beside(output), &bytes)?;
    lock.finish()?;
    Ok(meta)
}
