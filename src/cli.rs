//! The command line: one subcommand a file.
//!
//! A new subcommand is one file in `cli/`, one line in `Command` and one in its `run`.

mod args;
mod arguments;
mod attribute;
mod changed_stone;
mod compare;
mod completions;
mod console;
mod each_stone;
mod edit;
mod error;
mod exit_code;
mod generate;
mod heartbeat;
mod help;
mod import;
mod interrupt;
mod limits;
mod list;
mod man;
mod markdown;
mod merge;
mod optimise;
mod outputs;
mod plot;
mod plot_output;
mod progress;
mod render;
mod report;
mod retarget;
mod score;
mod score_text;
mod show;
mod sweep;
mod table_command;
mod table_files;
mod terminal_table;
mod threads;
mod usage;
mod validate;
mod weight;
mod wrap;

use crate::manual::TOPICS;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use console::Console;
use error::CliError;
use exit_code::ExitStatus;
use std::process::ExitCode;

/// A laboratory for gem cuts: models them, traces light through them, pictures and scores them.
#[derive(Debug, Parser)]
#[command(name = "cutlab", version, max_term_width = 100, disable_help_subcommand = true)]
struct Cli {
    #[command(flatten)]
    console: Console,
    #[command(subcommand)]
    command: Command,
}

/// The end of the help of the whole program.
fn after_help() -> String {
    let width = TOPICS.iter().map(|topic| topic.name.len()).max().unwrap_or(0);
    let topics = TOPICS.iter().map(|topic| format!("  {:width$}  {}\n", topic.name, topic.about));
    format!(
        "\
Topics of the manual, shown by `cutlab help TOPIC`:
{}
STONE is a name from `cutlab list cuts`, a name with parameters
(round-brilliant:crown-angle=35,pavilion-angle=41), a file, or - for standard input.
Exit codes: 0 done, 1 some stones (or figures of validate) failed, 2 usage or no input was good,
3 could not read or write, 130 interrupted.
Environment: CUTLAB_LIMIT=4 raises every limit on what is read four times (all: cutlab list limits).",
        topics.collect::<String>()
    )
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Make a stone from its parameters and write it as a design or a mesh
    Generate(generate::GenerateArgs),
    /// Read designs and meshes and write them in another format
    Import(import::ImportArgs),
    /// Proportions, faceter's ratios, symmetry, tiers, volume and weight
    Show(show::ShowArgs),
    /// Change angles, table, girdle or parameters of a stone; what met still meets
    Edit(edit::EditArgs),
    /// Make a design for a stone of another refractive index
    Retarget(retarget::RetargetArgs),
    /// What each tier's angle does to scores, and through which facets light is lost
    Attribute(attribute::AttributeArgs),
    /// Take a photon-mapped picture, or a turntable of pictures
    Render(render::RenderArgs),
    /// Scores of brilliance and fire, one row a stone
    Score(score::ScoreArgs),
    /// Scores over a grid of parameters, with curves and maps
    Sweep(sweep::SweepArgs),
    /// Join the parts that --shard made of a table
    Merge(merge::MergeArgs),
    /// Draw the curves or maps of a table that is there
    Plot(plot::PlotArgs),
    /// Scores of stones beside each other, with their differences
    Compare(compare::CompareArgs),
    /// Everything about one stone: pictures, scores and a page
    Report(report::ReportArgs),
    /// The best changes of a design for one score, or between several
    Optimise(optimise::OptimiseArgs),
    /// Published and derivable figures against what this program computes
    Validate(validate::ValidateArgs),
    /// What there is to choose from
    List(list::ListArgs),
    /// Print a script that completes commands and options in a shell
    Completions(completions::CompletionsArgs),
    /// Make man pages, one for each command
    Man(man::ManArgs),
    /// The help of a command, or a topic of the manual
    Help(help::HelpArgs),
}

impl Command {
    fn run(&self, console: &Console) -> Result<ExitStatus, CliError> {
        match self {
            Command::Generate(args) => generate::run(args, console),
            Command::Import(args) => import::run(args, console),
            Command::Show(args) => show::run(args, console),
            Command::Edit(args) => edit::run(args, console),
            Command::Retarget(args) => retarget::run(args, console),
            Command::Attribute(args) => attribute::run(args, console),
            Command::Render(args) => render::run(args, console),
            Command::Score(args) => score::run(args, console),
            Command::Sweep(args) => sweep::run(args, console),
            Command::Merge(args) => merge::run(args, console),
            Command::Plot(args) => plot::run(args, console),
            Command::Compare(args) => compare::run(args, console),
            Command::Report(args) => report::run(args, console),
            Command::Optimise(args) => optimise::run(args, console),
            Command::Validate(args) => validate::run(args, console),
            Command::List(args) => list::run(args, console),
            Command::Completions(args) => completions::run(args, command(), console),
            Command::Man(args) => man::run(args, command(), console),
            Command::Help(args) => help::run(args, command(), console),
        }
    }
}

/// The definition of the command line: every command with its options, for tests, manuals and completions.
pub fn command() -> clap::Command {
    // what is wrong with a number below 0 is for the option's reader to say, not that it is no option
    let valued = |arg: clap::Arg| if arg.is_positional() { arg } else { arg.allow_negative_numbers(true) };
    Cli::command().after_help(after_help()).mut_args(valued).mut_subcommands(|sub| sub.mut_args(valued))
}

/// Runs the program on the process's arguments and gives its exit code.
///
/// Errors are one line on standard error; a reader that goes away (`| head`) ends the program
/// quietly; an interrupt ends it with 130. Checked in `tests/program/cli.rs` and `tests/program/exits.rs`.
pub fn run() -> ExitCode {
    // if the handler cannot be set the system's own takes its place: the program still stops
    let _ = ctrlc::set_handler(|| interrupt::interrupted());
    if let Err(problem) = limits::asked() {
        return CliError::input(problem.to_string()).report();
    }
    let mut command = command();
    let arguments = arguments::joined(std::env::args_os(), &command);
    let read = command.try_get_matches_from_mut(arguments).and_then(|found| Cli::from_arg_matches(&found));
    let cli = match read {
        Ok(cli) => cli,
        Err(error) => return usage::usage(&error, &self::command()),
    };
    threads::start(cli.console.threads, &cli.console);
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
        command().debug_assert();
    }
}
