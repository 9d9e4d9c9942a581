//! What stays where it is as far as the meets allow: girdle, table, and of every facet one corner.

use super::corners::Corner;
use super::parts::{FacetOfPart, Part};
use crate::design::tiers::Zone;
use glam::DVec3;

/// Corners by which the solver holds what nobody asked to change; numbers in the network's corners.
#[derive(Debug, Clone)]
pub(super) struct Holds {
    /// Highest corner of the girdle on the crown's side, lowest on the pavilion's.
    pub girdle: Option<[usize; 2]>,
    /// Of a stone without girdle facets the corner farthest from the axis: it stays.
    pub outline: Option<usize>,
    /// The corner of the table, and of the culet, farthest from the axis.
    pub table: Option<usize>,
    pub culet: Option<usize>,
    /// Of each part a facet and the place on it that is nearest the girdle.
    pub hinges: Vec<(usize, DVec3)>,
}

impl Holds {
    pub fn new(parts: &[Part], facets: &[FacetOfPart], corners: &[Corner]) -> Holds {
        let zone = |facet: &usize| parts[facets[*facet].part].zone;
        let touches = |corner: &Corner, of: Zone| corner.facets.iter().any(|f| zone(f) == of);
        let numbered = || corners.iter().enumerate();
        let radius = |c: &Corner| c.position.truncate().length();
        let height = |c: &Corner| c.position.z;
        // ties go to the first, whatever the rounding
        let most = |of: &dyn Fn(&Corner) -> Option<f64>| {
            let mut best: Option<(usize, f64)> = None;
            for (i, corner) in numbered() {
                let Some(value) = of(corner) else { continue };
                if best.is_none_or(|(_, b)| value > b + 1e-9 * b.abs().max(1e-9)) {
                    best = Some((i, value));
                }
            }
            best.map(|(i, _)| i)
        };
        let on_girdle = |c: &Corner, side: Zone| touches(c, Zone::Girdle) && touches(c, side);
        let top = most(&|c| on_girdle(c, Zone::Crown).then(|| height(c)));
        let bottom = most(&|c| on_girdle(c, Zone::Pavilion).then(|| -height(c)));
        let girdle = top.zip(bottom).map(|(top, bottom)| [top, bottom]);
        let outline = if girdle.is_none() { most(&|c| Some(radius(c))) } else { None };
        let middle = match (girdle, outline) {
            (Some([top, bottom]), _) => 0.5 * (height(&corners[top]) + height(&corners[bottom])),
            (None, Some(outline)) => height(&corners[outline]),
            (None, None) => 0.0,
        };
        let hinge = |part: &Part| {
            let facet = part.facets.iter().copied().find(|f| corners.iter().any(|c| c.facets.contains(f)));
            let facet = facet.unwrap_or(part.facets[0]);
            let own = corners.iter().filter(|c| c.facets.contains(&facet)).map(|c| c.position);
            let from_middle = |p: &DVec3| (p.z - middle).abs();
            let nearest = own.reduce(|a, b| if from_middle(&b) < from_middle(&a) - 1e-9 { b } else { a });
            (facet, nearest.unwrap_or(DVec3::ZERO))
        };
        Holds {
            girdle,
            outline,
            table: most(&|c| touches(c, Zone::Table).then(|| radius(c))),
            culet: most(&|c| touches(c, Zone::Culet).then(|| radius(c))),
            hinges: parts.iter().map(hinge).collect(),
        }
    }
}
