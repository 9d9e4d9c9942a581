//! `cutlab help`: the help of a command, or a topic of the manual.

use super::console::Console;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::markdown;
use crate::manual::{TOPICS, Topic};
use crate::parse;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab help                commands and topics
  cutlab help score          a command, as cutlab score --help
  cutlab help scores         a topic of the manual")]
pub struct HelpArgs {
    /// A command, or a topic of the manual
    #[arg(value_name = "COMMAND|TOPIC")]
    subject: Option<String>,
}

/// Prints the help; with `--json` a topic with its Markdown, or the list of topics.
///
/// - `command`: the definition of the command line
pub fn run(args: &HelpArgs, command: clap::Command, console: &Console) -> Result<ExitStatus, CliError> {
    let Some(subject) = &args.subject else {
        if console.json {
            let topics = TOPICS.iter().map(|t| serde_json::json!({ "name": t.name, "about": t.about }));
            console.print_json(&topics.collect::<Vec<_>>())?;
            return Ok(ExitStatus::Done);
        }
        return print(command, &[]);
    };
    if let Some(sub) =
        command.find_subcommand(subject.trim().to_lowercase()).map(|sub| sub.get_name().to_owned())
    {
        return print(command, &[&sub]);
    }
    let Some(topic) = TOPICS.iter().find(|topic| parse::is_name(topic.name, subject)) else {
        return Err(unknown(subject, &command));
    };
    if console.json {
        let Topic { name, about, text } = topic;
        console.print_json(&serde_json::json!({ "name": name, "about": about, "text": text }))?;
    } else {
        console.print(&markdown::for_terminal(topic.text, width()))?;
    }
    Ok(ExitStatus::Done)
}

/// The parser's own help of the whole program or of a command.
fn print(mut command: clap::Command, sub: &[&str]) -> Result<ExitStatus, CliError> {
    let name = command.get_name().to_owned();
    let words = [&[&*name], sub, &["--help"]].concat();
    match command.try_get_matches_from_mut(words) {
        Err(help) => help.print().map(|()| ExitStatus::Done).map_err(|cause| CliError::output(&cause)),
        Ok(_) => Ok(ExitStatus::Done),
    }
}

fn unknown(subject: &str, command: &clap::Command) -> CliError {
    let topics: Vec<&str> = TOPICS.iter().map(|topic| topic.name).collect();
    let commands = command.get_subcommands().map(clap::Command::get_name);
    let near = parse::did_you_mean(parse::nearest_name(subject, topics.iter().copied().chain(commands)));
    CliError::input(format!(
        "no command and no topic is called '{subject}'{near} (topics: {}; commands: cutlab help)",
        topics.join(", ")
    ))
}

/// Columns of text: those of the terminal, but no more than can be read at ease.
fn width() -> usize {
    /// As the parser's help has it.
    const MOST: usize = 100;
    terminal_size::terminal_size().map_or(MOST, |(columns, _)| usize::from(columns.0).min(MOST))
}
