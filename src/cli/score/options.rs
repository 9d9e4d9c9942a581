//! Options of `cutlab score`.

use crate::batch::request::SortRequest;
use crate::batch::sweep::Steps;
use crate::batch::table_job::Order;
use crate::cli::args::scoring::{self, ScoringArgs};
use crate::cli::args::stone::DEFAULT_STONE;
use crate::cli::args::tables::TableArgs;
use crate::cli::plot_output::Look;
use crate::design::outline_shape::{NoSuchOutline, OutlineShape};
use crate::parse::{self, NumberUnit};
use crate::scoring::Tilt;
use std::ffi::OsString;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab score                                       the reference brilliant, to be read, or CSV in a pipe
  cutlab score designs/ '*.gem' -o scores.csv        every design of a folder, and what matches
  cutlab score designs/ --metrics iso,cos --sort iso --top 10 --proportions -o best.csv
  cutlab score designs/ --outline oval --material tourmaline --metrics iso,wlr --sort iso --top 20
  cutlab score tolkowsky --metrics wlr,fire_streak --error 0.001
  cutlab score D.asc:material=quartz D.asc:material=topaz
  cutlab score tolkowsky --metrics wlr --tilt -30:30:5 --plot tilt.svg    curves about both axes
  cutlab score designs/ --shard 2/8 -o part2.csv     the second of eight machines; cutlab merge")]
pub struct ScoreArgs {
    /// Stones: names from `cutlab list cuts`, with parameters or not, files, folders of files,
    /// patterns as 'designs/*.asc'; each may say its material, as designs/:material=topaz
    #[arg(default_value = DEFAULT_STONE, value_name = "STONE")]
    pub stones: Vec<OsString>,
    #[command(flatten)]
    pub table: TableArgs,
    #[command(flatten)]
    pub scoring: ScoringArgs,
    /// Add columns of each stone's name, proportions and weight
    #[arg(long)]
    pub proportions: bool,
    /// Score stones with this outline alone: round, oval, pear, marquise, square, rectangle, cushion, triangle,
    /// pentagon, hexagon, octagon, polygon or other; several with commas
    #[arg(long, value_name = "OUTLINE,…", value_delimiter = ',', value_parser = outline)]
    pub outline: Vec<OutlineShape>,
    /// Sort the rows by a metric, the greatest first; -METRIC the least first
    #[arg(long, value_name = "METRIC", value_parser = parse_sort, allow_hyphen_values = true)]
    pub sort: Option<SortRequest>,
    /// Keep the first N rows of the sorted table
    #[arg(long, value_name = "N", requires = "sort", value_parser = parse_top)]
    pub top: Option<u64>,
    /// Turn the stone before viewer and light, one row a tilt, in degrees
    #[arg(long, value_name = "FROM:TO:STEP", value_parser = tilt, allow_hyphen_values = true)]
    pub tilt: Option<Steps>,
    /// Azimuth of the horizontal axis to tilt about, in degrees from +x; several with commas [0; with
    /// --plot 0,90]
    #[arg(
        long,
        value_name = "AZIMUTH,…",
        value_delimiter = ',',
        value_parser = azimuth,
        allow_hyphen_values = true,
        requires = "tilt"
    )]
    pub tilt_axis: Vec<f64>,
    /// Draw the scores against the tilt, a curve for each stone and axis, .svg, .pdf or .png; a file called
    /// METRIC.svg shows that metric, of any other name one is drawn for each, NAME-METRIC.svg
    #[arg(long, value_name = "FILE", requires = "tilt", conflicts_with_all = ["shard", "sort"])]
    pub plot: Vec<PathBuf>,
    #[command(flatten)]
    pub look: Look,
}

/// Value parser of `--sort`.
fn parse_sort(text: &str) -> Result<SortRequest, String> {
    let name = text.strip_prefix('-').unwrap_or(text);
    let order = Order { ascending: text.starts_with('-'), top: None };
    Ok(SortRequest { metric: scoring::metric(name)?, order })
}

/// Value parser of `--outline`.
fn outline(text: &str) -> Result<OutlineShape, String> {
    text.parse().map_err(|error: NoSuchOutline| error.to_string())
}

/// Value parser of `--top`.
fn parse_top(text: &str) -> Result<u64, String> {
    parse::parse_whole_number(text, 1..=u64::MAX, "--top takes a whole number of rows")
}

/// Value parser of `--tilt-axis`.
fn azimuth(text: &str) -> Result<f64, String> {
    parse::parse_number_within(text, NumberUnit::Degrees, -360.0..=360.0, "an azimuth is a number of degrees")
}

/// Value parser of `--tilt`.
fn tilt(text: &str) -> Result<Steps, String> {
    let steps = Steps::parse(text, NumberUnit::Degrees)?;
    match steps.from.abs().max(steps.to.abs()) <= Tilt::MOST_DEGREES {
        true => Ok(steps),
        false => Err(format!("a stone can be tilted by up to {}°", Tilt::MOST_DEGREES)),
    }
}
