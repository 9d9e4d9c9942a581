//! `cutlab sweep`: scores over a grid of parameters, or over scattered points.

mod checks;

use super::args::scoring::ScoringArgs;
use super::args::stone;
use super::args::tables::{TableArgs, TableCommand};
use super::console::Console;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::outputs::Outputs;
use super::plot_output::{Look, Plots};
use crate::batch::request::{SweepTable, TableRequest};
use crate::batch::sweep::{SIZE, SweptParameter};
use crate::batch::sweep_rows::SweepRows;
use crate::parse;
use std::ffi::OsString;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab sweep round-brilliant --vary crown-angle=20:45:0.5 --metrics wlr -o sweep.csv --plot wlr.svg
  cutlab sweep tolkowsky --vary crown-angle=30:38:0.5 --vary pavilion-angle=40:42:0.1 \\
      --metrics wlr,fire_streak --error 0.001 -o sweep.csv --plot wlr.svg --plot fire_streak.png
  cutlab sweep round-brilliant --vary table=50:65:1 --vary ri=1.5:2.5:0.1 --scatter 200 -o s.csv

Every point is scored with the same random numbers: the error of a difference between two points
is less than the errors of the two together. Common are seed, points of the outline or crown and
directions as shares of what each stone has; paths differ as the stones do.")]
pub struct SweepArgs {
    /// The stone: a name from `cutlab list cuts`, with parameters or not
    pub stone: OsString,
    /// A parameter of the stone, or size or ri, and what it runs through; may be given several times
    #[arg(long, value_name = "KEY=FROM:TO:STEP", required = true)]
    pub vary: Vec<SweptParameter>,
    /// So many points spread evenly between the ends of the ranges, in place of the grid
    #[arg(long, value_name = "N", value_parser = scattered)]
    pub scatter: Option<u64>,
    /// Draw a curve (one --vary) or a map (two), .svg, .pdf or .png; a file called METRIC.svg shows that
    /// metric, of any other name one is drawn for each, NAME-METRIC.svg
    #[arg(long, value_name = "FILE")]
    pub plot: Vec<PathBuf>,
    #[command(flatten)]
    pub look: Look,
    #[command(flatten)]
    pub table: TableArgs,
    #[command(flatten)]
    pub scoring: ScoringArgs,
}

/// Value parser of `--scatter`.
fn scattered(text: &str) -> Result<u64, String> {
    parse::parse_whole_number(text, 1..=1_000_000_000, "--scatter takes a whole number of points")
}

/// Scores every point and writes the table.
pub fn run(args: &SweepArgs, console: &Console) -> Result<ExitStatus, CliError> {
    checks::check(args)?;
    let table = SweepTable {
        stone: stone::display_name(&args.stone),
        options: args.scoring.options(),
        scores: args.scoring.plan(),
        vary: args.vary.clone(),
        scatter: args.scatter,
    };
    let axes: Vec<String> = table.vary.iter().map(|v| v.key.clone()).collect();
    let plots = Plots::new(&args.plot, &table.scores.metrics, &args.look, &axes)?;
    let request = TableRequest::Sweep(table.clone());
    let rows = SweepRows::new(&request, &table, &args.stone, console)?;
    let rows = rows.ok_or_else(|| CliError::input("the grid has too many points to count"))?;
    let notes = args.scoring.notes(args.vary.iter().any(|v| v.key == SIZE));
    let command = TableCommand { request: &request, rows: &rows, notes, what: "sweeping" };
    command.run(&args.table, &plots, &mut Outputs::reading_stones([&args.stone], console), console)
}
