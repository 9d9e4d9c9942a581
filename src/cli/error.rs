//! Errors of commands, each of one line.

mod convex;

use super::exit_code::ExitStatus;
use crate::error::Error;
use crate::formats::MeshFacts;
use crate::storage::atomic_write::WriteError;
use crate::storage::terminal::one_line;
use crate::storage::text::display_name;
use std::io::{ErrorKind, Write};
use std::path::Path;
use std::process::ExitCode;

/// A command that ends early, and why.
#[derive(Debug)]
pub struct CliError {
    code: ExitStatus,
    message: String,
    mesh: Option<MeshFacts>,
}

impl CliError {
    /// A wrong argument or unusable input.
    pub fn input(message: impl Into<String>) -> CliError {
        CliError::new(ExitStatus::NoGoodInput, message)
    }

    fn new(code: ExitStatus, message: impl Into<String>) -> CliError {
        CliError { code, message: message.into(), mesh: None }
    }

    /// A file that is there already and was not to be replaced.
    pub fn exists(stone: &str, target: &Path) -> CliError {
        let target = display_name(target);
        CliError::new(ExitStatus::Io, format!("{stone}: not written: {target} exists; --force replaces it"))
    }

    /// A file that is there already and that another command made.
    pub fn other_is_there(target: &Path) -> CliError {
        let why = "exists and this command did not make it: --force replaces it, -o names another";
        CliError::new(ExitStatus::Io, format!("{} {why}", display_name(target)))
    }

    /// Standard output could not be written; a reader that went away is no error.
    pub fn output(cause: &std::io::Error) -> CliError {
        if cause.kind() == ErrorKind::BrokenPipe {
            CliError::new(ExitStatus::Done, "")
        } else {
            CliError::new(ExitStatus::Io, format!("cannot write to standard output: {cause}"))
        }
    }

    /// What to say, in one line; empty if there is nothing to say.
    pub fn message(&self) -> String {
        one_line(&self.message)
    }

    /// The exit code.
    pub fn code(&self) -> ExitStatus {
        self.code
    }

    /// What is known of a file that holds no convex stone; none for every other failure.
    pub fn mesh(&self) -> Option<MeshFacts> {
        self.mesh
    }

    /// Says it on standard error and gives the exit code.
    pub fn report(&self) -> ExitCode {
        if !self.message.is_empty() {
            complain(&self.message());
        }
        self.code.into()
    }
}

impl<E: Into<Error>> From<E> for CliError {
    fn from(error: E) -> CliError {
        let error = error.into();
        match error.not_written() {
            Some(WriteError { path, cause })
                if cause.kind() == ErrorKind::BrokenPipe || path == Path::new("-") =>
            {
                CliError::output(cause)
            }
            _ => {
                CliError { mesh: error.mesh_facts(), ..CliError::new(error.kind().into(), error.to_string()) }
            }
        }
    }
}

/// One line on standard error; nobody there to read it is no reason to fail.
pub fn complain(message: &str) {
    let _ = writeln!(std::io::stderr(), "cutlab: {}", one_line(message));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_one_line_and_a_closed_pipe_is_none() {
        assert_eq!(CliError::input("a\n  b\n").message(), "a; b");
        assert_eq!(CliError::input("a\x1b[31m\tb\rc\u{9b}").message(), "a\\u{1b}[31m\\tb\\rc\\u{9b}");
        let gone = std::io::Error::from(ErrorKind::BrokenPipe);
        assert_eq!(CliError::output(&gone).code(), ExitStatus::Done);
        assert!(CliError::output(&gone).message().is_empty());
        let full = std::io::Error::from(ErrorKind::StorageFull);
        assert_eq!(CliError::output(&full).code(), ExitStatus::Io);
    }
}
