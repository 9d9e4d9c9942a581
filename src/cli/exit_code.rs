//! Exit codes, and errors of one line.

use crate::design::CutError;
use crate::formats::FormatError;
use crate::geometry::SolidError;
use crate::geometry::facet_recovery::RecoverError;
use crate::photons::map_file::MapFileError;
use crate::render::RenderError;
use crate::scene::SceneError;
use crate::stone::StoneError;
use crate::storage::atomic_write::WriteError;
use crate::storage::find_files::FindError;
use crate::storage::terminal::one_line;
pub use crate::storage::terminal::printable;
use crate::storage::text::display_name;
use std::ffi::OsString;
use std::io::{ErrorKind, IsTerminal, Write};
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

/// Exit code after an interrupt (from the keyboard, SIGTERM, SIGHUP): 128 + SIGINT, as shells have it.
const INTERRUPTED: i32 = 130;

/// Whether this command, started again, goes on where it was.
static RESUMABLE: AtomicBool = AtomicBool::new(false);

/// Marks the command as resumable: from here on it keeps what it has done, and an interrupt says so.
pub fn mark_resumable() {
    RESUMABLE.store(true, Ordering::Relaxed);
}

/// Ends after an interrupt, with one line.
pub fn interrupted() -> ! {
    if std::io::stderr().is_terminal() {
        let _ = writeln!(std::io::stderr()); // below the progress bar
    }
    let on = RESUMABLE.load(Ordering::Relaxed);
    complain(if on { "interrupted; the same command goes on where it was" } else { "interrupted" });
    std::process::exit(INTERRUPTED)
}

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

/// A command that ends early, and why.
#[derive(Debug)]
pub struct CliError {
    code: ExitStatus,
    message: String,
    shape: Option<Box<MeshFacts>>,
}

/// What is known of a file that was understood but holds no convex stone.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshFacts {
    /// The file's format.
    pub format: &'static str,
    /// How many facets it lists, if it lists facets.
    pub facets: Option<usize>,
    /// Whether its surface closes.
    pub closed: bool,
    /// Whether it is convex, if that can be said.
    pub convex: Option<bool>,
}

impl CliError {
    /// A wrong argument or unusable input.
    pub fn input(message: impl Into<String>) -> CliError {
        CliError::new(ExitStatus::NoGoodInput, message)
    }

    fn new(code: ExitStatus, message: impl Into<String>) -> CliError {
        CliError { code, message: message.into(), shape: None }
    }

    /// A file or folder that could not be read.
    pub fn reading(path: &str, cause: &std::io::Error) -> CliError {
        CliError::new(code_of(cause), format!("cannot read {path}: {cause}"))
    }

    /// A file that is there already and was not to be replaced.
    pub fn exists(stone: &str, target: &Path) -> CliError {
        let target = display_name(target);
        CliError::new(ExitStatus::Io, format!("{stone}: not written: {target} exists; --force replaces it"))
    }

    /// A file that is there already and that another command made.
    pub fn other_is_there(target: &Path) -> CliError {
        let target = display_name(target);
        CliError::new(
            ExitStatus::Io,
            format!(
                "{target} exists and this command did not make it: --force replaces it, -o names another"
            ),
        )
    }

    /// Standard output could not be written; a reader that went away is no error.
    pub fn output(cause: &std::io::Error) -> CliError {
        if cause.kind() == std::io::ErrorKind::BrokenPipe {
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

    /// The shape of a file that holds no convex stone; none for every other failure.
    pub fn shape(&self) -> Option<&MeshFacts> {
        self.shape.as_deref()
    }

    /// Says it on standard error and gives the exit code.
    pub fn report(&self) -> ExitCode {
        if !self.message.is_empty() {
            complain(&self.message());
        }
        self.code.into()
    }
}

impl From<WriteError> for CliError {
    fn from(error: WriteError) -> CliError {
        let gone = error.cause.kind() == std::io::ErrorKind::BrokenPipe;
        if gone || error.path == Path::new("-") {
            return CliError::output(&error.cause);
        }
        CliError::new(ExitStatus::Io, error.to_string())
    }
}

impl From<FormatError> for CliError {
    fn from(error: FormatError) -> CliError {
        match error {
            FormatError::Write(error) => error.into(),
            FormatError::Read { ref cause, .. } => CliError::new(code_of(cause), error.to_string()),
            _ => CliError { shape: shape_of(&error).map(Box::new), ..CliError::input(error.to_string()) },
        }
    }
}

/// A name that leads to no file is a wrong argument; a file that is there and cannot be read is not.
fn code_of(cause: &std::io::Error) -> ExitStatus {
    match cause.kind() {
        ErrorKind::NotFound | ErrorKind::NotADirectory | ErrorKind::IsADirectory => ExitStatus::NoGoodInput,
        _ => ExitStatus::Io,
    }
}

fn shape_of(error: &FormatError) -> Option<MeshFacts> {
    let FormatError::NoStone { format, facets, cause } = error else { return None };
    let (closed, convex) = match &**cause {
        FormatError::Solid { cause: SolidError::Open { .. }, .. } => (false, Some(true)),
        FormatError::Mesh { cause: RecoverError::Open(_), .. } => (false, None),
        FormatError::Mesh { cause: RecoverError::NotConvex(_) | RecoverError::Shells(_), .. } => {
            (true, Some(false))
        }
        _ => return None,
    };
    Some(MeshFacts { format, facets: *facets, closed, convex })
}

impl From<StoneError> for CliError {
    fn from(error: StoneError) -> CliError {
        match error {
            StoneError::Format(error) => (*error).into(),
            StoneError::Find(FindError::Read { ref cause, .. }) => {
                CliError::new(code_of(cause), error.to_string())
            }
            StoneError::NotConvex(ref cause) => {
                let shape = if let StoneError::Format(cause) = &**cause { shape_of(cause) } else { None };
                CliError { shape: shape.map(Box::new), ..CliError::input(error.to_string()) }
            }
            _ => CliError::input(error.to_string()),
        }
    }
}

impl From<RenderError> for CliError {
    fn from(error: RenderError) -> CliError {
        match error {
            RenderError::Stone(error) => (*error).into(),
            RenderError::Scene(error) => error.into(),
            RenderError::PhotonMap(error) => error.into(),
            RenderError::Write(error) => error.into(),
            _ => CliError::input(error.to_string()),
        }
    }
}

impl From<MapFileError> for CliError {
    fn from(error: MapFileError) -> CliError {
        match error {
            MapFileError::Write(cause) => cause.into(),
            MapFileError::Read { ref cause, .. } => CliError::new(code_of(cause), error.to_string()),
            _ => CliError::input(error.to_string()),
        }
    }
}

impl From<SceneError> for CliError {
    fn from(error: SceneError) -> CliError {
        match error {
            SceneError::Read { ref cause, .. } => CliError::new(code_of(cause), error.to_string()),
            _ => CliError::input(error.to_string()),
        }
    }
}

impl From<CutError> for CliError {
    fn from(error: CutError) -> CliError {
        CliError::input(error.to_string())
    }
}

impl From<SolidError> for CliError {
    fn from(error: SolidError) -> CliError {
        CliError::input(error.to_string())
    }
}

/// One line on standard error; nobody there to read it is no reason to fail.
pub fn complain(message: &str) {
    let _ = writeln!(std::io::stderr(), "cutlab: {}", one_line(message));
}

/// Ends after the argument parser: help and version go to standard output, an error becomes one
/// line that ends in what to type next.
pub fn usage(error: &clap::Error, command: &clap::Command) -> ExitCode {
    use clap::error::ErrorKind;
    let asked = matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion);
    if asked || error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        return match error.print() {
            Err(cause) if asked => CliError::output(&cause).report(),
            _ => if asked { ExitStatus::Done } else { ExitStatus::NoGoodInput }.into(),
        };
    }
    let text = error.to_string();
    let said: Vec<&str> = text
        .lines()
        .map(str::trim)
        .take_while(|line| !line.starts_with("Usage:") && !line.starts_with("For more"))
        // no option is meant as a value
        .filter(|line| !line.is_empty() && !line.starts_with("tip: to pass"))
        .collect();
    let said = said.join(" ").replace(" tip: ", "; ");
    let said = said.strip_prefix("error: ").unwrap_or(&said);
    complain(&format!("{said}; see {}", help_command(command)));
    ExitStatus::NoGoodInput.into()
}

/// The help command nearest to what was typed.
fn help_command(command: &clap::Command) -> String {
    let typed: Vec<OsString> = std::env::args_os().skip(1).collect();
    let sub = command.get_subcommands().map(clap::Command::get_name).find(|s| typed.iter().any(|t| t == s));
    sub.map_or_else(|| "cutlab --help".into(), |s| format!("cutlab {s} --help"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_one_line_and_a_closed_pipe_is_none() {
        assert_eq!(CliError::input("a\n  b\n").message(), "a; b");
        assert_eq!(CliError::input("a\x1b[31m\tb\rc\u{9b}").message(), "a\\u{1b}[31m\\tb\\rc\\u{9b}");
        let gone = std::io::Error::from(std::io::ErrorKind::BrokenPipe);
        assert_eq!(CliError::output(&gone).code(), ExitStatus::Done);
        assert!(CliError::output(&gone).message().is_empty());
        let full = std::io::Error::from(std::io::ErrorKind::StorageFull);
        assert_eq!(CliError::output(&full).code(), ExitStatus::Io);
    }
}
