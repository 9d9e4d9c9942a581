//! `cutlab man`: man pages, made from the definition of the command line.

use super::args::stone;
use super::console::Console;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::outputs::Outputs;
use crate::render::{Record, record};
use crate::storage::atomic_write;
use clap_mangen::Man;
use clap_mangen::roff::{Roff, roman};
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab man > cutlab.1                          the page of cutlab itself
  cutlab man -o ~/.local/share/man/man1          that page and one for each command: man cutlab-score")]
pub struct ManArgs {
    /// The folder to write the pages of all commands into; it is made [the main page goes to standard output]
    #[arg(long, short, value_name = "DIR")]
    output: Option<PathBuf>,
}

/// Writes the pages, or prints the main one; with `--json` as one string.
///
/// - `command`: the definition of the command line
pub fn run(args: &ManArgs, mut command: clap::Command, console: &Console) -> Result<ExitStatus, CliError> {
    command.build();
    let failed = |cause: std::io::Error| CliError::input(format!("the man page cannot be made: {cause}"));
    let stdout = Path::new("-");
    let output = args.output.as_deref().unwrap_or(stdout);
    if atomic_write::is_stream(output) {
        let page = page(&command).map_err(failed)?;
        if console.json && atomic_write::is_stdout(output) {
            console.print_json(&String::from_utf8_lossy(&page))?;
        } else {
            atomic_write::write(output, &page)?;
        }
        return Ok(ExitStatus::Done);
    }
    let own = Record::of_command(record::own_command());
    let record = format!(".\\\" {}", own.behind());
    let mut outputs = Outputs::new(console);
    let mut pages = Vec::new();
    for command in std::iter::once(&command).chain(command.get_subcommands()) {
        let name = command.get_display_name().unwrap_or(command.get_name());
        let file = output.join(format!("{name}.{SECTION}"));
        outputs.claim(&file, |there| own.matches(there))?;
        pages.push((file, [page(command).map_err(failed)?, record.clone().into_bytes()].concat()));
    }
    for (file, bytes) in &pages {
        atomic_write::write(file, bytes)?;
    }
    let files: Vec<String> = pages.iter().map(|(file, _)| stone::display_name(file)).collect();
    if console.json {
        console.print_json(&files)?;
    } else {
        console.note(&format!("wrote {} pages into {}", files.len(), stone::display_name(output)));
    }
    Ok(ExitStatus::Done)
}

/// The section of commands.
const SECTION: &str = "1";

/// The page of a command, in roff.
fn page(command: &clap::Command) -> std::io::Result<Vec<u8>> {
    let mut page = Vec::new();
    let source = format!("cutlab {}", env!("CARGO_PKG_VERSION"));
    let man = Man::new(command.clone().after_help(None)).section(SECTION).source(source).manual("cutlab");
    man.render(&mut page)?;
    if let Some(notes) = command.get_after_help() {
        // its lines are columns: they are not filled
        let mut section = Roff::new();
        section.control("SH", ["NOTES"]).control("nf", []);
        notes.to_string().lines().for_each(|line| _ = section.text([roman(line)]));
        section.control("fi", []);
        page.extend(section.to_roff().bytes());
    }
    Ok(page)
}
