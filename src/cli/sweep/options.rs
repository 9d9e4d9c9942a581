//! Options of `cutlab sweep`.

use crate::batch::sweep::SweptParameter;
use crate::cli::args::scoring::ScoringArgs;
use crate::cli::args::tables::TableArgs;
use crate::cli::plot_output::Look;
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
