//! The command line: one subcommand a file.
//!
//! A new subcommand is one file in `cli/`, one line in `Command` and one in its `run`.

mod compare;
mod console;
mod drawing;
mod folders;
mod generate;
mod import;
mod list;
mod merge;
mod outcome;
mod outputs;
mod parameters;
mod plot;
mod plots;
mod proportion_columns;
mod readable;
mod render;
mod report;
mod score;
mod scoring;
mod show;
mod stones;
mod sweep;
mod tables;
mod validate;
mod words;

use crate::store::limits;
use clap::{CommandFactory, Parser, Subcommand};
use console::Console;
use outcome::{Code, Failure};
use std::process::ExitCode;

/// A laboratory for gem cuts: models them, traces light through them, pictures and scores them.
#[derive(Debug, Parser)]
#[command(name = "cutlab", version, max_term_width = 100, after_help = AFTER_HELP)]
struct Cli {
    #[command(flatten)]
    console: Console,
    #[command(subcommand)]
    command: Command,
}

const AFTER_HELP: &str = "\
STONE is a name from `cutlab list cuts`, a name with parameters
(round-brilliant:crown-angle=35,pavilion-angle=41), or a file.
Exit codes: 0 done, 1 some stones (or figures of validate) failed, 2 usage or no input was good,
3 could not read or write, 130 interrupted.
Environment: CUTLAB_LIMIT=4 raises every limit on what is read four times (all: cutlab list limits).";

#[derive(Debug, Subcommand)]
enum Command {
    /// Make a stone from its parameters and write it as a design or a mesh
    Generate(generate::Args),
    /// Read designs and meshes and write them in another format
    Import(import::Args),
    /// Proportions, faceter's ratios, symmetry, tiers, volume and weight
    Show(show::Args),
    /// Take a photon-mapped picture, or a turntable of pictures
    Render(render::Args),
    /// Scores of brilliance and fire, one row a stone
    Score(score::Args),
    /// Scores over a grid of parameters, with curves and maps
    Sweep(sweep::Args),
    /// Join the parts that --shard made of a table
    Merge(merge::Args),
    /// Draw the curves or maps of a table that is there
    Plot(plot::Args),
    /// Scores of stones beside each other, with their differences
    Compare(compare::Args),
    /// Everything about one stone: pictures, scores and a page
    Report(report::Args),
    /// Published and derivable figures against what this program computes
    Validate(validate::Args),
    /// What there is to choose from
    List(list::Args),
}

impl Command {
    fn run(&self, console: &Console) -> Result<Code, Failure> {
        match self {
            Command::Generate(args) => generate::run(args, console),
            Command::Import(args) => import::run(args, console),
            Command::Show(args) => show::run(args, console),
            Command::Render(args) => render::run(args, console),
            Command::Score(args) => score::run(args, console),
            Command::Sweep(args) => sweep::run(args, console),
            Command::Merge(args) => merge::run(args, console),
            Command::Plot(args) => plot::run(args, console),
            Command::Compare(args) => compare::run(args, console),
            Command::Report(args) => report::run(args, console),
            Command::Validate(args) => validate::run(args, console),
            Command::List(args) => list::run(args, console),
        }
    }
}

/// Runs the program on the process's arguments and gives its exit code.
///
/// Errors are one line on standard error; a reader that goes away (`| head`) ends the program
/// quietly; an interrupt ends it with 130. Checked in `tests/cli.rs` and `tests/endings.rs`.
pub fn run() -> ExitCode {
    // if the handler cannot be set the system's own takes its place: the program still stops
    let _ = ctrlc::set_handler(|| outcome::interrupted());
    if let Some(factor) = std::env::var_os(limits::VARIABLE)
        && let Err(problem) = limits::raise(&factor.to_string_lossy())
    {
        return Failure::input(problem).report();
    }
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return outcome::usage(&error, &Cli::command()),
    };
    match cli.command.run(&cli.console) {
        Ok(code) => code.into(),
        Err(failure) => failure.report(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }
}
