//! `cutlab merge`: the parts of a table, joined.

use super::console::Console;
use super::folders;
use super::outcome::{Code, Failure};
use super::outputs::Outputs;
use super::plots::{self, Look, Plots};
use super::stones;
use super::tables;
use crate::store::progress::Progress;
use crate::store::replace;
use crate::study::merge::{MergeError, Part, Parts};
use std::ffi::OsString;
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab score designs/ --shard 1/2 -o one.csv     on one machine
  cutlab score designs/ --shard 2/2 -o two.csv     on another
  cutlab merge one.csv two.csv -o all.csv          the bytes of: cutlab score designs/ -o all.csv
  cutlab merge 'part*.csv' -o sweep.csv --plot wlr.svg    and a map, of the parts of a sweep

Each part needs its companion beside it (one.csv.meta.json), which says which part it is. The whole is
written as its own name says, whatever the parts are.")]
pub struct Args {
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
pub fn run(args: &Args, console: &Console) -> Result<Code, Failure> {
    let form = tables::form_of(&args.output, console)?;
    let tables = folders::parts(&args.parts)?;
    let mut outputs = Outputs::of(console);
    tables.iter().for_each(|table| outputs.reads(table));
    let parts: Vec<Part> = tables.iter().map(|p| Part::open(p)).collect::<Result<_, _>>()?;
    let count = parts.len();
    let mut parts = Parts::of(parts)?;
    let command = parts.meta.command.clone();
    let layout = match args.plot.is_empty() {
        true => Default::default(),
        false => plots::layout_of(Path::new(&args.parts[0]), &parts.meta)?,
    };
    let plots = Plots::of(&args.plot, &plots::metrics_of(&parts.meta), &args.look, &layout.axes)?;
    plots.claim(&command, &mut outputs)?;
    let drawn = |parts: &Parts| match plots.is_empty() {
        true => Ok(Vec::new()),
        false => plots.draw(&parts.bytes(form)?, form, &layout, &command),
    };
    if replace::is_stream(&args.output) {
        parts.write(form, &args.output)?;
        drawn(&parts)?.iter().for_each(|file| console.note(&format!("wrote {}", stones::shown(&file))));
        return Ok(tables::code(&parts.meta.summary));
    }
    let begun = Progress::is_of(&Progress::beside(&args.output), &parts.identity());
    tables::claim_table(&args.output, &command, None, begun, &mut outputs)?;
    let mut files = drawn(&parts)?;
    parts.publish(form, &args.output)?;
    files.insert(0, args.output.clone());
    tables::tell_written(&files, &parts.meta.summary, &format!(" of {count} parts"), console)?;
    Ok(tables::code(&parts.meta.summary))
}

impl From<MergeError> for Failure {
    fn from(error: MergeError) -> Failure {
        match error {
            MergeError::Read { path, cause } => Failure::reading(&stones::shown(&path), &cause),
            MergeError::Write(cause) => cause.into(),
            other => Failure::input(other.to_string()),
        }
    }
}
