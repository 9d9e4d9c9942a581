//! STONE arguments: opened in parallel, each on its own, and the options about them.

use super::material::material;
use crate::cli::error::CliError;
use crate::cli::limits::limits;
use crate::materials::Material;
use crate::parse;
use crate::stone::{Orientation, Stone, StoneOptions, UpAxis, grammar};
pub use crate::storage::text::display_name;
use std::ffi::OsStr;

/// The stone that every command takes when none is named.
pub const DEFAULT_STONE: &str = "round-brilliant";

/// What is asked for of every stone of a command, but for its size.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct StoneArgs {
    /// Material, see `cutlab list materials`, or a TOML file of your own, see `cutlab help materials` [the
    /// file's own index, or diamond]
    #[arg(long, value_name = "NAME", value_parser = material)]
    pub material: Option<Material>,
    /// One refractive index, without dispersion, in place of a material
    #[arg(long, value_name = "N", value_parser = grammar::refractive_index, conflicts_with = "material")]
    pub ri: Option<f64>,
    #[command(flatten)]
    pub orientation: OrientationArgs,
}

/// Which way up the stones of files stand.
#[derive(Debug, Clone, Copy, Default, clap::Args)]
pub struct OrientationArgs {
    /// The axis of a stone's file that points up, through the table [z]
    #[arg(long, value_name = "x|y|z|-x|-y|-z", value_parser = axis, allow_hyphen_values = true,
        conflicts_with = "align", display_order = 999)]
    up: Option<UpAxis>,
    /// Stand the stone of a file upright: by its axis of symmetry, or else by its largest facet
    #[arg(long, display_order = 999)]
    align: bool,
}

impl StoneArgs {
    /// What is asked for of every stone.
    ///
    /// - `size_mm`: girdle width; none for each stone's own
    pub fn options(&self, size_mm: Option<f64>) -> StoneOptions {
        let OrientationArgs { up, align } = self.orientation;
        StoneOptions {
            material: self.material.as_ref().map(|m| m.argument().into()),
            ri: self.ri,
            size_mm,
            orientation: Orientation { up, align },
            opened_material: self.material.clone(),
            limits: limits(),
        }
    }

    /// Opens a stone as it is asked for, in its own size.
    pub fn open(&self, spec: impl AsRef<OsStr>) -> Result<Stone, CliError> {
        Ok(Stone::open(spec, &self.options(None))?)
    }

    /// As [`StoneArgs::open`], for what needs a convex stone.
    pub fn open_convex(&self, spec: impl AsRef<OsStr>) -> Result<Stone, CliError> {
        let stone = self.open(spec)?;
        stone.convex_design()?;
        Ok(stone)
    }

    /// What to say if the index of the material asked for is a guess within `from`..=`to` (nm).
    pub fn range_note(&self, from: f64, to: f64) -> Option<String> {
        Some(format!("note: {}", self.material.as_ref()?.extrapolated(from, to)?))
    }
}

/// Value parser of `--size`.
pub fn millimetres(text: &str) -> Result<f64, String> {
    parse::parse_number_within(
        text,
        parse::NumberUnit::Millimetres,
        1e-3..=1e3,
        "a girdle width is a number of millimetres",
    )
}

/// Value parser of `--polarisation`.
pub fn on_off(text: &str) -> Result<bool, String> {
    match &*text.trim().to_lowercase() {
        "on" => Ok(true),
        "off" => Ok(false),
        _ => Err("polarisation is on or off".into()),
    }
}

/// Value parser of `--up`.
fn axis(text: &str) -> Result<UpAxis, String> {
    let text = text.to_lowercase();
    let found = UpAxis::ALL.iter().find(|(name, _)| *name == text.trim_start_matches('+'));
    Ok(found.ok_or("expected one of x, y, z, -x, -y, -z")?.1)
}
