//! Options of `cutlab report`.

use crate::cli::args::stone::{self, DEFAULT_STONE, StoneArgs};
use crate::cli::args::values;
use std::ffi::OsString;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab report tolkowsky -o out       writes into out/
  cutlab report designs/ -o out        every design of a folder, each into a folder of its own in out/

index.html shows it all and needs nothing beside it, on a screen, a phone or paper: pictures, proportions,
the cutting diagram, every score beside five reference stones of the same material, scores against the
tilt, and for round brilliants their place on the map of light return. Beside it stand the pictures
(table.png, aset.png, ideal-scope.png, windows.png, brightness.png), diagram.svg, scores.csv, stone.obj and
stone.toml. Each picture from above is of the same light and stone as the scores beside it.")]
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
    /// Seed of the random streams
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = values::seed)]
    pub seed: u64,
}
