//! Exit codes.

use crate::error::ErrorKind;
use std::process::ExitCode;

/// Exit codes, as the manual lists them (`cutlab help outputs`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExitStatus {
    /// Everything was done.
    Done = 0,
    /// Some stones failed, the rest were done.
    SomeFailed = 1,
    /// The command was not understood, or no input was good.
    NoGoodInput = 2,
    /// Something could not be read or written.
    Io = 3,
}

impl From<ExitStatus> for ExitCode {
    fn from(code: ExitStatus) -> ExitCode {
        ExitCode::from(code as u8)
    }
}

impl From<ErrorKind> for ExitStatus {
    fn from(kind: ErrorKind) -> ExitStatus {
        if kind == ErrorKind::Io { ExitStatus::Io } else { ExitStatus::NoGoodInput }
    }
}
