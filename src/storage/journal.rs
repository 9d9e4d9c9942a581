//! Journals: records of finished work, appended beside its output, which survive a kill at any moment.
//!
//! The file is an append-only list of records, each with its checksum, headed by the identity of
//! the work. One process at a time has it, by a lock that ends with the process.

use super::atomic_write::WriteError;
use super::{bounded_read, lock};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// First word of the file, with the version of its form.
const MAGIC: &str = "cutlab-progress-2";

/// No record is longer: a length beyond it is no length.
const LONGEST: u64 = 1 << 24;

/// A progress file that this process has to itself.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
    start: u64,
    done: DonePositions,
}

/// Which positions are done: all below `all`, and some above it.
#[derive(Debug, Default)]
struct DonePositions {
    all: u64,
    beyond: BTreeSet<u64>,
}

impl DonePositions {
    fn insert(&mut self, position: u64) {
        self.beyond.insert(position);
        while self.beyond.remove(&self.all) {
            self.all += 1;
        }
    }
}

/// What may be worth telling while a progress file is opened.
#[derive(Debug, Clone, PartialEq)]
pub enum JournalRemark {
    /// Another process has it; this one waits until that has ended.
    Waiting,
    /// What was there is of no use here and was moved to the path given, with the reason.
    Quarantined(PathBuf, &'static str),
}

/// What a file turned out to hold.
enum JournalContent {
    /// Records of this work, up to `end`; whatever follows was torn off by a kill.
    Good { start: u64, end: u64, done: DonePositions },
    /// Not a progress file of this work, and why.
    Useless(&'static str),
}

impl Journal {
    /// Where the progress of an output is kept: `.NAME.progress` beside it.
    pub fn path_for(output: &Path) -> PathBuf {
        lock::sidecar_path(output, "progress")
    }

    /// Whether there is progress of the work called `identity` at `path`.
    pub fn belongs_to(path: &Path, identity: &str) -> bool {
        let file = bounded_read::open_regular(path).ok();
        let first = file.and_then(|file| record(&mut BufReader::new(file)).ok());
        matches!(first, Some(JournalRecord::Whole { key, .. }) if key == format!("{MAGIC} {identity}"))
    }

    /// Opens the progress of the work called `identity`, or begins it; waits while another process
    /// has it.
    ///
    /// A file that is broken or of other work is moved aside, never used and never overwritten by
    /// this work. Checked in `tests/progress.rs`.
    pub fn open(path: &Path, identity: &str, tell: &dyn Fn(JournalRemark)) -> Result<Journal, WriteError> {
        let fail = |cause| WriteError { path: path.to_owned(), cause };
        let head = format!("{MAGIC} {identity}");
        loop {
            let mut file = lock::acquire(path, &|| tell(JournalRemark::Waiting)).map_err(fail)?;
            match content(&mut file, &head).map_err(fail)? {
                JournalContent::Good { start, end, done } => {
                    file.set_len(end).and_then(|()| file.seek(SeekFrom::Start(end))).map_err(fail)?;
                    let mut progress = Journal { path: path.to_owned(), file, start, done };
                    if end == 0 {
                        progress.start = progress.write_record(&head, b"")?;
                    }
                    return Ok(progress);
                }
                JournalContent::Useless(why) => {
                    let aside = free_place(path);
                    std::fs::rename(path, &aside).map_err(fail)?;
                    tell(JournalRemark::Quarantined(aside, why));
                }
            }
        }
    }

    /// How many records there are.
    pub fn count(&self) -> u64 {
        self.done.all + self.done.beyond.len() as u64
    }

    /// The positions that are there beyond the first that is missing.
    pub fn beyond(&self) -> BTreeSet<u64> {
        self.done.beyond.clone()
    }

    /// The first position that is missing.
    pub fn missing_from(&self) -> u64 {
        self.done.all
    }

    /// Adds the record at `position`, in one write.
    pub fn append(&mut self, position: u64, payload: &[u8]) -> Result<(), WriteError> {
        self.write_record(&position.to_string(), payload)?;
        self.done.insert(position);
        Ok(())
    }

    /// Writes a record; its length in bytes.
    fn write_record(&mut self, key: &str, payload: &[u8]) -> Result<u64, WriteError> {
        let mut record = format!("{:08x} {} {key}\n", checksum(key, payload), payload.len()).into_bytes();
        record.extend_from_slice(payload);
        record.push(b'\n');
        let written = self.file.write_all(&record);
        written.map_err(|cause| WriteError { path: self.path.clone(), cause })?;
        Ok(record.len() as u64)
    }

    /// Gives the payloads in the order of their positions. Memory holds only those that were added
    /// before their turn.
    pub fn for_each(&mut self, mut take: impl FnMut(&[u8]) -> std::io::Result<()>) -> Result<(), WriteError> {
        let fail = |cause| WriteError { path: self.path.clone(), cause };
        let end = self.file.seek(SeekFrom::End(0)).map_err(fail)?;
        let mut read = || {
            let mut reader = BufReader::new(&self.file);
            reader.seek(SeekFrom::Start(self.start))?;
            let (mut next, mut early) = (0, BTreeMap::new());
            while let JournalRecord::Whole { key, payload, .. } = record(&mut reader)? {
                early.insert(key.parse::<u64>().unwrap_or(u64::MAX), payload);
                while let Some(payload) = early.remove(&next) {
                    take(&payload)?;
                    next += 1;
                }
            }
            Ok(())
        };
        read().map_err(fail)?;
        self.file.seek(SeekFrom::Start(end)).map_err(fail)?;
        Ok(())
    }

    /// The work is done and its output is in place: takes the file away.
    pub fn finish(self) -> Result<(), WriteError> {
        std::fs::remove_file(&self.path).map_err(|cause| WriteError { path: self.path, cause })
    }
}

/// Where a file of progress is set aside: beside it, over no other.
fn free_place(path: &Path) -> PathBuf {
    let first = path.with_extension("progress-set-aside");
    let numbered = |n| path.with_extension(format!("progress-set-aside-{n}"));
    let is_free = |place: &PathBuf| place.symlink_metadata().is_err();
    std::iter::once(first.clone()).chain((2..1000).map(numbered)).find(is_free).unwrap_or(first)
}

fn checksum(key: &str, payload: &[u8]) -> u32 {
    let mut sum = crc32fast::Hasher::new();
    sum.update(key.as_bytes());
    sum.update(b"\n");
    sum.update(payload);
    sum.finalize()
}

/// One record as it stands in the file.
enum JournalRecord {
    Whole {
        key: String,
        payload: Vec<u8>,
        length: u64,
    },
    /// The file ends before the record does, or with it.
    Ends,
    Broken,
}

fn record(reader: &mut impl BufRead) -> std::io::Result<JournalRecord> {
    let mut line = Vec::new();
    reader.by_ref().take(4096).read_until(b'\n', &mut line)?;
    if line.last() != Some(&b'\n') {
        return Ok(if line.len() < 4096 { JournalRecord::Ends } else { JournalRecord::Broken });
    }
    let Some((sum, length, key)) = std::str::from_utf8(&line).ok().and_then(parts) else {
        return Ok(JournalRecord::Broken);
    };
    let mut payload = Vec::new();
    reader.by_ref().take(length + 1).read_to_end(&mut payload)?;
    match payload.pop() {
        Some(b'\n') if payload.len() as u64 == length && checksum(&key, &payload) == sum => {
            Ok(JournalRecord::Whole { key, payload, length: line.len() as u64 + length + 1 })
        }
        Some(_) if payload.len() as u64 == length => Ok(JournalRecord::Broken),
        _ => Ok(JournalRecord::Ends),
    }
}

/// Checksum, payload's length and key of a record's first line.
fn parts(line: &str) -> Option<(u32, u64, String)> {
    let (sum, rest) = line.trim_end_matches('\n').split_once(' ')?;
    let (length, key) = rest.split_once(' ')?;
    let length = length.parse().ok().filter(|n| *n <= LONGEST)?;
    Some((u32::from_str_radix(sum, 16).ok()?, length, key.to_owned()))
}

fn content(file: &mut File, head: &str) -> std::io::Result<JournalContent> {
    file.seek(SeekFrom::Start(0))?;
    let mut reader = BufReader::new(&*file);
    let start = match record(&mut reader)? {
        JournalRecord::Ends => {
            return Ok(JournalContent::Good { start: 0, end: 0, done: DonePositions::default() });
        }
        JournalRecord::Whole { key, length, .. } if key == head => length,
        JournalRecord::Whole { .. } => {
            return Ok(JournalContent::Useless("it is of another command or other inputs"));
        }
        JournalRecord::Broken => return Ok(JournalContent::Useless("it is broken")),
    };
    let (mut end, mut done) = (start, DonePositions::default());
    loop {
        match record(&mut reader)? {
            JournalRecord::Ends => return Ok(JournalContent::Good { start, end, done }),
            JournalRecord::Broken => return Ok(JournalContent::Useless("it is broken")),
            JournalRecord::Whole { key, length, .. } => {
                let Ok(position) = key.parse() else { return Ok(JournalContent::Useless("it is broken")) };
                done.insert(position);
                end += length;
            }
        }
    }
}
