//! Options of `cutlab report`.

use crate::cli::args::stone::{self, DEFAULT_STONE, StoneArgs};
use crate::cli::args::{scoring, values};
use crate::report::{LEAST_WIDTH, USUAL_WIDTH};
use crate::scene::scene_file::MOST_PIXELS;
use std::ffi::OsString;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab report tolkowsky -o out       writes into out/
  cutlab report designs/ -o out        every design of a folder, each into a folder of its own in out/

index.html shows it all and needs nothing beside it, on a screen, a phone or paper: pictures, proportions,
the cutting diagram, every score beside five reference stones of the same material, which tier to change
first, scores against the tilt, and for round brilliants their place on the map of light return. Beside it
stand the pictures (table.png, aset.png, ideal-scope.png, windows.png, brightness.png), diagram.svg,
scores.csv, stone.obj and stone.toml. Each picture from above is of the same light and stone as the scores beside it.")]
pub struct ReportArgs {
    /// Stones: names from `cutlab list cuts`, with parameters or not, files, folders of files, patterns;
    /// of several, each has a folder of its own in -o
    #[arg(default_value = DEFAULT_STONE, value_name = "STONE")]
    pub stones: Vec<OsString>,
    /// The folder to write into; it is made
    #[arg(long, short, value_name = "DIR")]
    pub output: PathBuf,
    /// Girdle width in millimetres [the stone's own, or 6.5]
    #[arg(long, value_name = "MM", value_parser = stone::millimetres)]
    pub size: Option<f64>,
    #[command(flatten)]
    pub stone_args: StoneArgs,
    /// Whether light keeps its polarisation from facet to facet, in scores and pictures; off takes it as
    /// unpolarised at each
    #[arg(long, value_name = "on|off", default_value = "on", value_parser = stone::on_off, action = clap::ArgAction::Set)]
    pub polarisation: bool,
    /// Trace every score until its standard error is below this times the metric's scale [a number of samples
    /// that leaves about 0.0005 for fractions]
    #[arg(long, value_name = "E", value_parser = scoring::error)]
    pub error: Option<f64>,
    /// Pixels across the picture on the table; the others are as high as it is
    #[arg(long, value_name = "PIXELS", default_value_t = USUAL_WIDTH, value_parser = values::whole_number(LEAST_WIDTH..=MOST_PIXELS, "a width is a whole number of pixels"))]
    pub width: u32,
    /// Seed of the random streams
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = values::seed)]
    pub seed: u64,
}
