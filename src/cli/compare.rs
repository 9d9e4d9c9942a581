//! `cutlab compare`: stones beside each other, with differences and what they are worth.

mod entries;
mod format;
mod text;

use super::args::scoring::ScoringArgs;
use super::args::{stone, values};
use super::console::Console;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::outputs::Outputs;
use super::progress::BarProgress;
use crate::batch::comparison::{ComparisonError, StoneComparison};
use crate::batch::request::{ComparisonTable, TableRequest};
use crate::batch::stone_files::expand_stones;
use crate::cli::limits::limits;
use crate::render::{Record, record};
use crate::report::LEAST_WIDTH;
use crate::scene::scene_file::MOST_PIXELS;
use crate::storage::atomic_write;
use format::ComparisonFormat;
use std::ffi::OsString;
use std::path::PathBuf;
use text::ComparisonText;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab compare round-brilliant tolkowsky
  cutlab compare tolkowsky mine.asc --metrics wlr,fire_streak --error 0.0005 --json
  cutlab compare D.asc:material=quartz D.asc:material=topaz    one design in two materials
  cutlab compare designs/ --metrics iso,wlr -o all.csv  a row for each metric and stone; also .md
  cutlab compare tolkowsky scan-dn eppler -o out       and a page with pictures and tilt curves

Every stone is scored with the same random numbers in 32 runs, and the error of a difference is the
spread of the runs' differences. A difference is called significant if it is beyond three of its
errors and not negligible: more than 1e-6 of the metric's scale (1, or 100 for percentages), or 1e-4
where photons are traced, because they are followed until 1e-4 of their light is left.")]
pub struct CompareArgs {
    /// The stones, files, folders of files and patterns; differences are from the first
    #[arg(required = true, value_name = "STONE")]
    stones: Vec<OsString>,
    /// A folder for a page that shows them beside each other, which is made; or a file for the table with
    /// the proportions: .csv, .jsonl, .json or .md; - is standard output, CSV or with --json JSON
    #[arg(long, short, value_name = "DIR|FILE")]
    output: Option<PathBuf>,
    /// Pixels across the pictures on the table, of a page [640]
    #[arg(long, value_name = "PIXELS", value_parser = values::whole_number(LEAST_WIDTH..=MOST_PIXELS, "a width is a whole number of pixels"))]
    width: Option<u32>,
    #[command(flatten)]
    scoring: ScoringArgs,
}

/// Compares the stones.
pub fn run(args: &CompareArgs, console: &Console) -> Result<ExitStatus, CliError> {
    let stones = expand_stones(&args.stones, limits())?;
    if stones.len() < 2 {
        return Err(ComparisonError::TooFew.into());
    }
    let output = ComparisonFormat::new(args.output.as_deref(), args.width, console)?;
    let table = ComparisonTable {
        stones: args.stones.iter().map(stone::display_name).collect(),
        options: args.scoring.options(),
        scores: args.scoring.plan(),
    };
    let request = TableRequest::Compare(table.clone());
    let record = Record::of_request(record::own_command(), &(&request, args.width));
    if let Some(output) = &output {
        output.claim(&request, &record, &mut Outputs::reading_stones(&stones, console))?;
    }
    let opened = table.open(&stones, console).map_err(|error| match error {
        ComparisonError::Stone(error) => CliError::needs_convex("a comparison", error),
        error => error.into(),
    })?;
    args.scoring.notes(false).iter().for_each(|note| console.note(note));
    let compared = opened.run(&BarProgress::new(console))?;
    let status = complain(&compared, console);
    if status == ExitStatus::NoGoodInput {
        return Ok(status);
    }
    let table_is_printed = output.as_ref().is_some_and(|o| atomic_write::is_stdout(o.path()));
    if !table_is_printed && console.json {
        console.print_json(&entries::of(&compared))?;
    } else if !table_is_printed {
        console.print(&ComparisonText(&compared).text())?;
    }
    if let Some(output) = &output {
        output.write(&compared, &record, console)?;
    }
    Ok(status)
}

/// Says what went wrong with each stone, up to one that has no scores at all.
fn complain(compared: &StoneComparison, console: &Console) -> ExitStatus {
    let mut status = ExitStatus::Done;
    for row in &compared.comparison.rows {
        if let Some(error) = &row.error {
            console.complain(&format!("{}: {error}", row.stone));
            status = ExitStatus::SomeFailed;
            if row.scores.iter().all(Option::is_none) {
                return ExitStatus::NoGoodInput;
            }
        }
    }
    status
}
