//! `cutlab sweep`: scores over a grid of parameters, or over scattered points.

use super::args::scoring::ScoringArgs;
use super::args::stone;
use super::args::tables::{TableArgs, TableCommand};
use super::console::Console;
use super::exit_code::{CliError, ExitStatus};
use super::outputs::Outputs;
use super::plot_output::{Look, Plots};
use crate::batch::request::{SweepTable, TableRequest};
use crate::batch::sweep::{INDEX, MOST_SCATTERED, SIZE, SweptParameter};
use crate::batch::sweep_rows::SweepRows;
use crate::parse;
use crate::stone::grammar;
use crate::storage::atomic_write;
use std::ffi::{OsStr, OsString};
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
    stone: OsString,
    /// A parameter of the stone, or size or ri, and what it runs through; may be given several times
    #[arg(long, value_name = "KEY=FROM:TO:STEP", required = true)]
    vary: Vec<SweptParameter>,
    /// So many points spread evenly between the ends of the ranges, in place of the grid
    #[arg(long, value_name = "N", value_parser = scattered)]
    scatter: Option<u64>,
    /// Draw a curve (one --vary) or a map (two), .svg, .pdf or .png; a file called METRIC.svg shows that
    /// metric, of any other name one is drawn for each, NAME-METRIC.svg
    #[arg(long, value_name = "FILE")]
    plot: Vec<PathBuf>,
    #[command(flatten)]
    look: Look,
    #[command(flatten)]
    table: TableArgs,
    #[command(flatten)]
    scoring: ScoringArgs,
}

/// Value parser of `--scatter`.
fn scattered(text: &str) -> Result<u64, String> {
    parse::parse_whole_number(text, 1..=1_000_000_000, "--scatter takes a whole number of points")
}

/// Scores every point and writes the table.
pub fn run(args: &SweepArgs, console: &Console) -> Result<ExitStatus, CliError> {
    check(args)?;
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

/// Whether the stone's family has the parameter `key`.
fn has(stone: &OsStr, key: &str) -> bool {
    stone.to_str().and_then(grammar::family).is_some_and(|f| f.keys().any(|p| p.key == key))
}

/// Refuses what cannot be swept or drawn, before anything is scored.
fn check(args: &SweepArgs) -> Result<(), CliError> {
    args.scoring.stone_args.open(&args.stone)?;
    for (i, varied) in args.vary.iter().enumerate() {
        let key = varied.key.as_str();
        if args.vary[..i].iter().any(|v| v.key == key) {
            return Err(CliError::input(format!("--vary {key} is given twice")));
        }
        if ![SIZE, INDEX].contains(&key) && !has(&args.stone, key) {
            let own = args.stone.to_str().and_then(grammar::family).map_or(&[][..], |f| f.parameters);
            let mut known: Vec<&str> = own.iter().map(|p| p.key).filter(|k| *k != SIZE).collect();
            known.extend([SIZE, INDEX]);
            return Err(CliError::input(format!(
                "{} has no parameter '{key}': --vary takes {}",
                stone::display_name(&args.stone),
                known.join(", ")
            )));
        }
        let (from, to) = (varied.steps.from, varied.steps.to);
        if key == INDEX
            && (args.scoring.stone_args.material.is_some() || args.scoring.stone_args.ri.is_some())
        {
            return Err(CliError::input("--vary ri does not go with --material and --ri"));
        }
        let (low, high, what) = match key {
            INDEX => (1.0, 10.0, "a refractive index is a number from 1 to 10"),
            SIZE => (1e-3, 1e3, "a girdle width is a number of millimetres from 0.001 to 1000"),
            _ => continue,
        };
        if !(low..=high).contains(&from.min(to)) || from.max(to) > high {
            return Err(CliError::input(format!("--vary {key}={}: {what}", varied.steps)));
        }
    }
    if args.scatter.is_some() && args.vary.len() > MOST_SCATTERED {
        return Err(CliError::input(format!("--scatter takes up to {MOST_SCATTERED} varied parameters")));
    }
    let Some(first) = args.plot.first() else { return Ok(()) };
    if args.vary.len() > 2 {
        return Err(CliError::input(format!(
            "{}: a plot has one or two varied parameters; of more the table alone is written",
            stone::display_name(first)
        )));
    }
    if args.table.shard.of > 1 || atomic_write::is_stream(&args.table.output) {
        return Err(CliError::input("--plot needs the whole table in a file: give -o FILE, without --shard"));
    }
    Ok(())
}
