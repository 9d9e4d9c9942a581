//! Cutting diagrams as files: SVG, and PDF or PNG of the same page.

use super::outcome::Failure;
use crate::cut::Design;
use crate::report::diagram::Paper;
use crate::report::{diagram, pdf, raster};
use std::path::Path;

/// Dots a millimetre of a diagram's PNG: 200 dpi.
const DOTS_PER_MM: f64 = 200.0 / 25.4;

/// What a diagram is written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drawing {
    /// Lines and text.
    Svg,
    /// The same as a page for a printer.
    Pdf,
    /// Pixels.
    Png,
}

/// File endings of diagrams.
pub const ENDINGS: [&str; 3] = ["svg", "pdf", "png"];

impl Drawing {
    /// The kind that `name` asks for, one of [`ENDINGS`].
    pub fn named(name: &str) -> Option<Drawing> {
        match &*name.to_lowercase() {
            "svg" => Some(Drawing::Svg),
            "pdf" => Some(Drawing::Pdf),
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
    pub fn bytes(self, design: &Design, index: Option<f64>, paper: Paper) -> Result<Vec<u8>, Failure> {
        let svg = diagram::draw_on(design, index, paper)?;
        let failed = |why: String| Failure::input(why);
        match self {
            Drawing::Svg => Ok(svg.into_bytes()),
            Drawing::Pdf => pdf::pdf(&svg).map_err(|e| failed(e.to_string())),
            Drawing::Png => {
                let width = (DOTS_PER_MM * paper.size_mm().x).round() as u32;
                raster::png(&svg, width).map_err(|e| failed(e.to_string()))
            }
        }
    }
}

/// Value parser of `--paper`.
pub fn paper(name: &str) -> Result<Paper, String> {
    match &*name.to_lowercase() {
        "a4" => Ok(Paper::A4),
        "letter" => Ok(Paper::Letter),
        _ => Err("paper is a4 or letter".into()),
    }
}
