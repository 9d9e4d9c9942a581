//! `cutlab merge`: the parts of a table, joined.

use super::args::stone;
use super::args::tables;
use super::console::Console;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::outputs::Outputs;
use super::plot_output::{self, Look, Plots};
use super::table_files;
use crate::batch::merge::{self, TablePart, TableParts};
use crate::batch::sidecar::TableMeta;
use crate::cli::limits::limits;
use crate::render::Record;
use crate::storage::atomic_write;
use crate::storage::journal::Journal;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab score designs/ --shard 1/2 -o one.csv     on one machine
  cutlab score designs/ --shard 2/2 -o two.csv     on another
  cutlab merge one.csv two.csv -o all.csv          the bytes of: cutlab score designs/ -o all.csv
  cutlab merge 'part*.csv' -o sweep.csv --plot wlr.svg    and a map, of the parts of a sweep

Each part needs its sidecar beside it (one.csv.meta.json), which says which part it is. The whole is
written as its own name says, whatever the parts are.")]
pub struct MergeArgs {
    /// The tables that --shard made, and patterns of their names
    #[arg(required = true, value_name = "PART")]
    parts: Vec<OsString>,
    /// Where to write the whole table: .csv, .jsonl or .ndjson, .json; - is standard output
    #[arg(long, short, value_name = "FILE")]
    output: PathBuf,
    /// Draw the curves or the map of the whole table, .svg, .pdf or .png; a file called METRIC.svg shows that
    /// metric, of any other name one is drawn for each, NAME-METRIC.svg
    #[arg(long, value_name = "FILE")]
    plot: Vec<PathBuf>,
    #[command(flatten)]
    look: Look,
}

/// Joins the parts.
pub fn run(args: &MergeArgs, console: &Console) -> Result<ExitStatus, CliError> {
    let form = tables::format_of(&args.output, console)?;
    let tables = merge::part_files(&args.parts, limits())?;
    let mut outputs = Outputs::new(console);
    for table in &tables {
        outputs.reads(table);
        outputs.reads(&TableMeta::find_for(table));
    }
    let parts: Vec<TablePart> =
        tables.iter().map(|p| TablePart::open(p, limits())).collect::<Result<_, _>>()?;
    let count = parts.len();
    let mut parts = TableParts::new(parts)?;
    let record = Record::of_table(&parts.meta);
    let layout = match args.plot.is_empty() {
        true => Default::default(),
        false => plot_output::layout_of(Path::new(&args.parts[0]), &parts.meta)?,
    };
    let plots = Plots::new(&args.plot, &plot_output::metrics_of(&parts.meta), &args.look, &layout.axes)?;
    plots.claim(&record, &mut outputs)?;
    let drawn = |parts: &TableParts| match plots.is_empty() {
        true => Ok(Vec::new()),
        false => plots.draw(&parts.bytes(form)?, form, &layout, &record),
    };
    if atomic_write::is_stream(&args.output) {
        parts.write(form, &args.output)?;
        drawn(&parts)?.iter().for_each(|file| console.note(&format!("wrote {}", stone::display_name(file))));
        return Ok(table_files::code(&parts.meta.summary));
    }
    let begun = Journal::belongs_to(&Journal::path_for(&args.output), &parts.identity());
    table_files::claim(&args.output, &|meta| meta.is_table_of(&parts.meta), None, begun, &mut outputs)?;
    let mut files = drawn(&parts)?;
    parts.publish(form, &args.output)?;
    files.insert(0, args.output.clone());
    table_files::tell_written(&files, &parts.meta.summary, &format!(" of {count} parts"), console)?;
    Ok(table_files::code(&parts.meta.summary))
}
