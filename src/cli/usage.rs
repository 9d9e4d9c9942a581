//! Arguments that are not understood, and those that ask for help.

use super::error::{CliError, complain};
use super::exit_code::ExitStatus;
use clap::error::ErrorKind;
use std::ffi::OsString;
use std::process::ExitCode;

/// Ends after the argument parser: help and version go to standard output, an error becomes one
/// line that ends in what to type next.
pub fn usage(error: &clap::Error, command: &clap::Command) -> ExitCode {
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
