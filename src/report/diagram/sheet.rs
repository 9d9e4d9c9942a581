//! The sheet of a diagram: lines and text in millimetres, black on white, and how wide text is there.

use crate::report::raster::{FONTS, text_width};
use crate::report::svg_canvas::{Anchor, Element, PathData};
use glam::DVec2;

/// The sheet that a diagram is laid out for, upright.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Paper {
    /// 210 mm × 297 mm.
    #[default]
    A4,
    /// 8.5 in × 11 in.
    Letter,
}

impl Paper {
    /// Width and height in mm.
    pub fn size_mm(self) -> DVec2 {
        match self {
            Paper::A4 => DVec2::new(210.0, 297.0),
            Paper::Letter => DVec2::new(215.9, 279.4),
        }
    }
}

/// Widths of lines in mm: outlines, facets, rules and ticks.
pub const OUTLINE: f64 = 0.4;
/// See [`OUTLINE`].
pub const FACET: f64 = 0.2;
/// See [`OUTLINE`].
pub const HAIR: f64 = 0.12;

/// Height of capitals and figures in the fonts of the binary, in units of the font size.
pub const CAPITAL: f64 = 0.729;

/// Decimals of coordinates in mm.
pub const DECIMALS: usize = 2;

/// A sheet as far as it is drawn.
#[derive(Debug)]
pub struct Sheet {
    drawing: Element,
}

impl Sheet {
    /// An empty sheet.
    pub fn new(title: &str, paper: Paper) -> Sheet {
        let size = paper.size_mm();
        let drawing = Element::drawing(DVec2::ZERO, size)
            .decimals(DECIMALS)
            .attribute("width", format!("{}mm", size.x))
            .attribute("height", format!("{}mm", size.y))
            .attribute("font-family", FONTS)
            .fill("#000")
            .with(Element::title(title))
            .with(Element::rect(DVec2::ZERO, size).fill("#fff"));
        Sheet { drawing }
    }

    /// Puts an element on the sheet.
    pub fn push(&mut self, element: Element) {
        self.drawing.push(element);
    }

    /// A line of text; `at` is on its base line.
    pub fn text(&mut self, at: DVec2, size: f64, anchor: Anchor, bold: bool, text: &str) {
        if !text.is_empty() {
            let text = Element::text(at, text).font_size(size).anchor(anchor);
            self.push(if bold { text.bold() } else { text });
        }
    }

    /// Path data as lines.
    pub fn lines(&mut self, data: PathData, width: f64) {
        if !data.is_empty() {
            self.push(lines(data, width));
        }
    }

    /// Path data as lines, under a name.
    pub fn named_lines(&mut self, id: &str, data: PathData, width: f64) {
        if !data.is_empty() {
            self.push(lines(data, width).id(id));
        }
    }

    /// A rule across.
    pub fn rule(&mut self, from: DVec2, width: f64) {
        self.lines(PathData::new(DECIMALS).across(from, width), HAIR);
    }

    /// The finished document.
    pub fn finish(self) -> String {
        self.drawing.document()
    }
}

fn lines(data: PathData, width: f64) -> Element {
    Element::path(data).fill("none").stroke("#000", width).round_joins()
}

/// A name with its middle at `at`, its line along `along`.
pub fn name(at: DVec2, size: f64, along: DVec2, name: &str) -> Element {
    let down = 0.5 * CAPITAL * size;
    let text = match along.y.abs() < 1e-9 {
        true => Element::text(at + DVec2::new(0.0, down), name),
        false => Element::turned_text(at, along.to_angle().to_degrees(), name).length("y", down),
    };
    text.font_size(size).anchor(Anchor::Middle)
}

/// Width of a line of text in mm.
pub fn width(text: &str, size: f64, bold: bool) -> f64 {
    size * text_width(text, bold)
}

/// The text, cut short with an ellipsis where it is wider than `most`.
pub fn fitted(text: &str, size: f64, bold: bool, most: f64) -> String {
    if width(text, size, bold) <= most {
        return text.into();
    }
    let mut kept: String = text.into();
    while kept.pop().is_some() {
        let short = format!("{}…", kept.trim_end());
        if width(&short, size, bold) <= most {
            return short;
        }
    }
    String::new()
}

/// The text in lines no wider than `most`, broken after spaces and hyphens; a piece that is wider
/// alone is cut short.
pub fn wrapped(text: &str, size: f64, most: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for piece in text.split_inclusive([' ', '-']) {
        let fits = |line: &String| width(&format!("{line}{}", piece.trim_end()), size, false) <= most;
        match lines.last_mut().filter(|line| fits(line)) {
            Some(line) => *line += piece,
            None => lines.push(piece.into()),
        }
    }
    lines.iter().map(|line| fitted(line.trim_end(), size, false, most)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_line_is_wider_than_told_and_no_word_is_lost() {
        let text = "96-03-06-09-12-15-18-21-24-27-30-33-36";
        let lines = wrapped(text, 2.5, 20.0);
        assert!(lines.len() > 2 && lines.iter().all(|l| width(l, 2.5, false) <= 20.0));
        assert_eq!(lines.concat(), text);
        assert!(fitted("a very long name of a stone", 3.0, true, 12.0).ends_with('…'));
        assert_eq!(fitted("short", 3.0, true, 30.0), "short");
    }
}
