//! Where results are written: one rule for all commands, applied before the work.
//!
//! - An input is never an output, whatever leads to it.
//! - A file that is there is replaced only if the same command made it, or if it holds just what is
//!   to be written, or with `--force`. The same command is known by the record in the file
//!   ([`record`]), or in a table's companion.
//! - Every place is tried before anything is computed ([`place::tried`]).

pub mod record;

use super::console::Console;
use super::outcome::Failure;
use super::{folders, stones};
use crate::store::limits;
use crate::store::place::{self, FileId};
use crate::store::replace;
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::io::Read;
use std::path::{Path, PathBuf};

/// The files that a command reads and those that it is to write.
#[derive(Debug, Default)]
pub struct Outputs {
    force: bool,
    inputs: Vec<(FileId, String)>,
    claimed: BTreeMap<PathBuf, PathBuf>,
}

impl Outputs {
    /// Of a command that reads nothing yet.
    pub fn of(console: &Console) -> Outputs {
        Outputs { force: console.force, ..Outputs::default() }
    }

    /// Of a command that reads these stones.
    pub fn beside<S: AsRef<OsStr>>(stones: impl IntoIterator<Item = S>, console: &Console) -> Outputs {
        let mut outputs = Outputs::of(console);
        for stone in stones {
            if let Some(file) = folders::file_of(stone.as_ref()) {
                outputs.reads(&file);
            }
        }
        outputs
    }

    /// Adds a file that the command reads.
    pub fn reads(&mut self, file: &Path) {
        self.inputs.extend(FileId::of(file).map(|id| (id, stones::shown(file))));
    }

    /// Takes a place for a file of the command's, or says why it cannot be written.
    ///
    /// - `is_own`: whether a file that is there was made by the same command
    pub fn claim(&mut self, path: &Path, is_own: impl FnOnce(&Path) -> bool) -> Result<(), Failure> {
        if replace::is_stream(path) {
            return Ok(());
        }
        let is_there = place::tried(path)?;
        self.check_inputs(path)?;
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let real = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
        let place = real.join(path.file_name().unwrap_or_default());
        if let Some(other) = self.claimed.insert(place, path.to_owned()) {
            let other = stones::shown(&other);
            return Err(Failure::input(format!(
                "{other} is given for two outputs: name another file for one"
            )));
        }
        if is_there && !self.force && !is_own(path) {
            return Err(Failure::other_is_there(path));
        }
        Ok(())
    }

    /// Refuses a file that is one of the inputs.
    pub fn check_inputs(&self, path: &Path) -> Result<(), Failure> {
        let id = FileId::of(path);
        match self.inputs.iter().find(|(input, _)| id.as_ref() == Some(input)) {
            Some((_, input)) => Err(Failure::input(format!("{input} is an input: write to another file"))),
            None => Ok(()),
        }
    }
}

/// Whether there is a file at `path` of just these bytes.
pub fn holds(path: &Path, bytes: &[u8]) -> bool {
    let mut there = Vec::new();
    let read = limits::regular(path).and_then(|f| f.take(bytes.len() as u64 + 1).read_to_end(&mut there));
    read.is_ok() && there == bytes
}
