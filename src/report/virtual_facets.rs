//! The virtual facets of a face-up stone: the drawing that gemmologists make by hand.
//!
//! Seen from above, a stone shows a pattern of polygons: the points whose light has come by one
//! sequence of facets. The footprints of beams are these polygons exactly. Each is followed until no
//! later path can be stronger than the strongest so far, and shaded by where that comes from: the
//! bands of the ASET, in tones that a black-and-white printer keeps apart.

use crate::estimators::beam_view::StrongestPath;
use crate::estimators::strongest_path::StrongestExit;
use crate::estimators::view::{AsetBand, band};
use crate::report::svg_canvas::{Element, PathData};
use crate::trace::ConvexStone;
use crate::trace::beams::{
    BeamExit, BeamVisitor, Beams, IncidentBeam, ResidualBeam, StopCriteria, UnpolarisedLight,
};
use glam::{DVec2, DVec3};

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

/// Decimals of corners.
const DECIMALS: usize = 2;

/// Polygons of each tone as path data.
struct VirtualFacetVisitor {
    /// Large ones, and fine ones.
    paths: [[PathData; 5]; 2],
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
}

impl BeamVisitor<StrongestPath, 1> for VirtualFacetVisitor {
    fn exit(&mut self, _: &BeamExit<StrongestPath, 1>) {}

    fn residual(&mut self, rest: &ResidualBeam<StrongestPath, 1>) {
        let StrongestExit { power, towards, .. } = rest.light.strongest;
        let tone = if power > 0.0 { band(towards.z as f32) as usize } else { AsetBand::Below as usize + 1 };
        let fine = usize::from(rest.share < FINE);
        let path = std::mem::take(&mut self.paths[fine][tone]);
        let corners = rest.footprint.iter().map(|c| self.place(rest.entry.point(*c)));
        self.paths[fine][tone] = path.polygon(corners);
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
/// The same stone gives the same bytes. Checked in `tests/program/cli.rs` and below.
pub fn draw(stone: &ConvexStone, index: f64, stop_power: f64) -> VirtualFacets {
    let beams = Beams::new(stone);
    let (lo, hi) = stone.solid.bounds();
    let (lo, hi) = (stone.point_from_design(lo).truncate(), stone.point_from_design(hi).truncate());
    let mut drawing = VirtualFacetVisitor {
        paths: std::array::from_fn(|_| std::array::from_fn(|_| PathData::new(DECIMALS))),
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
    let upper = (0..beams.facets().count()).filter(|f| beams.facets().planes[*f].normal.z > 1e-9);
    let facets = upper.fold(PathData::new(DECIMALS), |path, facet| {
        path.polygon(beams.facets().ring(facet).iter().map(|p| drawing.place(*p)))
    });
    let (polygons, shares) = (drawing.polygons, drawing.shares);
    VirtualFacets { svg: drawing.drawing(facets).document(), polygons, shares }
}

impl VirtualFacetVisitor {
    /// The drawing, with the legend below it.
    ///
    /// - `facets`: edges of the facets
    fn drawing(self, facets: PathData) -> Element {
        const TITLE: &str = "Virtual facets, face-up, by the strongest light of each point";
        const LINES: &str = "#333";
        let shown: Vec<usize> = (0..TONES.len()).filter(|t| self.shares[*t] > 5e-4).collect();
        let (corner, width) = (DVec2::splat(-HALF - MARGIN), 2.0 * (HALF + MARGIN));
        let size = DVec2::new(width, width + LINE * shown.len() as f64);
        let mut polygons = Element::group().attribute("stroke", LINES).round_joins();
        for ((size, line), paths) in [("large", 0.35), ("fine", 0.06)].into_iter().zip(self.paths) {
            for ((name, fill, _), path) in TONES.iter().zip(paths).filter(|(_, path)| !path.is_empty()) {
                let path = Element::path(path).id(&format!("{name}-{size}"));
                polygons.push(path.fill(*fill).number("stroke-width", line));
            }
        }
        polygons.push(Element::path(facets).id("facets").fill("none").stroke("#000", 1.6));
        let mut legend = Element::group().attribute("font-family", "sans-serif").font_size(17.0);
        for (line, tone) in shown.into_iter().enumerate() {
            let (_, fill, meaning) = TONES[tone];
            let y = HALF + MARGIN + LINE * line as f64;
            legend.push(Element::rect((-HALF, y), (34.0, 20.0)).fill(fill).stroke(LINES, 1.0));
            let said = format!("{:.1} % of the outline: {meaning}", 100.0 * self.shares[tone]);
            legend.push(Element::text((46.0 - HALF, y + 16.0), &said));
        }
        let hatching = Element::new("pattern")
            .id("h")
            .length("width", 5.0)
            .length("height", 5.0)
            .attribute("patternUnits", "userSpaceOnUse")
            .attribute("patternTransform", "rotate(45)")
            .with(Element::rect((0.0, 0.0), (5.0, 5.0)).fill("#fff"))
            .with(Element::rect((0.0, 0.0), (1.0, 5.0)).fill("#777"));
        Element::drawing(corner, size)
            .with(Element::title(TITLE))
            .with(hatching)
            .with(Element::rect(corner, size).fill("#fff"))
            .with(polygons)
            .with(legend)
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
