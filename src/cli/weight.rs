//! Weights in carats on the command line.

use super::outcome::Failure;
use crate::cut::Design;
use crate::math::typed::{self, Unit};
use crate::optics::weight::Weight;

/// The girdle width in millimetres of a stone of the design's shape that weighs `carats`.
pub fn width_mm(weight: &Weight, design: &Design, carats: f64) -> Result<f64, Failure> {
    let solid = design.solid()?;
    let volume =
        weight.volume_mm3(carats).map_err(|why| Failure::input(format!("--carat {carats}: {why}")))?;
    Ok(solid.width() * (volume / solid.volume()).cbrt())
}

/// Value parser of `--carat`.
pub fn carats(text: &str) -> Result<f64, String> {
    typed::within(text, Unit::Carats, 1e-6..=1e6, "a weight is a number of carats")
}
