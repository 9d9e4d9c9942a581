//! What stands above and below the drawings: title, the design file's own lines, the figures.

use super::rows::{self, DiagramRow};
use super::sheet::{Sheet, fitted, wrapped};
use crate::design::proportions::Proportions;
use crate::design::{Design, LengthUnit};
use crate::report::svg_canvas::Anchor;
use glam::DVec2;

/// Font sizes in mm.
const TITLE: f64 = 5.2;
const LINE: f64 = 2.7;
const SMALL: f64 = 2.3;

/// Distance of lines, in units of the font size.
const LEAD: f64 = 1.35;

/// Part of the width that a bold line is wrapped to, as regular letters are narrower by about that.
const BOLD: f64 = 0.9;

/// Most lines of the file's own words above the drawings, and below the table.
const MOST: usize = 6;

/// Lines that have been set.
pub struct TextLines {
    lines: Vec<(f64, bool, String)>,
}

impl TextLines {
    /// Their height in mm.
    pub fn height(&self) -> f64 {
        self.lines.iter().map(|(size, ..)| size * LEAD).sum()
    }

    /// Draws them with their upper left corner at `corner`.
    pub fn draw(&self, pen: &mut Sheet, corner: DVec2) {
        let mut y = corner.y;
        for (size, bold, text) in &self.lines {
            y += size * LEAD;
            pen.text(DVec2::new(corner.x, y - 0.3 * size), *size, Anchor::Start, *bold, text);
        }
    }
}

/// The file's own words in at most [`MOST`] lines.
fn wrapped_lines<'a>(texts: impl Iterator<Item = &'a str>, size: f64, wide: f64) -> Vec<(f64, bool, String)> {
    let texts = texts.map(str::trim).filter(|t| !t.is_empty());
    let mut lines: Vec<String> = texts.flat_map(|t| wrapped(t, size, wide)).collect();
    if lines.len() > MOST {
        lines.truncate(MOST);
        if let Some(last) = lines.last_mut() {
            *last = fitted(&format!("{last} …"), size, false, wide);
        }
    }
    lines.into_iter().map(|line| (size, false, line)).collect()
}

/// Title, header lines and figures.
///
/// - `index`: the index of refraction that the angles are for, if it is known
pub fn above(design: &Design, p: &Proportions, index: Option<f64>, wide: f64) -> TextLines {
    let title = if design.name.trim().is_empty() { "Untitled design" } else { design.name.trim() };
    let mut lines = vec![(TITLE, true, fitted(title, TITLE, true, wide))];
    let headers = design.headers.iter().map(String::as_str).filter(|h| h.trim() != title);
    lines.extend(wrapped_lines(headers, LINE, wide));
    for facts in [make(design, p, index), ratios(design, p)] {
        lines.extend(
            wrapped(&facts.join(" · "), LINE, BOLD * wide).into_iter().map(|line| (LINE, true, line)),
        );
    }
    TextLines { lines }
}

/// Footnotes, source, and who drew it.
pub fn below(design: &Design, rows: &[DiagramRow], wide: f64) -> TextLines {
    let source = if design.source.is_empty() { String::new() } else { format!("Source: {}", design.source) };
    let mesh = if rows::is_measured(design) {
        "Angles and indices are measured on the planes of a mesh. "
    } else {
        ""
    };
    let cheater = rows.iter().any(|r| r.cheater);
    let between = if cheater { "Cheater: some indices lie between teeth. " } else { "" };
    let drawn = format!("{mesh}{between}Drawn by cutlab {}", env!("CARGO_PKG_VERSION"));
    let own = design.footers.iter().map(String::as_str).chain([source.as_str()]);
    let mut lines = wrapped_lines(own, SMALL, wide);
    lines.push((SMALL, false, drawn));
    TextLines { lines }
}

/// `57 + 16 girdle facets = 73`, symmetry, wheel, index of refraction.
fn make(design: &Design, p: &Proportions, index: Option<f64>) -> Vec<String> {
    let girdle = p.by_zone.iter().find(|(zone, _)| *zone == "girdle").map_or(0, |(_, n)| *n);
    let facets = match girdle {
        0 => format!("{} facets, none on the girdle", p.facets),
        _ => format!("{} facets + {girdle} on the girdle = {}", p.facets - girdle, p.facets),
    };
    let turns =
        if p.symmetry.order > 1 { format!("{}-fold", p.symmetry.order) } else { "no repetition".into() };
    let symmetry = match (p.symmetry.order, p.symmetry.mirror) {
        (1, true) => "mirror-image symmetry".into(),
        (1, false) => "no symmetry".into(),
        (_, mirror) => format!("{turns}{} symmetry", if mirror { ", mirror-image" } else { "" }),
    };
    let teeth = format!("{}-index gear", design.gear.teeth.abs());
    let mut facts = vec![facets, symmetry, teeth];
    facts.extend(index.map(|n| format!("angles for n = {n:.3}")));
    facts
}

/// The faceter's ratios, and the width of a stone of definite size.
fn ratios(design: &Design, p: &Proportions) -> Vec<String> {
    let r = &p.ratios;
    let mut facts = vec![format!("L/W = {:.3}", r.l_w)];
    facts.extend(r.t_w.map(|t| format!("T/W = {t:.3}")));
    facts.push(format!("P/W = {:.3}", r.p_w));
    facts.push(format!("C/W = {:.3}", r.c_w));
    facts.push(format!("H/W = {:.3}", r.h_w));
    facts.push(format!("Vol/W³ = {:.3}", r.vol_w3));
    if design.unit == LengthUnit::Millimetre {
        // a faceter who asked for a size finds that one, not only the one across the corners
        let (w, flats) = (format!("W = {:.2} mm", r.w), format!("{:.2} mm", p.width));
        let differ = r.w > 1.005 * p.width;
        facts.push(if differ { format!("{w} (flat to flat {flats})") } else { w });
    }
    facts
}
