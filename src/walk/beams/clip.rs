//! Clipping a convex footprint by the ring of a facet, and finding the facet to begin with.

use super::facets::{Facets, NONE};
use super::frame::Frame;
use glam::DVec2;

/// A corner whose distance from an edge's line, times the edge's length, is below this lies on it
/// (walking units squared). Ten times the rounding of the projection; without it, stones that are
/// symmetrical to the light leave slivers of area 1e-17 along every edge.
const ON_LINE: f64 = 1e-14;

/// A corner of a footprint and the facet edge that its next side lies on (`NONE` for a side that
/// the footprint had before).
#[derive(Debug, Clone, Copy)]
pub struct Corner {
    /// Where, in the plane of the entry facet.
    pub at: DVec2,
    side: u32,
}

/// Buffers of the clipper, kept from beam to beam.
#[derive(Debug, Default)]
pub struct Clipper {
    ring: Vec<Corner>,
    next: Vec<Corner>,
    heights: Vec<f64>,
    /// Middle and half sides of a box around the footprint that was taken up.
    middle: DVec2,
    half: DVec2,
}

impl Clipper {
    /// Takes a footprint up.
    pub fn load(&mut self, polygon: &[DVec2]) {
        let (mut lo, mut hi) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        self.ring.clear();
        for at in polygon {
            (lo, hi) = (lo.min(*at), hi.max(*at));
            self.ring.push(Corner { at: *at, side: NONE });
        }
        (self.middle, self.half) = (0.5 * (lo + hi), 0.5 * (hi - lo));
    }

    /// Cuts away what of the footprint lies outside `facet` seen along `frame`.
    ///
    /// - `turn`: 1 if the frame shows facets counter-clockwise, −1 after an odd number of mirrors
    ///
    /// False if nothing is left.
    #[inline(never)] // for the profile: it costs nothing
    pub fn clip(&mut self, facets: &Facets, facet: usize, frame: &Frame, turn: f64) -> bool {
        let ring = facets.ring(facet);
        let Some(last) = ring.last() else { return false };
        let mut from = frame.project(*last);
        for (i, corner) in ring.iter().enumerate() {
            let to = frame.project(*corner);
            // the edge that ends in corner i starts in the one before
            let edge = if i == 0 { ring.len() - 1 } else { i - 1 };
            let along = (to - from) * turn;
            // most edges pass the box around the footprint by: five operations instead of five a corner
            let height = along.perp_dot(self.middle - from);
            let reach = along.x.abs() * self.half.y + along.y.abs() * self.half.x;
            if height < reach && (height < -reach || !self.cut(from, along, edge as u32)) {
                return false;
            }
            from = to;
        }
        true
    }

    /// Cuts by the line through `from` along `along`, whose left is inside.
    #[inline(never)] // for the profile: it costs nothing
    fn cut(&mut self, from: DVec2, along: DVec2, edge: u32) -> bool {
        self.heights.clear();
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        for corner in &self.ring {
            let h = along.perp_dot(corner.at - from);
            least = least.min(h);
            most = most.max(h);
            self.heights.push(h);
        }
        if least >= -ON_LINE {
            return true;
        }
        if most <= ON_LINE {
            return false;
        }
        self.next.clear();
        let n = self.ring.len();
        for i in 0..n {
            let j = if i + 1 == n { 0 } else { i + 1 };
            let (a, b, ha, hb) = (self.ring[i], self.ring[j], self.heights[i], self.heights[j]);
            let crossing = || a.at + (b.at - a.at) * (ha / (ha - hb));
            if ha > ON_LINE {
                self.next.push(a);
                if hb < -ON_LINE {
                    self.next.push(Corner { at: crossing(), side: edge });
                }
            } else if ha >= -ON_LINE {
                // on the line: the next side is the cut if it leads outside
                self.next.push(Corner { at: a.at, side: if hb < -ON_LINE { edge } else { a.side } });
            } else if hb > ON_LINE {
                self.next.push(Corner { at: crossing(), side: a.side });
            }
        }
        std::mem::swap(&mut self.ring, &mut self.next);
        self.ring.len() > 2
    }

    /// Area of the footprint, in the plane of the entry facet.
    #[inline]
    pub fn area(&self) -> f64 {
        let [first, rest @ ..] = &self.ring[..] else { return 0.0 };
        let mut twice = 0.0;
        for pair in rest.windows(2) {
            twice += (pair[0].at - first.at).perp_dot(pair[1].at - first.at);
        }
        0.5 * twice
    }

    /// The footprint's corners, counter-clockwise.
    pub fn corners(&self) -> &[Corner] {
        &self.ring
    }

    /// Numbers of the facet edges across which the footprint went on before it was cut.
    #[inline]
    pub fn cut_edges(&self) -> impl Iterator<Item = usize> + '_ {
        self.ring.iter().filter(|c| c.side != NONE).map(|c| c.side as usize)
    }
}

/// The facet that the ray `at` of a beam meets next: from facet `start`, which must face along the
/// beam, across an edge that has the ray on its outer side, until there is none.
///
/// The facets that face along the beam tile the outline of the stone, and this walk over them
/// cannot go in a circle, because they are the lower envelope of planes (H. Edelsbrunner,
/// *Combinatorica* 10 (1990) 251). `None` if rounding led astray.
#[inline(never)] // for the profile: it costs nothing
pub fn locate(facets: &Facets, start: usize, frame: &Frame, turn: f64, at: DVec2) -> Option<usize> {
    let mut facet = start;
    let mut came_from = NONE;
    for _ in 0..facets.count() {
        let (ring, beyond) = (facets.ring(facet), facets.beyond(facet));
        let mut from = frame.project(*ring.last()?);
        let mut before = ring.len() - 1;
        let mut next = NONE;
        for (i, corner) in ring.iter().enumerate() {
            let to = frame.project(*corner);
            let outside = ((to - from) * turn).perp_dot(at - from) < 0.0;
            if outside && beyond[before] != came_from {
                next = beyond[before];
                break;
            }
            (from, before) = (to, i);
        }
        if next == NONE {
            return Some(facet);
        }
        came_from = facet as u32;
        facet = next as usize;
    }
    None
}
