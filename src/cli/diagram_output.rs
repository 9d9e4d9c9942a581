//! Cutting diagrams as files: SVG, and PDF or PNG of the same page.

use super::error::CliError;
use crate::design::Design;
use crate::report::diagram::Paper;
use crate::report::{diagram, pdf, raster};
use std::path::Path;

/// Dots a millimetre of a diagram's PNG: 200 dpi.
const DOTS_PER_MM: f64 = 200.0 / 25.4;

/// What a diagram is written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DiagramFormat {
    /// Lines and text.
    Svg,
    /// The same as a page for a printer.
    Pdf,
    /// Pixels.
    Png,
}

/// File extensions of diagrams.
pub const EXTENSIONS: [&str; 3] = ["svg", "pdf", "png"];

impl DiagramFormat {
    /// The kind that `name` asks for, one of [`EXTENSIONS`].
    pub fn by_name(name: &str) -> Option<DiagramFormat> {
        match &*name.to_lowercase() {
            "svg" => Some(DiagramFormat::Svg),
            "pdf" => Some(DiagramFormat::Pdf),
            "png" => Some(DiagramFormat::Png),
            _ => None,
        }
    }

    /// The kind that the extension of a file asks for.
    pub fn from_path(path: &Path) -> Option<DiagramFormat> {
        DiagramFormat::by_name(path.extension()?.to_str()?)
    }

    /// The diagram as a file's bytes.
    ///
    /// - `index`: the index of refraction that the angles are for, if it is known
    pub fn bytes(self, design: &Design, index: Option<f64>, paper: Paper) -> Result<Vec<u8>, CliError> {
        let svg = diagram::draw_on(design, index, paper)?;
        let failed = |why: String| CliError::input(why);
        match self {
            DiagramFormat::Svg => Ok(svg.into_bytes()),
            DiagramFormat::Pdf => pdf::pdf(&svg).map_err(|e| failed(e.to_string())),
            DiagramFormat::Png => {
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
