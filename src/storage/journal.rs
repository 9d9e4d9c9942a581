//! Journals: records of finished work, appended beside its output, which survive a kill at any moment.
//!
//! The file is an append-only list of records, headed by the identity of the work. A record is a line of JSON
//! with its key, length and checksum, then its payload and the end of a line. One process at a time has the
//! file, by a lock that ends with the process.

use super::atomic_write::WriteError;
use super::{bounded_read, lock};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// Version of the file's form: files of others are set aside.
const VERSION: u32 = 3;

/// No payload is longer, in bytes: a length beyond it is no length.
const LONGEST: u64 = 1 << 24;

/// No record's first line is longer, in bytes.
const LONGEST_HEAD: u64 = 4096;

/// What a record is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
enum RecordKey {
    /// The first record: whose progress the file is.
    Work {
        /// [`VERSION`].
        version: u32,
        /// Of the work.
        identity: String,
    },
    /// The payload of a position.
    Position(u64),
}

impl RecordKey {
    fn of_work(identity: &str) -> RecordKey {
        RecordKey::Work { version: VERSION, identity: identity.into() }
    }
}

/// The first line of a record, as JSON, which has no end of a line inside.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct RecordHead {
    key: RecordKey,
    /// Of the payload, in bytes.
    length: u64,
    /// CRC-32 of the key as JSON, the end of a line, and the payload.
    crc32: u32,
}

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
        matches!(first, Some(JournalRecord::Whole { key, .. }) if key == RecordKey::of_work(identity))
    }

    /// Opens the progress of the work called `identity`, or begins it; waits while another process
    /// has it.
    ///
    /// A file that is broken or of other work is moved aside, never used and never overwritten by
    /// this work. Checked in `tests/library/progress.rs`.
    pub fn open(path: &Path, identity: &str, tell: &dyn Fn(JournalRemark)) -> Result<Journal, WriteError> {
        let fail = |cause| WriteError { path: path.to_owned(), cause };
        let head = RecordKey::of_work(identity);
        loop {
            let mut file = lock::acquire(path, &|| tell(JournalRemark::Waiting)).map_err(fail)?;
            match content(&mut file, &head).map_err(fail)? {
                JournalContent::Good { start, end, done } => {
                    file.set_len(end).and_then(|()| file.seek(SeekFrom::Start(end))).map_err(fail)?;
                    let mut progress = Journal { path: path.to_owned(), file, start, done };
                    if end == 0 {
                        progress.start = progress.write_record(head, b"")?;
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
        self.write_record(RecordKey::Position(position), payload)?;
        self.done.insert(position);
        Ok(())
    }

    /// Writes a record; its length in bytes.
    fn write_record(&mut self, key: RecordKey, payload: &[u8]) -> Result<u64, WriteError> {
        let write = || {
            let crc32 = checksum(&key, payload)?;
            let mut record = serde_json::to_vec(&RecordHead { key, length: payload.len() as u64, crc32 })?;
            record.push(b'\n');
            record.extend_from_slice(payload);
            record.push(b'\n');
            self.file.write_all(&record)?;
            Ok(record.len() as u64)
        };
        write().map_err(|cause| WriteError { path: self.path.clone(), cause })
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
                let RecordKey::Position(position) = key else { break };
                early.insert(position, payload);
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

fn checksum(key: &RecordKey, payload: &[u8]) -> std::io::Result<u32> {
    let mut sum = crc32fast::Hasher::new();
    sum.update(&serde_json::to_vec(key)?);
    sum.update(b"\n");
    sum.update(payload);
    Ok(sum.finalize())
}

/// One record as it stands in the file.
enum JournalRecord {
    Whole {
        key: RecordKey,
        payload: Vec<u8>,
        length: u64,
    },
    /// The file ends before the record does, or with it.
    Ends,
    Broken,
}

fn record(reader: &mut impl BufRead) -> std::io::Result<JournalRecord> {
    let mut line = Vec::new();
    reader.by_ref().take(LONGEST_HEAD).read_until(b'\n', &mut line)?;
    if line.last() != Some(&b'\n') {
        let is_cut = (line.len() as u64) < LONGEST_HEAD;
        return Ok(if is_cut { JournalRecord::Ends } else { JournalRecord::Broken });
    }
    let head = serde_json::from_slice(&line).ok().filter(|head: &RecordHead| head.length <= LONGEST);
    let Some(RecordHead { key, length, crc32 }) = head else { return Ok(JournalRecord::Broken) };
    let mut payload = Vec::new();
    reader.by_ref().take(length + 1).read_to_end(&mut payload)?;
    match payload.pop() {
        Some(b'\n') if payload.len() as u64 == length && checksum(&key, &payload)? == crc32 => {
            Ok(JournalRecord::Whole { key, payload, length: line.len() as u64 + length + 1 })
        }
        Some(_) if payload.len() as u64 == length => Ok(JournalRecord::Broken),
        _ => Ok(JournalRecord::Ends),
    }
}

fn content(file: &mut File, head: &RecordKey) -> std::io::Result<JournalContent> {
    file.seek(SeekFrom::Start(0))?;
    let mut reader = BufReader::new(&*file);
    let start = match record(&mut reader)? {
        JournalRecord::Ends => {
            return Ok(JournalContent::Good { start: 0, end: 0, done: DonePositions::default() });
        }
        JournalRecord::Whole { key, length, .. } if key == *head => length,
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
            JournalRecord::Whole { key: RecordKey::Position(position), length, .. } => {
                done.insert(position);
                end += length;
            }
            JournalRecord::Whole { key: RecordKey::Work { .. }, .. } => {
                return Ok(JournalContent::Useless("it is broken"));
            }
        }
    }
}
