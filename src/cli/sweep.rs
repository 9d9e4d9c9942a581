//! `cutlab sweep`: scores over a grid of parameters, or over scattered points.

use super::args::family::FamilyArgs;
use super::args::scoring;
use super::args::scoring::{InputFiles, ScoringArgs};
use super::args::stone;
use super::args::tables;
use super::args::tables::{TableArgs, TableCommand};
use super::console::Console;
use super::exit_code::{CliError, ExitStatus};
use super::outputs::Outputs;
use super::plot_output::{Look, Plots};
use crate::batch::request::{SweepTable, TableRequest};
use crate::batch::sidecar::TableLayout;
use crate::batch::sweep::{MOST_SCATTERED, Sweep, SweptParameter};
use crate::batch::table;
use crate::batch::table::TableCell;
use crate::batch::table_job::FinishedRow;
use crate::materials::weight::Weight;
use crate::parse;
use crate::stone::grammar;
use crate::storage::atomic_write;
use std::ffi::{OsStr, OsString};
use std::path::PathBuf;

/// Keys that every stone has.
const SIZE: &str = "size";
const INDEX: &str = "ri";

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
    let plan = args.scoring.plan();
    let sweep = Sweep { varied: args.vary.clone(), scatter: args.scatter, seed: args.scoring.seed };
    check(args)?;
    let request = TableRequest::Sweep(SweepTable {
        stone: stone::display_name(&args.stone),
        options: args.scoring.options(),
        scores: plan.clone(),
        vary: args.vary.clone(),
        scatter: args.scatter,
    });
    let mut leading: Vec<&str> = sweep.varied.iter().map(|v| v.key.as_str()).collect();
    leading.push("facets");
    let columns = table::columns(&leading, &plan.metrics);
    let total = sweep.count().ok_or_else(|| CliError::input("the grid has too many points to count"))?;
    let axes: Vec<String> = sweep.varied.iter().map(|v| v.key.clone()).collect();
    let plots = Plots::new(&args.plot, &plan.metrics, &args.look, &axes)?;
    let layout = TableLayout {
        stone: stone::display_name(&args.stone),
        is_diamond: is_diamond(args)?,
        axes,
        curves: Vec::new(),
        scattered: sweep.scatter.is_some(),
    };
    let inputs = InputFiles::new(&request, [args.stone.as_os_str()].into_iter());
    let study = TableCommand {
        request: &request,
        identity: inputs.identity.clone(),
        total,
        layout: Some(layout),
        order: None,
        notes: args.scoring.notes(args.vary.iter().any(|v| v.key == SIZE)),
        what: "sweeping",
        line: &|i, form| {
            let point = sweep.point(i);
            let (spec, scoring) = at_point(args, &point);
            let (row, outcome) = inputs.checked(&args.stone, scoring.score(&spec, None, &plan, console));
            let shown = stone::display_name(&spec);
            scoring::tell(&shown, &row, console);
            let mut leading: Vec<TableCell> = point.iter().map(|x| TableCell::number(*x)).collect();
            leading.push(row.facets.into());
            Ok(FinishedRow {
                outcome,
                samples: row.samples.iter().map(|(of, n)| (of.to_string(), *n)).collect(),
                key: None,
                text: form.row(&columns, &table::cells(leading, &row))?,
                complaint: tables::complaint(&shown, &row),
                note: row.omissions(),
            })
        },
        columns: columns.clone(),
    };
    study.run(&args.table, &plots, &mut Outputs::reading_stones([&args.stone], console), console)
}

/// The stone at a point, and how to score it.
fn at_point(args: &SweepArgs, point: &[f64]) -> (OsString, ScoringArgs) {
    let is_varied = |key: &str| args.vary.iter().any(|v| v.key == key);
    let has_size = args.stone.to_str().is_some_and(|stone| grammar::size_is_parameter(stone, is_varied));
    let mut scoring = args.scoring.clone();
    let mut given = FamilyArgs::default();
    for (varied, &value) in args.vary.iter().zip(point) {
        match varied.key.as_str() {
            INDEX => scoring = scoring.with_index(value),
            SIZE if !has_size => scoring = scoring.with_size(value),
            key => {
                given.0.insert(key.into(), value);
            }
        }
    }
    let spec = match args.stone.to_str() {
        Some(stone) => given.applied_to(stone).into(),
        None => args.stone.clone(), // a file, which has no parameters
    };
    (spec, scoring)
}

/// Whether the stone is of diamond at every point.
fn is_diamond(args: &SweepArgs) -> Result<bool, CliError> {
    let stone = args.scoring.stone_args.open(&args.stone)?;
    Ok(Weight::new(stone.material()).is_diamond() && args.vary.iter().all(|v| v.key != INDEX))
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
