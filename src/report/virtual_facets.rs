//! The virtual facets of a face-up stone: the drawing that gemmologists make by hand.
//!
//! Seen from above, a stone shows a pattern of polygons: the points whose light has come by one
//! sequence of facets. The footprints of beams are these polygons exactly. Each is followed until no
//! later path can be stronger than the strongest so far, and shaded by where that comes from: the
//! bands of the ASET, in tones that a black-and-white printer keeps apart.

use crate::estimators::beam_view::StrongestPath;
use crate::estimators::view::{AsetBand, band};
use crate::trace::ConvexStone;
use crate::trace::beams::{
    BeamExit, BeamVisitor, Beams, IncidentBeam, ResidualBeam, StopCriteria, UnpolarisedLight,
};
use glam::{DVec2, DVec3};
use std::fmt::Write;

/// Half the drawing's width in its own units, and the space around it.
const HALF: f64 = 400.0;
const MARGIN: f64 = 16.0;

/// Height of a line of the legend.
const LINE: f64 = 30.0;

/// Name, fill and meaning of the tones, in the order of [`AsetBand`]; then of footprints from which no
/// light has left before they became too small to divide.
const TONES: [(&str, &str, &str); 5] = [
    ("green", "#8fbf9a", "strongest light from 0–45° above the horizon"),
    ("red", "#f6d3cb", "strongest light from 45–75°"),
    ("blue", "#27427e", "strongest light from 75–90°, where the viewer's head is"),
    ("below", "url(#h)", "strongest light from below the horizon: leakage"),
    ("dark", "#000", "too finely divided to follow; no light has left yet"),
];

/// A drawing of the virtual facets.
#[derive(Debug, Clone)]
pub struct VirtualFacets {
    /// The SVG document.
    pub svg: String,
    /// Virtual facets drawn.
    pub polygons: usize,
    /// Share of the outline by tone, in the order of [`AsetBand`], then without light; adds up to 1.
    pub shares: [f64; 5],
}

/// Footprints with less than this share of the outline have thinner lines, or the lines would hide
/// the tones.
const FINE: f64 = 1e-4;

/// Polygons of each tone as path data.
struct VirtualFacetVisitor {
    /// Large ones, and fine ones.
    paths: [[String; 5]; 2],
    shares: [f64; 5],
    polygons: usize,
    middle: DVec2,
    scale: f64,
}

impl VirtualFacetVisitor {
    /// Picture coordinates, y downward.
    fn place(&self, p: DVec3) -> DVec2 {
        (p.truncate() - self.middle) * DVec2::new(self.scale, -self.scale)
    }

    fn polygon(path: &mut String, corners: impl Iterator<Item = DVec2>) {
        for (i, p) in corners.enumerate() {
            let _ = write!(path, "{}{:.2} {:.2}", if i == 0 { "M" } else { "L" }, p.x, p.y);
        }
        path.push('Z');
    }
}

impl BeamVisitor<StrongestPath, 1> for VirtualFacetVisitor {
    fn exit(&mut self, _: &BeamExit<StrongestPath, 1>) {}

    fn residual(&mut self, rest: &ResidualBeam<StrongestPath, 1>) {
        let StrongestPath { best, towards, .. } = rest.light;
        let tone = if best > 0.0 { band(towards.z as f32) as usize } else { AsetBand::Below as usize + 1 };
        let fine = usize::from(rest.share < FINE);
        let mut path = std::mem::take(&mut self.paths[fine][tone]);
        let corners = rest.footprint.iter().map(|c| self.place(rest.entry.point(*c)));
        Self::polygon(&mut path, corners);
        self.paths[fine][tone] = path;
        self.shares[tone] += rest.share;
        self.polygons += 1;
    }
}

/// Draws a face-up stone.
///
/// - `index`: of the stone
/// - `stop_power`: a footprint with less power than this share of the light on the outline is not
///   divided further
///
/// The same stone gives the same bytes. Checked in `tests/cli.rs` and below.
pub fn draw(stone: &ConvexStone, index: f64, stop_power: f64) -> VirtualFacets {
    let beams = Beams::new(stone);
    let (lo, hi) = stone.solid.bounds();
    let (lo, hi) = (stone.point_from_design(lo).truncate(), stone.point_from_design(hi).truncate());
    let mut drawing = VirtualFacetVisitor {
        paths: Default::default(),
        shares: [0.0; 5],
        polygons: 0,
        middle: 0.5 * (lo + hi),
        scale: 2.0 * HALF / (hi - lo).max_element(),
    };
    beams.trace(
        &IncidentBeam { direction: DVec3::NEG_Z, indices: [index] },
        StrongestPath::new(UnpolarisedLight(1.0)),
        StopCriteria::at_power(stop_power),
        &mut drawing,
    );
    let mut facets = String::new();
    for facet in (0..beams.facets().count()).filter(|f| beams.facets().planes[*f].normal.z > 1e-9) {
        VirtualFacetVisitor::polygon(
            &mut facets,
            beams.facets().ring(facet).iter().map(|p| drawing.place(*p)),
        );
    }
    VirtualFacets { svg: drawing.svg(&facets), polygons: drawing.polygons, shares: drawing.shares }
}

impl VirtualFacetVisitor {
    fn svg(&self, facets: &str) -> String {
        let shown: Vec<usize> = (0..TONES.len()).filter(|t| self.shares[*t] > 5e-4).collect();
        let (left, width) = (-HALF - MARGIN, 2.0 * (HALF + MARGIN));
        let height = width + LINE * shown.len() as f64;
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{left} {left} {width} {height}\">\n\
             <title>Virtual facets, face-up, by the strongest light of each point</title>\n\
             <pattern id=\"h\" width=\"5\" height=\"5\" patternUnits=\"userSpaceOnUse\" \
             patternTransform=\"rotate(45)\"><rect width=\"5\" height=\"5\" fill=\"#fff\"/>\
             <rect width=\"1\" height=\"5\" fill=\"#777\"/></pattern>\n\
             <rect x=\"{left}\" y=\"{left}\" width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n\
             <g stroke=\"#333\" stroke-linejoin=\"round\">\n"
        );
        for (size, paths, line) in [("large", &self.paths[0], 0.35), ("fine", &self.paths[1], 0.06)] {
            for ((name, fill, _), path) in TONES.iter().zip(paths).filter(|(_, path)| !path.is_empty()) {
                let _ = writeln!(
                    svg,
                    "<path id=\"{name}-{size}\" fill=\"{fill}\" stroke-width=\"{line}\" d=\"{path}\"/>"
                );
            }
        }
        let _ = writeln!(
            svg,
            "<path id=\"facets\" fill=\"none\" stroke=\"#000\" stroke-width=\"1.6\" d=\"{facets}\"/>\n</g>\n\
             <g font-family=\"sans-serif\" font-size=\"17\">"
        );
        for (line, tone) in shown.into_iter().enumerate() {
            let (_, fill, meaning) = TONES[tone];
            let y = HALF + MARGIN + LINE * line as f64;
            let _ = writeln!(
                svg,
                "<rect x=\"{}\" y=\"{y}\" width=\"34\" height=\"20\" fill=\"{fill}\" stroke=\"#333\"/>\
                 <text x=\"{}\" y=\"{}\">{:.1} % of the outline: {meaning}</text>",
                -HALF,
                46.0 - HALF,
                y + 16.0,
                100.0 * self.shares[tone],
            );
        }
        svg + "</g>\n</svg>\n"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::families;
    use std::collections::BTreeMap;

    #[test]
    fn the_polygons_cover_the_outline() {
        let design = families::build("round-brilliant", &BTreeMap::new()).expect("builds");
        let pattern = draw(&ConvexStone::new(design.solid().expect("closed")), 2.417, 1e-5);
        assert!((pattern.shares.iter().sum::<f64>() - 1.0).abs() < 1e-9, "{:?}", pattern.shares);
        assert!(pattern.polygons > 100 && pattern.svg.ends_with("</svg>\n"));
    }
}
