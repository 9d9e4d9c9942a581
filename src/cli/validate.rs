//! `cutlab validate`: published and derivable figures against what this program computes.

mod text;

use super::args::stone;
use super::args::values;
use super::console::Console;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::outputs::Outputs;
use super::progress::BarProgress;
use crate::batch::validate;
use crate::batch::validate::{CheckContext, FigureRow, Verdict};
use crate::cli::limits::limits;
use crate::render::{Record, record};
use crate::report::validation::{self, count};
use crate::storage::atomic_write;
use std::path::PathBuf;

/// Where the table and the page go unless a folder is named.
const FOLDER: &str = "reports";

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab validate                       all figures, a minute; reports/validation.csv and .html
  cutlab validate --only leakage        those whose subject or name says leakage, on the screen alone
  CUTLAB_CORPUS=../corpus cutlab validate   with the figures that need real files

A figure passes if ours lies within its tolerance and 3 standard errors of ours. All are expected to:
exit code 0 if they do, 1 if some failed, which stay in the table with what may explain them. Figures
that need files which are not there are skipped, and count as neither.")]
pub struct ValidateArgs {
    /// A folder for validation.csv and validation.html; it is made [reports; none with --only]
    #[arg(long, short, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Only figures computed with one whose subject or name has this in it
    #[arg(long, value_name = "TEXT")]
    only: Option<String>,
    /// Seed of the random streams
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = values::seed)]
    seed: u64,
}

/// Runs the checks and writes what they give.
pub fn run(args: &ValidateArgs, console: &Console) -> Result<ExitStatus, CliError> {
    let mut checks = validate::catalogue();
    if let Some(part) = &args.only {
        checks = validate::only(checks, part);
        if checks.is_empty() {
            return Err(CliError::input(format!(
                "no figure has '{part}' in its name; cutlab validate lists them all"
            )));
        }
    }
    let folder = args.output.clone().or_else(|| args.only.is_none().then(|| FOLDER.into()));
    let record = Record::of_command(record::own_command());
    if let Some(folder) = &folder {
        let is_own = record.matches(&folder.join("validation.html"));
        let mut outputs = Outputs::new(console);
        ["validation.csv", "validation.html"]
            .iter()
            .try_for_each(|name| outputs.claim(&folder.join(name), |_| is_own))?;
    }
    let corpus = std::env::var_os("CUTLAB_CORPUS").map(PathBuf::from);
    let lab = CheckContext { seed: args.seed, corpus, limits: limits() };
    let reports = validate::run(checks, &lab, &BarProgress::new(console));
    let outcomes = || reports.iter().flat_map(|r| &r.outcomes);
    if console.json {
        console.print_json(&outcomes().map(FigureRow::new).collect::<Vec<_>>())?;
    } else {
        console.print(&text::text(&reports))?;
    }
    if let Some(folder) = folder {
        let page = record.in_markup(validation::html(&reports, args.seed, &record::command_line()));
        let table = validate::csv(outcomes())?;
        for (name, bytes) in [("validation.csv", &table[..]), ("validation.html", page.as_bytes())] {
            let path = folder.join(name);
            atomic_write::write(&path, bytes)?;
            console.note(&format!("wrote {}", stone::display_name(&path)));
        }
    }
    Ok(if count(&reports, Verdict::Failed) == 0 { ExitStatus::Done } else { ExitStatus::SomeFailed })
}
