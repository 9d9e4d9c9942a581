//! Cutting diagrams as files: SVG, or PNG of the same page.

use super::outcome::Failure;
use crate::cut::Design;
use crate::report::{diagram, raster};
use std::path::Path;

/// Width of a diagram's PNG in pixels: A4 at 200 dpi.
const WIDTH: u32 = 1654;

/// What a diagram is written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drawing {
    /// Lines and text.
    Svg,
    /// Pixels.
    Png,
}

impl Drawing {
    /// The kind that `name` asks for: `svg` or `png`.
    pub fn named(name: &str) -> Option<Drawing> {
        match &*name.to_lowercase() {
            "svg" => Some(Drawing::Svg),
            "png" => Some(Drawing::Png),
            _ => None,
        }
    }

    /// The kind that the ending of a file asks for.
    pub fn of(path: &Path) -> Option<Drawing> {
        Drawing::named(path.extension()?.to_str()?)
    }

    /// The diagram as a file's bytes.
    ///
    /// - `index`: the index of refraction that the angles are for, if it is known
    pub fn bytes(self, design: &Design, index: Option<f64>) -> Result<Vec<u8>, Failure> {
        let svg = diagram::draw(design, index)?;
        match self {
            Drawing::Svg => Ok(svg.into_bytes()),
            Drawing::Png => raster::png(&svg, WIDTH).map_err(|e| Failure::input(e.to_string())),
        }
    }
}
