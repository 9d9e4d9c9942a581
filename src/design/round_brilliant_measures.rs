//! Measures of round brilliants alone: star and lower-half lengths, and the grading
//! envelope that its proportions lie in.

use super::tiers::Zone;
use crate::geometry::Polyhedron;
use glam::{DVec2, DVec3};
use serde::Serialize;

/// Lengths of the facets between mains, in percent, means over the eight of each.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FacetLengths {
    /// Star length: from table edge to girdle in plan.
    pub star_percent: f64,
    /// Lower half length: from girdle to the middle in plan.
    pub lower_half_percent: f64,
}

/// Facets of crown and pavilion of a round brilliant: 8 + 8 + 16 and 8 + 16.
const CROWN: usize = 32;
const PAVILION: usize = 24;
const MAINS: usize = 8;

/// The lengths of a round brilliant, whatever its girdle and pose about the axis; none for other
/// cuts.
///
/// - `zones`: of the solid's faces
///
/// Plan distances are taken along the ray from the axis through the facet's inner tip. Checked in
/// `tests/library/cuts.rs` against the parameters that stones were made from.
pub fn lengths(solid: &Polyhedron, zones: &[Zone]) -> Option<FacetLengths> {
    let of = |zone| (0..zones.len()).filter(|&f| zones[f] == zone).collect::<Vec<_>>();
    let (table, crown, mut pavilion) = (of(Zone::Table), of(Zone::Crown), of(Zone::Pavilion));
    let &[table] = table.as_slice() else { return None };
    if crown.len() != CROWN || pavilion.len() != PAVILION || solid.faces[table].corners.len() != MAINS {
        return None;
    }
    let outline = solid.outline();
    let rim = &solid.faces[table].corners;
    let axis = rim.iter().map(|&c| solid.vertices[c].truncate()).sum::<DVec2>() / MAINS as f64;
    let plan = |v: DVec3| v.truncate() - axis;
    // a star is a triangle with two corners on the table; its third points to the girdle
    let mut stars = Vec::new();
    for &f in &crown {
        let corners = &solid.faces[f].corners;
        let (on, off): (Vec<usize>, Vec<usize>) = corners.iter().partition(|c| rim.contains(c));
        if let ([a, b], [tip]) = (on.as_slice(), off.as_slice()) {
            let edge = (plan(solid.vertices[*a]) + plan(solid.vertices[*b])) / 2.0;
            let tip = plan(solid.vertices[*tip]);
            let girdle = outline_extent(&outline, axis, tip)?;
            stars.push((tip.length() - edge.length()) / (girdle - edge.length()));
        }
    }
    // the mains reach lowest, the halves end above them
    let low = |f: &usize| solid.polygon(*f).map(|v| v.z).fold(f64::INFINITY, f64::min);
    pavilion.sort_by(|a, b| low(a).total_cmp(&low(b)));
    let halves: Option<Vec<f64>> = pavilion[MAINS..]
        .iter()
        .map(|&f| {
            let tip = solid.polygon(f).map(plan).min_by(|a, b| a.length().total_cmp(&b.length()))?;
            Some(1.0 - tip.length() / outline_extent(&outline, axis, tip)?)
        })
        .collect();
    let mean = |values: &[f64]| 100.0 * values.iter().sum::<f64>() / values.len() as f64;
    (stars.len() == MAINS).then_some(())?;
    Some(FacetLengths { star_percent: mean(&stars), lower_half_percent: mean(&halves?) })
}

/// How far the outline reaches from `axis` toward `toward`.
fn outline_extent(outline: &[DVec2], axis: DVec2, toward: DVec2) -> Option<f64> {
    let toward = toward.try_normalize()?;
    (0..outline.len())
        .filter_map(|i| {
            let (a, b) = (outline[i] - axis, outline[(i + 1) % outline.len()] - axis);
            let outward = -(b - a).perp();
            let across = outward.dot(toward);
            (across > 0.0).then(|| outward.dot(a) / across)
        })
        .reduce(f64::min)
}
