//! Clipping a convex footprint by the ring of a facet.

// loops over lanes in lockstep: with an index they vectorise
#![allow(clippy::needless_range_loop)]

use super::beam_coords::BeamCoords;
use super::facets::{EDGES_PER_GROUP, EdgeGroup, NO_NEIGHBOUR, WeldedFacets};
use glam::DVec2;

/// A facet faces along a beam if the cosine is above this; one that is seen edge-on has no area.
pub const MIN_FACING_COS: f64 = 1e-13;

/// A corner whose distance from an edge's line, times the edge's length, is below this lies on it
/// (trace units squared). Ten times the rounding of the projection; without it, stones that are
/// symmetrical to the light leave slivers of area 1e-17 along every edge.
const ON_LINE: f64 = 1e-14;

/// The lines of a few edges in the coordinates of a beam: `slope · (u, v) + height` is positive on
/// the facet's side, in units of the edge's length.
struct EdgeLines {
    slope: [[f64; EDGES_PER_GROUP]; 2],
    slack: [f64; EDGES_PER_GROUP],
}

impl EdgeLines {
    /// Edges seen along `frame`.
    ///
    /// - `orientation_sign`: 1 if the frame shows facets counter-clockwise, −1 after an odd number of mirrors
    #[inline(always)]
    fn new(edges: &EdgeGroup, frame: &BeamCoords, orientation_sign: f64) -> EdgeLines {
        let BeamCoords { across: a, along: b, offset, .. } = frame;
        let EdgeGroup { from: [x, y, z], along: [ex, ey, ez] } = edges;
        let mut lines = EdgeLines { slope: [[0.0; EDGES_PER_GROUP]; 2], slack: [0.0; EDGES_PER_GROUP] };
        for i in 0..EDGES_PER_GROUP {
            let from_u = a.x * x[i] + a.y * y[i] + a.z * z[i] - offset.x;
            let from_v = b.x * x[i] + b.y * y[i] + b.z * z[i] - offset.y;
            let along_u = (a.x * ex[i] + a.y * ey[i] + a.z * ez[i]) * orientation_sign;
            let along_v = (b.x * ex[i] + b.y * ey[i] + b.z * ez[i]) * orientation_sign;
            lines.slope[0][i] = -along_v;
            lines.slope[1][i] = along_u;
            lines.slack[i] = along_v * from_u - along_u * from_v;
        }
        lines
    }

    #[inline(always)]
    fn height(&self, i: usize, at: DVec2) -> f64 {
        self.slope[0][i] * at.x + self.slope[1][i] * at.y + self.slack[i]
    }

    /// The least height of any corner, edge by edge.
    #[inline(always)]
    fn min_slack(&self, corners: &[DVec2]) -> [f64; EDGES_PER_GROUP] {
        let mut least = [f64::INFINITY; EDGES_PER_GROUP];
        for at in corners {
            for i in 0..EDGES_PER_GROUP {
                let height = self.height(i, *at);
                least[i] = if height < least[i] { height } else { least[i] };
            }
        }
        least
    }
}

#[inline(always)]
fn faces(facets: &WeldedFacets, facet: usize, frame: &BeamCoords) -> bool {
    facets.planes[facet].normal.dot(frame.direction) > MIN_FACING_COS
}

/// Whether a footprint lies within `facet` seen along `frame` (see [`Clipper::clip`]).
#[inline(always)]
pub fn contains(
    facets: &WeldedFacets,
    facet: usize,
    frame: &BeamCoords,
    orientation_sign: f64,
    corners: &[DVec2],
) -> bool {
    if !faces(facets, facet, frame) {
        return false;
    }
    for edges in facets.edges(facet) {
        let least = EdgeLines::new(edges, frame, orientation_sign).min_slack(corners);
        let mut outside = false;
        for i in 0..EDGES_PER_GROUP {
            outside |= least[i] < -ON_LINE;
        }
        if outside {
            return false;
        }
    }
    true
}

/// A footprint that is being cut, in buffers kept from beam to beam.
#[derive(Debug, Default)]
pub struct Clipper {
    ring: Ring,
    next: Ring,
    heights: Vec<f64>,
}

/// Corners, and for each the facet edge that the side after it lies on (`NO_NEIGHBOUR` for a side that the
/// footprint had before).
#[derive(Debug, Default)]
struct Ring {
    at: Vec<DVec2>,
    sides: Vec<u32>,
}

impl Ring {
    fn push(&mut self, at: DVec2, side: u32) {
        self.at.push(at);
        self.sides.push(side);
    }

    fn clear(&mut self) {
        self.at.clear();
        self.sides.clear();
    }
}

impl Clipper {
    /// Loads a footprint.
    pub fn load(&mut self, corners: &[DVec2]) {
        self.ring.clear();
        self.ring.at.extend_from_slice(corners);
        self.ring.sides.resize(corners.len(), NO_NEIGHBOUR);
    }

    /// Clips the footprint to `facet` seen along `frame`.
    ///
    /// - `orientation_sign`: 1 if the frame shows facets counter-clockwise, −1 after an odd number of mirrors
    ///
    /// False if nothing is left.
    #[inline(always)]
    pub fn clip(
        &mut self,
        facets: &WeldedFacets,
        facet: usize,
        frame: &BeamCoords,
        orientation_sign: f64,
    ) -> bool {
        if !faces(facets, facet, frame) {
            self.ring.clear();
        }
        for (group, edges) in facets.edges(facet).iter().enumerate() {
            let lines = EdgeLines::new(edges, frame, orientation_sign);
            let least = lines.min_slack(&self.ring.at);
            for (i, least) in least.iter().enumerate() {
                if *least < -ON_LINE && !self.clip_by_line(&lines, i, (group * EDGES_PER_GROUP + i) as u32) {
                    return false;
                }
            }
        }
        !self.is_spent()
    }

    /// Cuts by a line; `edge` is its number in the facet.
    #[inline(always)]
    fn clip_by_line(&mut self, lines: &EdgeLines, line: usize, edge: u32) -> bool {
        self.heights.clear();
        self.heights.extend(self.ring.at.iter().map(|at| lines.height(line, *at)));
        self.next.clear();
        let n = self.heights.len();
        for i in 0..n {
            let j = if i + 1 == n { 0 } else { i + 1 };
            let (a, b, ha, hb) = (self.ring.at[i], self.ring.at[j], self.heights[i], self.heights[j]);
            let crossing = || a + (b - a) * (ha / (ha - hb));
            let side = self.ring.sides[i];
            if ha > ON_LINE {
                self.next.push(a, side);
                if hb < -ON_LINE {
                    self.next.push(crossing(), edge);
                }
            } else if ha >= -ON_LINE {
                // on the line: the next side is the cut if it leads outside
                self.next.push(a, if hb < -ON_LINE { edge } else { side });
            } else if hb > ON_LINE {
                self.next.push(crossing(), side);
            }
        }
        std::mem::swap(&mut self.ring, &mut self.next);
        // corners on the line alone have no area
        if self.ring.at.len() < 3 || self.heights.iter().all(|h| *h <= ON_LINE) {
            self.ring.clear();
        }
        !self.is_spent()
    }

    /// Whether nothing is left.
    pub fn is_spent(&self) -> bool {
        self.ring.at.is_empty()
    }

    /// The footprint's corners, counter-clockwise.
    pub fn corners(&self) -> &[DVec2] {
        &self.ring.at
    }

    /// Numbers of the facet edges across which the footprint went on before it was cut.
    #[inline]
    pub fn cut_edges(&self) -> impl Iterator<Item = usize> + '_ {
        self.ring.sides.iter().filter(|side| **side != NO_NEIGHBOUR).map(|side| *side as usize)
    }
}

/// Area of a footprint, in the plane of the entry facet.
#[inline]
pub fn area(corners: &[DVec2]) -> f64 {
    let [first, rest @ ..] = corners else { return 0.0 };
    0.5 * rest.windows(2).map(|pair| (pair[0] - first).perp_dot(pair[1] - first)).sum::<f64>()
}

/// The facet that the ray `at` of a beam meets next: from facet `start`, which must face along the
/// beam, across an edge that has the ray on its outer side, until there is none.
///
/// The facets that face along the beam tile the outline of the stone, and this walk over them cannot go in
/// a circle, because they are the lower envelope of planes (H. Edelsbrunner, *Combinatorica* 10 (1990)
/// 251). `None` if rounding misled the walk.
pub fn locate(
    facets: &WeldedFacets,
    start: usize,
    frame: &BeamCoords,
    orientation_sign: f64,
    at: DVec2,
) -> Option<usize> {
    let (mut facet, mut came_from) = (start, NO_NEIGHBOUR);
    for _ in 0..facets.count() {
        let beyond = facets.beyond(facet);
        let lines = facets.edges(facet).iter().map(|edges| EdgeLines::new(edges, frame, orientation_sign));
        let heights =
            lines.flat_map(|lines| std::array::from_fn::<f64, EDGES_PER_GROUP, _>(|i| lines.height(i, at)));
        let outside = heights.zip(beyond).find(|(height, next)| *height < 0.0 && **next != came_from);
        let Some((_, next)) = outside else { return Some(facet) };
        if *next == NO_NEIGHBOUR {
            return None;
        }
        (came_from, facet) = (facet as u32, *next as usize);
    }
    None
}
