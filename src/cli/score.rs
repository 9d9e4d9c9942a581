//! `cutlab score`: a table of scores, one row a stone, or one a stone and tilt.

mod options;

use super::args::stone;
use super::console::Console;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::outputs::Outputs;
use super::plot_output::Plots;
use super::table_command::TableCommand;
use crate::batch::outlines::with_outline;
use crate::batch::request::{ScoreTable, SortRequest, TableRequest, TiltRange};
use crate::batch::score_rows::ScoreRows;
use crate::batch::stone_files::expand_stones;
use crate::batch::table_job::Order;
use crate::batch::table_rows::TILT;
use crate::cli::limits::limits;
use crate::metrics::Metric;
pub use options::ScoreArgs;

/// Scores every stone and writes the table.
pub fn run(args: &ScoreArgs, console: &Console) -> Result<ExitStatus, CliError> {
    let scores = args.scoring.plan();
    let sort = sort(args, &scores.metrics)?;
    let all = expand_stones(&args.stones, limits())?;
    let given = all.len();
    let stones = with_outline(all, &args.scoring.options(), &args.outline);
    let mut notes = args.scoring.notes(false);
    if !args.outline.is_empty() {
        let named = args.outline.iter().map(|outline| outline.name()).collect::<Vec<_>>().join(" or ");
        if stones.is_empty() {
            return Err(CliError::input(format!("none of {given} stones is {named} in outline")));
        }
        notes.insert(0, format!("of {given} stones {} are {named} in outline", stones.len()));
    }
    let mut outputs = Outputs::reading_stones(&stones, console);
    let azimuths = match (&args.tilt_axis[..], args.plot.is_empty()) {
        ([], true) => vec![0.0],
        ([], false) => vec![0.0, 90.0],
        (given, _) => given.to_vec(),
    };
    let plots = Plots::new(&args.plot, &scores.metrics, &args.look, &[TILT.into()])?;
    let table = ScoreTable {
        stones: args.stones.iter().map(stone::display_name).collect(),
        options: args.scoring.options(),
        scores,
        tilt: args.tilt.map(|degrees| TiltRange { degrees, azimuths }),
        proportions: args.proportions,
        sort,
        outline: args.outline.clone(),
    };
    let request = TableRequest::Score(table.clone());
    let rows = ScoreRows::new(&request, &table, &stones, console);
    let command = TableCommand { request: &request, rows: &rows, notes, what: "scoring" };
    command.run(&args.table, &plots, &mut outputs, console)
}

/// How the rows are sorted, if they are to be.
fn sort(args: &ScoreArgs, metrics: &[&'static Metric]) -> Result<Option<SortRequest>, CliError> {
    let Some(sort) = args.sort else { return Ok(None) };
    let name = sort.metric.name;
    if !metrics.iter().any(|m| m.name == name) {
        return Err(CliError::input(format!("--sort {name}: it is not among the --metrics")));
    }
    if args.table.shard.of > 1 {
        return Err(CliError::input("--sort needs the whole table: leave out --shard"));
    }
    Ok(Some(SortRequest { order: Order { top: args.top, ..sort.order }, ..sort }))
}
