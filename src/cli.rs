//! The command line: one subcommand a file.
//!
//! A new subcommand is one file in `cli/`, one line in `Command` and one in its `run`.

mod args;
mod compare;
mod completions;
mod console;
mod diagram_output;
mod exit_code;
mod form;
mod generate;
mod heartbeat;
mod help;
mod import;
mod limits;
mod list;
mod man;
mod markdown;
mod merge;
mod outputs;
mod plot;
mod plot_output;
mod render;
mod report;
mod score;
mod show;
mod sweep;
mod terminal_table;
mod validate;
mod weight;
mod wrap;

use crate::manual::TOPICS;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use console::Console;
use exit_code::{CliError, ExitStatus};
use std::collections::BTreeSet;
use std::ffi::OsString;
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
            Command::Render(args) => render::run(args, console),
            Command::Score(args) => score::run(args, console),
            Command::Sweep(args) => sweep::run(args, console),
            Command::Merge(args) => merge::run(args, console),
            Command::Plot(args) => plot::run(args, console),
            Command::Compare(args) => compare::run(args, console),
            Command::Report(args) => report::run(args, console),
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

/// The arguments, with a number that follows an option joined to it where it may be taken for something else.
///
/// - after an option whose value may be left out: `--glare 8` is `--glare=8`, and in `--glare a.asc` what
///   follows is a stone
/// - below 0 with its unit: `--size -3mm` is `--size=-3mm`, for the option's reader to say what is wrong
fn joined(arguments: impl Iterator<Item = OsString>, command: &clap::Command) -> Vec<OsString> {
    let all = || command.get_arguments().chain(command.get_subcommands().flat_map(|sub| sub.get_arguments()));
    let named = |wanted: fn(&clap::Arg) -> bool| -> BTreeSet<OsString> {
        let long = all().filter(|arg| wanted(arg)).filter_map(clap::Arg::get_long);
        long.map(|long| format!("--{long}").into()).collect()
    };
    let optional = named(clap::Arg::is_require_equals_set);
    let valued = named(|arg| arg.get_action().takes_values());
    let mut joined: Vec<OsString> = Vec::new();
    for argument in arguments {
        let text = argument.to_str().unwrap_or_default();
        let is_number = text.parse::<f64>().is_ok();
        let is_below_0 = text
            .strip_prefix('-')
            .is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit() || c == '.'));
        match joined.last_mut() {
            Some(last) if is_number && optional.contains(last) || is_below_0 && valued.contains(last) => {
                last.push("=");
                last.push(argument);
            }
            _ => joined.push(argument),
        }
    }
    joined
}

/// Runs the program on the process's arguments and gives its exit code.
///
/// Errors are one line on standard error; a reader that goes away (`| head`) ends the program
/// quietly; an interrupt ends it with 130. Checked in `tests/program/cli.rs` and `tests/program/exits.rs`.
pub fn run() -> ExitCode {
    // if the handler cannot be set the system's own takes its place: the program still stops
    let _ = ctrlc::set_handler(|| exit_code::interrupted());
    if let Err(problem) = limits::asked() {
        return CliError::input(problem.to_string()).report();
    }
    let mut command = command();
    let arguments = joined(std::env::args_os(), &command);
    let read = command.try_get_matches_from_mut(arguments).and_then(|found| Cli::from_arg_matches(&found));
    let cli = match read {
        Ok(cli) => cli,
        Err(error) => return exit_code::usage(&error, &self::command()),
    };
    cli.console.start_threads();
    match cli.command.run(&cli.console) {
        Ok(code) => code.into(),
        Err(failure) => failure.report(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_after_an_option_that_may_stand_alone_is_its_value() {
        let said = |line: &str| joined(line.split(' ').map(OsString::from), &command());
        assert_eq!(said("cutlab render --glare 8 cube"), ["cutlab", "render", "--glare=8", "cube"]);
        assert_eq!(said("cutlab render --glare cube"), ["cutlab", "render", "--glare", "cube"]);
        assert_eq!(said("cutlab render --width 8"), ["cutlab", "render", "--width", "8"]);
        assert_eq!(said("cutlab show a --size -3mm"), ["cutlab", "show", "a", "--size=-3mm"]);
        assert_eq!(said("cutlab score -j -2 --exact -3"), ["cutlab", "score", "-j", "-2", "--exact", "-3"]);
    }

    #[test]
    fn the_command_line_is_consistent() {
        command().debug_assert();
    }
}
