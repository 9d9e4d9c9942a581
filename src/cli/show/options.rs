//! Options of `cutlab show`.

use crate::cli::args::stone::{self, StoneArgs};
use crate::cli::args::values;
use crate::cli::weight;
use crate::report::diagram::Paper;
use std::ffi::OsString;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Every measure follows from the planes alone, so that a stone measures alike in every file format.
Percentages are of the girdle width, the least distance of two parallel lines around the outline.
Crown and pavilion angle are those of the main facet across the width. Main facets are those that span the
greatest height of their side: the mains of a brilliant, the first step of a step cut. Of these the one
counts that faces along the width most nearly, and of several that do so alike the steepest.
The weight is that of --material. A design drawn for an index is weighed as the known material nearest to
it, if one lies within 0.01; a stone without either is weighed as diamond.")]
pub struct ShowArgs {
    /// Stones: names from `cutlab list cuts`, with parameters or not, files, folders of files, patterns
    #[arg(required = true, value_name = "STONE")]
    pub stones: Vec<OsString>,
    /// Girdle width in millimetres, for volume in mm³ and weight
    #[arg(long, value_name = "MM", value_parser = stone::millimetres)]
    pub size: Option<f64>,
    /// Weight in carats, in place of --size: the width follows from the material's density
    #[arg(long, value_name = "CT", value_parser = weight::carats, conflicts_with = "size")]
    pub carat: Option<f64>,
    #[command(flatten)]
    pub stone_args: StoneArgs,
    /// Also the meet network: which tiers meet in which corners, which are free, and what holds outline, girdle,
    /// table and culet when the design is edited
    #[arg(long)]
    pub meets: bool,
    /// Also draw the virtual facets of the stone, face-up: by exact beams, shaded by where the
    /// strongest light of each point comes from; SVG (one stone only)
    #[arg(long, value_name = "PATTERN.svg")]
    pub beams: Option<PathBuf>,
    /// Also draw the cutting diagram, one page: SVG, PDF or PNG by its extension (one stone only)
    #[arg(long, value_name = "DIAGRAM.svg")]
    pub diagram: Option<PathBuf>,
    /// Paper of the cutting diagram
    #[arg(long, value_name = "a4|letter", default_value = "a4", value_parser = values::paper)]
    pub paper: Paper,
}
