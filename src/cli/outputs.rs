//! Where results are written: one rule for all commands, applied before the work.
//!
//! - An input is never an output, whatever leads to it.
//! - A file that is there is replaced only if the same command made it, or if it holds just what is
//!   to be written, or with `--force`. The same command is known by the record in the file
//!   ([`crate::render::record`]), or in a table's sidecar.
//! - Every place is tried before anything is computed ([`output_path::check_writable`]).

use super::args::stone;
use super::console::Console;
use super::error::CliError;
use crate::cli::limits::limits;
use crate::stone::StoneSpec;
use crate::storage::atomic_write;
use crate::storage::bounded_read;
use crate::storage::output_path::{self, FileId};
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
    pub fn new(console: &Console) -> Outputs {
        Outputs { force: console.force, ..Outputs::default() }
    }

    /// Of a command that reads these stones.
    pub fn reading_stones<S: AsRef<OsStr>>(
        stones: impl IntoIterator<Item = S>,
        console: &Console,
    ) -> Outputs {
        let mut outputs = Outputs::new(console);
        for stone in stones {
            if let Some(file) = StoneSpec::parse_within(stone, limits()).ok().and_then(|spec| spec.file()) {
                outputs.reads(&file);
            }
        }
        outputs
    }

    /// Adds a file that the command reads.
    pub fn reads(&mut self, file: &Path) {
        self.inputs.extend(FileId::from_path(file).map(|id| (id, stone::display_name(file))));
    }

    /// Takes a place for a file of the command's, or says why it cannot be written.
    ///
    /// - `is_own`: whether a file that is there was made by the same command
    pub fn claim(&mut self, path: &Path, is_own: impl FnOnce(&Path) -> bool) -> Result<(), CliError> {
        if atomic_write::is_stdout(path) && self.claimed.insert("-".into(), path.to_owned()).is_some() {
            return Err(CliError::input("standard output is given for two outputs: name a file for one"));
        }
        if atomic_write::is_stream(path) {
            return Ok(());
        }
        let is_there = output_path::check_writable(path)?;
        self.check_inputs(path)?;
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let real = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
        // a link that is there leads to the place that is written to
        let place = path.canonicalize().unwrap_or_else(|_| real.join(path.file_name().unwrap_or_default()));
        if let Some(other) = self.claimed.insert(place, path.to_owned()) {
            let other = stone::display_name(&other);
            return Err(CliError::input(format!(
                "{other} is given for two outputs: name another file for one"
            )));
        }
        if is_there && !self.force && !is_own(path) {
            return Err(CliError::other_is_there(path));
        }
        Ok(())
    }

    /// Refuses a file that is one of the inputs.
    pub fn check_inputs(&self, path: &Path) -> Result<(), CliError> {
        let id = FileId::from_path(path);
        match self.inputs.iter().find(|(input, _)| id.as_ref() == Some(input)) {
            Some((_, input)) => Err(CliError::input(format!("{input} is an input: write to another file"))),
            None => Ok(()),
        }
    }
}

/// Whether there is a file at `path` of just these bytes.
pub fn has_bytes(path: &Path, bytes: &[u8]) -> bool {
    let mut there = Vec::new();
    let read =
        bounded_read::open_regular(path).and_then(|f| f.take(bytes.len() as u64 + 1).read_to_end(&mut there));
    read.is_ok() && there == bytes
}
