//! Drawings as PDF: SVG text to one page with lines as lines and text as text, the fonts embedded.

use super::raster::tree;
use krilla::Document;
use krilla::geom::Size;
use krilla::page::PageSettings;
use krilla_svg::{SurfaceExt, SvgSettings};

/// An SVG that cannot be made into a PDF, in words.
#[derive(Debug, thiserror::Error)]
#[error("the drawing cannot be written as PDF: {0}")]
pub struct PdfError(String);

/// Points, 1/72 in, in one of SVG's pixels, 1/96 in.
const POINTS: f32 = 72.0 / 96.0;

/// An SVG drawing as a PDF of one page of its size.
///
/// Text is set in the fonts of the binary and can be searched. The same SVG gives the same bytes. Checked
/// in `tests/program/diagram.rs`.
pub fn pdf(svg: &str) -> Result<Vec<u8>, PdfError> {
    let tree = tree(svg).map_err(|e| PdfError(e.to_string()))?;
    let size = Size::from_wh(POINTS * tree.size().width(), POINTS * tree.size().height())
        .ok_or_else(|| PdfError("it has no size".into()))?;
    let mut document = Document::new();
    let mut page = document.start_page_with(PageSettings::new(size));
    let mut surface = page.surface();
    surface
        .draw_svg(&tree, size, SvgSettings::default())
        .ok_or_else(|| PdfError("a part of it cannot be drawn".into()))?;
    surface.finish();
    page.finish();
    document.finish().map_err(|e| PdfError(format!("{e:?}")))
}
