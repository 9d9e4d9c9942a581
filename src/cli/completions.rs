//! `cutlab completions`: scripts by which shells complete commands and options.

use super::console::Console;
use super::error::CliError;
use super::exit_code::ExitStatus;
use crate::storage::atomic_write;
use clap_complete::Shell;
use std::path::Path;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab completions bash > ~/.local/share/bash-completion/completions/cutlab
  cutlab completions zsh > ~/.zfunc/_cutlab          a folder of $fpath
  cutlab completions fish > ~/.config/fish/completions/cutlab.fish")]
pub struct CompletionsArgs {
    /// The shell
    #[arg(ignore_case = true)]
    shell: Shell,
}

/// Prints the script; with `--json` as one string.
///
/// - `command`: the definition of the command line
pub fn run(
    args: &CompletionsArgs,
    mut command: clap::Command,
    console: &Console,
) -> Result<ExitStatus, CliError> {
    let mut script = Vec::new();
    let name = command.get_name().to_owned();
    clap_complete::generate(args.shell, &mut command, name, &mut script);
    if console.json {
        console.print_json(&String::from_utf8_lossy(&script))?;
    } else {
        atomic_write::write(Path::new("-"), &script)?;
    }
    Ok(ExitStatus::Done)
}
