//! What an optimised stone must keep, whatever else is asked for: facets wide enough to be cut, a girdle.

use crate::design::tiers::Zone;
use crate::geometry::Polyhedron;
use crate::geometry::measure::calipers;
use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

/// Bounds that are always on. A stone that starts beyond one may stay where it is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[non_exhaustive]
pub struct Guards {
    /// No facet is narrower than this, in percent of the girdle width.
    pub least_facet_percent: f64,
    /// The girdle is at its thinnest and thickest places at least this part of what it was.
    pub least_girdle: f64,
}

impl Default for Guards {
    /// Half a percent of the width; half the girdle.
    fn default() -> Guards {
        Guards { least_facet_percent: 0.5, least_girdle: 0.5 }
    }
}

impl Guards {
    /// - `least_facet_percent`: of the girdle width; `least_girdle`: a part of what the girdle is
    pub fn new(least_facet_percent: f64, least_girdle: f64) -> Guards {
        Guards { least_facet_percent, least_girdle }
    }
}

/// The bounds of one stone: what it has of each at the start.
#[derive(Debug, Clone)]
pub struct GuardedStone {
    guards: Guards,
    /// Of each plane of the design the width of its facet, in percent of the stone's; infinite for one that
    /// bounds nothing.
    widths: Vec<f64>,
    girdle: Option<(f64, f64)>,
}

impl GuardedStone {
    /// The bounds of a stone as it is.
    pub fn new(guards: Guards, start: &Polyhedron) -> GuardedStone {
        GuardedStone { guards, widths: facet_widths(start), girdle: girdle(start) }
    }

    /// By how much a stone of the same facets breaks the bounds, in shares of them, all together; 0 if it
    /// breaks none.
    pub fn violation(&self, stone: &Polyhedron) -> f64 {
        let mut violation = 0.0;
        let least = self.guards.least_facet_percent;
        for (was, is) in self.widths.iter().zip(facet_widths(stone)) {
            let least = least.min(*was);
            if is < least * (1.0 - 1e-9) {
                violation += (least - is) / least;
            }
        }
        if let (Some(was), Some(is)) = (self.girdle, girdle(stone)) {
            for (was, is) in [(was.0, is.0), (was.1, is.1)] {
                let least = self.guards.least_girdle * was;
                if is < least * (1.0 - 1e-9) {
                    violation += (least - is) / least;
                }
            }
        }
        violation
    }
}

/// Of each plane the least width of its facet, in percent of the stone's.
fn facet_widths(stone: &Polyhedron) -> Vec<f64> {
    let width = stone.width();
    let mut widths = vec![f64::INFINITY; stone.plane_status.len()];
    for (i, face) in stone.faces.iter().enumerate() {
        let normal = stone.area_vector(i).normalize_or_zero();
        let across = normal.any_orthonormal_vector();
        let along = normal.cross(across);
        let flat: Vec<DVec2> = stone.polygon(i).map(|p| DVec2::new(p.dot(across), p.dot(along))).collect();
        widths[face.plane] = 100.0 * calipers(&flat).0 / width;
    }
    widths
}

/// Least and greatest height of a girdle facet, over the width; none without girdle facets.
fn girdle(stone: &Polyhedron) -> Option<(f64, f64)> {
    let is_girdle = |i: &usize| Zone::from_normal(stone.area_vector(*i).normalize_or_zero()) == Zone::Girdle;
    let faces: Vec<usize> = (0..stone.faces.len()).filter(is_girdle).collect();
    let near = 1e-6 * stone.width();
    let columns = faces.iter().flat_map(|&i| {
        // heights above the corners of one facet that stand above each other
        let corners: Vec<DVec3> = stone.polygon(i).collect();
        let above = move |a: &DVec3| {
            let column = corners.iter().filter(|b| b.truncate().distance(a.truncate()) < near).map(|b| b.z);
            column.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| (low.min(z), high.max(z)))
        };
        let corners: Vec<DVec3> = stone.polygon(i).collect();
        corners.into_iter().map(move |c| above(&c)).map(|(low, high)| high - low)
    });
    columns.fold(None, |range: Option<(f64, f64)>, h| {
        Some(range.map_or((h, h), |(least, most)| (least.min(h), most.max(h))))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::edit::EditRequest;
    use crate::design::{Design, library};
    use std::collections::BTreeMap;

    fn changed(settings: &[&str]) -> Polyhedron {
        let design: Design = library::design("classic", &BTreeMap::new()).expect("a cut").expect("solved");
        EditRequest::new(settings).expect("settings").run(&design).expect("a stone").solid
    }

    #[test]
    fn a_thin_girdle_breaks_the_bound_by_its_share() {
        let start = changed(&[]);
        let bounds = GuardedStone::new(Guards::default(), &start);
        assert_eq!(bounds.violation(&start), 0.0);
        let percent = |s: &Polyhedron| {
            girdle(s).map(|(least, most)| (100.0 * least / s.width(), 100.0 * most / s.width()))
        };
        let was = percent(&start).expect("a girdle").1;
        assert_eq!(bounds.violation(&changed(&[&format!("girdle={}", 0.8 * was)])), 0.0);
        assert!(bounds.violation(&changed(&[&format!("girdle={}", 0.4 * was)])) > 0.1);
    }

    #[test]
    fn a_narrow_facet_breaks_the_bound() {
        let start = changed(&[]);
        let widest = Guards { least_facet_percent: 8.0, least_girdle: 0.0 };
        // facets that are narrower already may stay so, and not become narrower
        assert_eq!(GuardedStone::new(widest, &start).violation(&start), 0.0);
        assert!(GuardedStone::new(widest, &start).violation(&changed(&["girdle-=0.3"])) > 0.0);
    }
}
