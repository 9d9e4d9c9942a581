//! Weights in carats on the command line.

use super::error::CliError;
use crate::design::Design;
use crate::materials::weight::Weight;
use crate::parse;
use crate::parse::NumberUnit;

/// The girdle width in millimetres of a stone of the design's shape that weighs `carats`.
pub fn width_mm(weight: &Weight, design: &Design, carats: f64) -> Result<f64, CliError> {
    let solid = design.solid()?;
    let volume =
        weight.volume_mm3(carats).map_err(|why| CliError::input(format!("--carat {carats}: {why}")))?;
    Ok(solid.width() * (volume / solid.volume()).cbrt())
}

/// Value parser of `--carat`.
pub fn carats(text: &str) -> Result<f64, String> {
    parse::parse_number_within(text, NumberUnit::Carats, 1e-6..=1e6, "a weight is a number of carats")
}
