//! Formats of drawings as files: SVG, and PDF or PNG of the same page.

use super::stone_report::ReportError;
use super::{pdf, raster};
use crate::render::Record;
use std::path::Path;

/// What a drawing is written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DrawingFormat {
    /// Lines and text.
    Svg,
    /// The same as a page for a printer.
    Pdf,
    /// Pixels.
    Png,
}

impl DrawingFormat {
    /// Every format with its name, which is its files' extension.
    pub const ALL: [(&str, DrawingFormat); 3] =
        [("svg", DrawingFormat::Svg), ("pdf", DrawingFormat::Pdf), ("png", DrawingFormat::Png)];

    /// The format that is called so.
    pub fn by_name(name: &str) -> Option<DrawingFormat> {
        let name = name.to_lowercase();
        DrawingFormat::ALL.iter().find(|(known, _)| *known == name).map(|(_, format)| *format)
    }

    /// The format that the extension of a file asks for.
    pub fn from_path(path: &Path) -> Option<DrawingFormat> {
        DrawingFormat::by_name(&path.extension()?.to_string_lossy())
    }

    /// The extension of its files.
    pub fn extension(self) -> &'static str {
        DrawingFormat::ALL.iter().find(|(_, format)| *format == self).map_or("svg", |(name, _)| name)
    }

    /// A drawing as a file's bytes.
    ///
    /// - `width`: pixels across, of a PNG
    /// - `record`: of what made it, which the file then has
    pub fn bytes(self, svg: String, width: u32, record: Option<&Record>) -> Result<Vec<u8>, ReportError> {
        Ok(match (self, record) {
            (DrawingFormat::Svg, None) => svg.into_bytes(),
            (DrawingFormat::Svg, Some(record)) => record.in_markup(svg).into_bytes(),
            (DrawingFormat::Pdf, None) => pdf::pdf(&svg)?,
            (DrawingFormat::Pdf, Some(record)) => record.in_pdf(pdf::pdf(&svg)?),
            (DrawingFormat::Png, record) => raster::png_of(&svg, width, record)?,
        })
    }
}
