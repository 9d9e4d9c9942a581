//! `cutlab sweep`: scores over a grid of parameters, or over scattered points.

mod checks;
mod options;

use super::args::stone;
use super::console::Console;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::outputs::Outputs;
use super::plot_output::Plots;
use super::table_command::TableCommand;
use crate::batch::request::{SweepTable, TableRequest};
use crate::batch::sweep::SIZE;
use crate::batch::sweep_rows::SweepRows;
pub use options::SweepArgs;

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
