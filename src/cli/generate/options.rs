//! Options of `cutlab generate`.

use crate::cli::args::family::FamilyArgs;
use crate::cli::args::stone::{self, DEFAULT_STONE, StoneArgs};
use crate::cli::args::values;
use crate::cli::weight;
use crate::report::diagram::Paper;
use std::ffi::OsString;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab generate --facets 153                    round-brilliant-153.obj in this folder; or --to stl
  cutlab generate --table 57 --crown-angle 35 -o stone.obj -o stone.toml
  cutlab generate prism --sides 6 --height 5      also bipyramid, octahedron
  cutlab generate round-brilliant:depth=61.5,crown-height=15,pavilion-depth=43 --carat 1 -o stone.glb
  cutlab generate classic -o classic.svg          the cutting diagram, one page; also .pdf, .png
  cutlab generate designs/ --to svg -o sheets     the diagrams of a whole folder, into another")]
pub struct GenerateArgs {
    /// What to make: a name from `cutlab list cuts`, with parameters or not, a file, or a folder of
    /// files, whose stones are written into the folder -o
    #[arg(default_value = DEFAULT_STONE)]
    pub stone: OsString,
    /// Exact total of facets; girdle flats are added or taken to meet it
    #[arg(long, value_name = "N", value_parser = values::whole_number(1..=1_000_000, "a total of facets is a whole number"))]
    pub facets: Option<u32>,
    /// Girdle diameter (width) in millimetres
    #[arg(long, value_name = "MM", value_parser = stone::millimetres)]
    pub size: Option<f64>,
    /// Weight in carats, in place of --size: the width follows from the density of the material, or of
    /// diamond
    #[arg(long, value_name = "CT", value_parser = weight::carats, conflicts_with = "size")]
    pub carat: Option<f64>,
    /// Where to write; the extension chooses the format, .svg, .pdf and .png the cutting diagram; may be
    /// given several times
    #[arg(long, short, value_name = "FILE")]
    pub output: Vec<PathBuf>,
    /// Format for `-o -` and for a folder, or where the extension of a file says none: a name or extension from
    /// `cutlab list formats`, svg, pdf or png [obj]
    #[arg(long, value_name = "FORMAT")]
    pub to: Option<String>,
    /// Paper of the cutting diagram
    #[arg(long, value_name = "a4|letter", default_value = "a4", value_parser = values::paper)]
    pub paper: Paper,
    /// What the stone is made of: the index of refraction that design files state and the material in
    /// glTF
    #[command(flatten)]
    pub stone_args: StoneArgs,
    #[command(flatten)]
    pub parameters: FamilyArgs,
}

/// What goes to standard output and into a folder unless it is said.
pub const USUAL_FORMAT: &str = "obj";
