//! SVG canvas of the diagram: lines and text on a page in millimetres, black on white.

use crate::report::page::escaped;
use crate::report::raster::{FONTS, text_width};
use glam::DVec2;
use std::fmt::Write;

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

/// Which point of a text is at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// Its start.
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
}

/// The page as far as it is drawn.
#[derive(Debug)]
pub struct SvgCanvas {
    svg: String,
}

impl SvgCanvas {
    /// An empty page.
    pub fn new(title: &str, paper: Paper) -> SvgCanvas {
        let DVec2 { x: w, y: h } = paper.size_mm();
        SvgCanvas {
            svg: format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}mm\" height=\"{h}mm\" viewBox=\"0 0 {w} {h}\" \
                 font-family=\"{FONTS}\" fill=\"#000\">\n<title>{}</title>\n\
                 <rect width=\"{w}\" height=\"{h}\" fill=\"#fff\"/>\n",
                escaped(title)
            ),
        }
    }

    /// A line of text; `at` is on its base line.
    pub fn text(&mut self, at: DVec2, size: f64, anchor: Anchor, bold: bool, text: &str) {
        if text.is_empty() {
            return;
        }
        let anchor = match anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let weight = if bold { " font-weight=\"bold\"" } else { "" };
        let _ = writeln!(
            self.svg,
            "<text x=\"{:.2}\" y=\"{:.2}\" font-size=\"{size:.2}\"{anchor}{weight}>{}</text>",
            at.x,
            at.y,
            escaped(text)
        );
    }

    /// A name with its middle at `at`, its line along `along`.
    pub fn name(&mut self, at: DVec2, size: f64, along: DVec2, name: &str) {
        if along.y.abs() < 1e-9 {
            return self.text(at + DVec2::new(0.0, 0.5 * CAPITAL * size), size, Anchor::Middle, false, name);
        }
        let _ = writeln!(
            self.svg,
            "<text transform=\"translate({:.2} {:.2}) rotate({:.1})\" y=\"{:.2}\" font-size=\"{size:.2}\" \
             text-anchor=\"middle\">{}</text>",
            at.x,
            at.y,
            along.to_angle().to_degrees(),
            0.5 * CAPITAL * size,
            escaped(name)
        );
    }

    /// Begins a group of that name, to be closed by [`SvgCanvas::end`].
    pub fn group(&mut self, id: &str) {
        let _ = writeln!(self.svg, "<g id=\"{id}\">");
    }

    /// Ends a group.
    pub fn end(&mut self) {
        self.svg += "</g>\n";
    }

    /// Path data as lines.
    pub fn lines(&mut self, data: &str, width: f64) {
        self.path("", data, width);
    }

    /// Path data as lines, under a name.
    pub fn named_lines(&mut self, id: &str, data: &str, width: f64) {
        self.path(&format!(" id=\"{id}\""), data, width);
    }

    fn path(&mut self, id: &str, data: &str, width: f64) {
        if !data.is_empty() {
            let _ = writeln!(
                self.svg,
                "<path{id} d=\"{data}\" fill=\"none\" stroke=\"#000\" stroke-width=\"{width}\" \
                 stroke-linejoin=\"round\"/>"
            );
        }
    }

    /// A rule across.
    pub fn rule(&mut self, from: DVec2, width: f64) {
        self.lines(&format!("M{:.2} {:.2}h{width:.2}", from.x, from.y), HAIR);
    }

    /// The finished document.
    pub fn finish(self) -> String {
        self.svg + "</svg>\n"
    }
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
