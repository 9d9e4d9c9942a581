//! Drawings as pictures: SVG text to PNG, and how wide a text is. The fonts are in the binary, so
//! that the same drawing gives the same pixels on every machine.

use crate::render::Record;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{self, fontdb};
use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, MetadataProvider};
use std::sync::{Arc, LazyLock};

/// The family of the fonts in the binary, for `font-family`. A viewer of the SVG that does not have
/// it should be offered [`FONTS`].
pub const FAMILY: &str = "DejaVu Sans Condensed";

/// A `font-family` for drawings: ours, then what is about as wide and found everywhere.
pub const FONTS: &str = "DejaVu Sans Condensed, Arial, Helvetica, sans-serif";

/// Latin, Greek and Cyrillic subsets; their licence is beside them.
const REGULAR: &[u8] = include_bytes!("fonts/DejaVuSansCondensed.ttf");
const BOLD: &[u8] = include_bytes!("fonts/DejaVuSansCondensed-Bold.ttf");

/// Widest picture that is drawn, in pixels: A4 at 1200 dpi.
pub const MOST_PIXELS: u32 = 10_000;

/// An SVG that cannot be drawn.
#[derive(Debug, thiserror::Error)]
pub enum RasterError {
    /// No SVG that resvg understands.
    #[error("the drawing is not an SVG: {0}")]
    Svg(#[from] usvg::Error),
    /// Too large or without size.
    #[error("a drawing of {width} × {height} pixels: each must be from 1 to {MOST_PIXELS}")]
    Size {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// The PNG encoder failed.
    #[error("the picture cannot be encoded: {0}")]
    Encode(String),
}

/// An SVG drawing as it is understood, its text in the fonts of the binary.
pub(super) fn tree(svg: &str) -> Result<usvg::Tree, usvg::Error> {
    usvg::Tree::from_str(svg, &OPTIONS)
}

/// What resvg may use: our two fonts, under every generic name, and no file.
static OPTIONS: LazyLock<usvg::Options<'static>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(REGULAR.to_vec());
    fonts.load_font_data(BOLD.to_vec());
    fonts.set_serif_family(FAMILY);
    fonts.set_sans_serif_family(FAMILY);
    fonts.set_monospace_family(FAMILY);
    fonts.set_cursive_family(FAMILY);
    fonts.set_fantasy_family(FAMILY);
    let mut options =
        usvg::Options { fontdb: Arc::new(fonts), font_family: FAMILY.into(), ..Default::default() };
    options.image_href_resolver.resolve_string = Box::new(|_, _| None);
    options
});

/// An SVG drawing as PNG, on white.
///
/// - `width`: of the picture in pixels, up to [`MOST_PIXELS`]; the height follows from the drawing
///
/// Text is drawn in the fonts of the binary whatever family it asks for; files that the SVG refers
/// to are not opened. The same SVG gives the same bytes. Checked in this file's tests.
pub fn png(svg: &str, width: u32) -> Result<Vec<u8>, RasterError> {
    png_of(svg, width, None)
}

/// As [`png()`].
///
/// - `record`: where it comes from, for the picture's texts `Command` and `Request`
pub fn png_of(svg: &str, width: u32, record: Option<&Record>) -> Result<Vec<u8>, RasterError> {
    let tree = tree(svg)?;
    let scale = width as f32 / tree.size().width();
    let height = (tree.size().height() * scale).round() as u32;
    let too_large = RasterError::Size { width, height };
    if !(1..=MOST_PIXELS).contains(&width) || !(1..=MOST_PIXELS).contains(&height) {
        return Err(too_large);
    }
    let mut pixels = Pixmap::new(width, height).ok_or(too_large)?;
    pixels.fill(resvg::tiny_skia::Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixels.as_mut());
    let fail = |e: png::EncodingError| RasterError::Encode(e.to_string());
    let mut out = Vec::new();
    let mut encoder = png::Encoder::new(&mut out, width, height);
    encoder.set_color(png::ColorType::Rgba); // on white: nothing is left to multiply
    encoder.set_depth(png::BitDepth::Eight);
    if let Some(Record { command, request }) = record {
        encoder.add_itxt_chunk("Command".into(), command.clone()).map_err(fail)?;
        request
            .iter()
            .try_for_each(|request| encoder.add_itxt_chunk("Request".into(), request.clone()))
            .map_err(fail)?;
    }
    let mut writer = encoder.write_header().map_err(fail)?;
    writer.write_image_data(pixels.data()).map_err(fail)?;
    writer.finish().map_err(fail)?;
    Ok(out)
}

/// Width of a line of text in the fonts of the binary, in units of the font size; without kerning,
/// which only narrows.
///
/// Checked in this file's tests against the drawn text.
pub fn text_width(text: &str, bold: bool) -> f64 {
    static FACES: LazyLock<[Option<FontRef<'static>>; 2]> =
        LazyLock::new(|| [REGULAR, BOLD].map(|bytes| FontRef::new(bytes).ok()));
    /// For a font that cannot be read: no letter is wider.
    const WIDEST: f64 = 1.0;
    let Some(font) = &FACES[usize::from(bold)] else { return WIDEST * text.chars().count() as f64 };
    let (letters, widths) = (font.charmap(), font.glyph_metrics(Size::new(1.0), LocationRef::default()));
    let width = |c| widths.advance_width(letters.map(c).unwrap_or_default()).map_or(WIDEST, f64::from);
    text.chars().map(width).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// First and last column, of 1000, with ink.
    fn inked(body: &str) -> (u32, u32) {
        let svg = format!("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 1000 100'>{body}</svg>");
        let picture = image::load_from_memory(&png(&svg, 1000).expect("draws")).expect("a PNG").to_luma8();
        assert_eq!(picture.dimensions(), (1000, 100));
        let dark = picture.enumerate_pixels().filter(|(.., p)| p.0[0] < 128).map(|(x, ..)| x);
        dark.fold((u32::MAX, 0), |(lo, hi), x| (lo.min(x), hi.max(x)))
    }

    #[test]
    fn text_is_as_wide_as_it_says_in_whatever_family() {
        for (family, weight, text) in [
            (FONTS, "normal", "Illustrated 43.00° – ±²³×−"),
            ("No Such Font", "normal", "Illustrated 43.00° – ±²³×−"),
            ("serif", "bold", "Schliff Größe λ Ж"),
        ] {
            let (first, last) = inked(&format!(
                "<text x='50' y='60' font-family='{family}' font-weight='{weight}' font-size='40'>{text}</text>"
            ));
            let width = 40.0 * text_width(text, weight == "bold");
            let drawn = f64::from(last + 1 - first);
            // side bearings and kerning make the ink narrower than the advances
            assert!(drawn < width && drawn > 0.95 * width, "{family}: drawn {drawn}, measured {width}");
        }
        assert!(text_width("P1", true) > text_width("P1", false));
    }

    #[test]
    fn every_sign_a_drawing_may_use_is_in_both_fonts() {
        for bytes in [REGULAR, BOLD] {
            let font = FontRef::new(bytes).expect("a font");
            for c in "AZaz09°±²³×−–—…µλθÄÖÜäöüßéñ·→≤≥“”’′″".chars()
            {
                assert!(font.charmap().map(c).is_some(), "{c}");
            }
        }
        assert!(REGULAR.len() + BOLD.len() < 400_000);
    }

    #[test]
    fn no_picture_is_drawn_of_nothing_or_of_too_much() {
        assert!(matches!(png("no drawing", 100), Err(RasterError::Svg(_))));
        let tall = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 1 1000'/>";
        assert!(matches!(png(tall, 1000), Err(RasterError::Size { height: 1_000_000, .. })));
        assert!(matches!(png(tall, 0), Err(RasterError::Size { .. })));
    }
}
