//! `cutlab merge`: the parts of a table, joined.

use super::console::Console;
use super::folders;
use super::outcome::{Code, Failure};
use super::tables;
use crate::study::merge::{self, MergeError, Part};
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab score designs/ --shard 1/2 -o one.csv     on one machine
  cutlab score designs/ --shard 2/2 -o two.csv     on another
  cutlab merge one.csv two.csv -o all.csv          the bytes of: cutlab score designs/ -o all.csv

Each part needs its companion beside it (one.meta.json), which says which part it is.")]
pub struct Args {
    /// The tables that --shard made
    #[arg(required = true, value_name = "PART")]
    parts: Vec<String>,
    /// Where to write the whole table
    #[arg(long, short, value_name = "FILE")]
    output: PathBuf,
}

/// Joins the parts.
pub fn run(args: &Args, console: &Console) -> Result<Code, Failure> {
    let parts = folders::matched(&args.parts)?;
    let parts: Vec<Part> = parts.iter().map(|p| Part::open(p)).collect::<Result<_, _>>()?;
    let meta = merge::merge(&parts, &args.output)?;
    console.note(&format!(
        "wrote {}: {} rows of {} parts",
        args.output.display(),
        meta.summary.rows,
        parts.len()
    ));
    Ok(tables::code(&meta.summary))
}

impl From<MergeError> for Failure {
    fn from(error: MergeError) -> Failure {
        match error {
            MergeError::Read { path, cause } => Failure::reading(&path.display().to_string(), &cause),
            MergeError::Write(cause) => cause.into(),
            other => Failure::input(other.to_string()),
        }
    }
}
