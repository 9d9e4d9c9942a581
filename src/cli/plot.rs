//! `cutlab plot`: curves and maps of a table that is there, without computing anything.

use super::args::stone;
use super::console::Console;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::outputs::Outputs;
use super::plot_output::{self, Look, Plots};
use crate::batch::merge::TablePart;
use crate::batch::sidecar::TableMeta;
use crate::cli::limits::limits;
use crate::render::{Record, record};
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab plot sweep.csv -o wlr.svg -o iso.png     of a table of sweep, or of score --tilt
  cutlab plot sweep.csv -o wlr.png --title 'Crown and pavilion' --range wlr=0.25:0.29 --pixels 2400
  cutlab plot all.csv -o map.svg                  map-METRIC.svg for every metric of the table

The table needs its sidecar beside it (sweep.csv.meta.json), which says what its axes are.")]
pub struct PlotArgs {
    /// A whole table that sweep, merge or score --tilt wrote
    #[arg(value_name = "TABLE")]
    table: PathBuf,
    /// Where to draw: .svg, .pdf or .png; a file called METRIC.svg shows that metric, of any other name one is
    /// drawn for each, NAME-METRIC.svg
    #[arg(long, short, value_name = "FILE", required = true)]
    output: Vec<PathBuf>,
    #[command(flatten)]
    look: Look,
}

/// Draws the plots.
pub fn run(args: &PlotArgs, console: &Console) -> Result<ExitStatus, CliError> {
    let part = TablePart::open(&args.table, limits())?;
    if let Some(shard) = part.meta.shard {
        let table = stone::display_name(&args.table);
        return Err(CliError::input(format!("{table} is shard {shard} of a table: cutlab merge joins them")));
    }
    let layout = plot_output::layout_of(&args.table, &part.meta)?;
    let plots = Plots::new(&args.output, &plot_output::metrics_of(&part.meta), &args.look, &layout.axes)?;
    let mut outputs = Outputs::new(console);
    outputs.reads(&args.table);
    outputs.reads(&TableMeta::find_for(&args.table));
    let record = Record::of_command(record::own_command());
    plots.claim(&record, &mut outputs)?;
    let bytes = part.bytes()?;
    let files = plots.draw(&bytes, part.form, &layout, &record)?;
    plot_output::tell(&files, console)?;
    Ok(ExitStatus::Done)
}
