//! Options of `cutlab import`, and what `generate` sets beside.

use crate::cli::args::stone::{self, OrientationArgs, StoneArgs};
use crate::report::diagram::Paper;
use std::ffi::OsString;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab import stone.gem -o stone.asc
  cutlab import designs -o meshes --to glb     a folder with all that is in it, as glb into meshes/

Files of a folder that are of no known format are passed over. Nothing is overwritten without
--force; what an interrupted import has written is left as it is. A closed mesh with dents or in several parts is written as a mesh, and said to be one.")]
pub struct ImportArgs {
    /// Designs, meshes, and folders of them; the content decides the format of each
    #[arg(required = true, value_name = "FILE|DIR")]
    pub files: Vec<OsString>,
    /// Where to write: a file whose extension chooses the format, or a folder
    #[arg(long, short, value_name = "OUT")]
    pub output: PathBuf,
    /// Format to write, a name or extension from `cutlab list formats`, or svg or png for the cutting
    /// diagram [for a folder: toml]
    #[arg(long, value_name = "FORMAT")]
    pub to: Option<String>,
    /// Scale to this girdle width in millimetres
    #[arg(long, value_name = "MM", value_parser = stone::millimetres)]
    pub size: Option<f64>,
    #[command(flatten)]
    pub orientation: OrientationArgs,
    /// What `generate` sets beside, for the stones of a folder.
    #[arg(skip)]
    pub made: GenerateSettings,
}

/// What `generate` sets, of which `import` has no options.
#[derive(Debug, Clone, Default)]
pub struct GenerateSettings {
    /// Weight in carats, in place of a size.
    pub carat: Option<f64>,
    /// Paper of cutting diagrams.
    pub paper: Option<Paper>,
    /// What the stones are made of.
    pub stone_args: StoneArgs,
}

impl ImportArgs {
    /// Of everything in one folder into another.
    pub fn for_folder(
        folder: OsString,
        output: PathBuf,
        to: &str,
        size: Option<f64>,
        made: GenerateSettings,
    ) -> ImportArgs {
        let orientation = made.stone_args.orientation;
        ImportArgs { files: vec![folder], output, to: Some(to.to_owned()), size, orientation, made }
    }
}
