//! Welded facets for beams: rings of corners, each edge with its neighbouring facet.

use crate::geometry::Plane;
use crate::geometry::welding::{crowded, weld, without_repeats};
use crate::trace::ConvexStone;
use glam::DVec3;

/// Corners nearer to each other than this are one (trace units: the stone's radius is 1). Where
/// many planes meet, rounding leaves corners up to 1e-10 apart, and an edge between two of them has
/// a random direction that clips whole beams away. Far below anything cut on purpose.
pub const WELD_DISTANCE: f64 = 1e-9;

/// No facet beyond an edge (a facet that welding has closed up).
pub const NO_NEIGHBOUR: u32 = u32::MAX;

/// Edges that are clipped against side by side: one register of AVX2.
pub const EDGES_PER_GROUP: usize = 4;

/// A few edges of a facet, axis by axis, trace frame. Two facets have their common edge from the
/// same corner on, so that rounding cuts both along the same line. What is left over of the last
/// few has length 0: no footprint lies outside.
#[derive(Debug, Clone, Copy, Default)]
pub struct EdgeGroup {
    /// A corner.
    pub from: [[f64; EDGES_PER_GROUP]; 3],
    /// Counter-clockwise seen from outside.
    pub along: [[f64; EDGES_PER_GROUP]; 3],
}

/// Rings of all facets of a stone, trace frame. Facets have the stone's numbers; one that welding
/// has closed up has an empty ring.
#[derive(Debug, Clone)]
pub struct WeldedFacets {
    /// Facet planes.
    pub planes: Vec<Plane>,
    firsts: Vec<u32>,
    corners: Vec<DVec3>,
    groups: Vec<u32>,
    edges: Vec<EdgeGroup>,
    neighbours: Vec<u32>,
}

impl WeldedFacets {
    /// Welds the corners of a stone.
    pub fn new(stone: &ConvexStone) -> WeldedFacets {
        let corners: Vec<DVec3> = stone.solid.vertices.iter().map(|v| stone.point_from_design(*v)).collect();
        let first_of = welded(&corners);
        let rings: Vec<Vec<u32>> =
            stone.solid.faces.iter().map(|f| ring(f.corners.iter().map(|c| first_of[*c] as u32))).collect();
        let edges = |facet: usize| {
            let ring = &rings[facet];
            (0..ring.len()).map(move |i| (ring[i], ring[(i + 1) % ring.len()]))
        };
        let mut owners: Vec<((u32, u32), u32)> = Vec::new();
        for facet in 0..rings.len() {
            owners.extend(edges(facet).map(|edge| (edge, facet as u32)));
        }
        owners.sort_unstable();
        let owner = |edge: (u32, u32)| {
            let (of_edge, facet) = *owners[..owners.partition_point(|o| o.0 <= edge)].last()?;
            (of_edge == edge).then_some(facet)
        };
        let mut made = WeldedFacets {
            planes: stone.planes.clone(),
            firsts: vec![0],
            corners: Vec::new(),
            groups: vec![0],
            edges: Vec::new(),
            neighbours: Vec::new(),
        };
        for (facet, ring) in rings.iter().enumerate() {
            made.corners.extend(ring.iter().map(|c| corners[*c as usize]));
            made.firsts.push(made.corners.len() as u32);
            for (i, (a, b)) in edges(facet).enumerate() {
                if i % EDGES_PER_GROUP == 0 {
                    made.edges.push(EdgeGroup::default());
                    made.neighbours.extend([NO_NEIGHBOUR; EDGES_PER_GROUP]);
                }
                let last = made.edges.len() - 1;
                let along = corners[b as usize] - corners[a as usize];
                for axis in 0..3 {
                    made.edges[last].from[axis][i % EDGES_PER_GROUP] = corners[a.min(b) as usize][axis];
                    made.edges[last].along[axis][i % EDGES_PER_GROUP] = along[axis];
                }
                made.neighbours[last * EDGES_PER_GROUP + i % EDGES_PER_GROUP] =
                    owner((b, a)).unwrap_or(NO_NEIGHBOUR);
            }
            made.groups.push(made.edges.len() as u32);
        }
        made
    }

    /// Number of facets.
    pub fn count(&self) -> usize {
        self.planes.len()
    }

    /// Corners of a facet, counter-clockwise seen from outside.
    #[inline]
    pub fn ring(&self, facet: usize) -> &[DVec3] {
        &self.corners[self.firsts[facet] as usize..self.firsts[facet + 1] as usize]
    }

    /// Area of a facet in its plane, trace units squared.
    pub fn area(&self, facet: usize) -> f64 {
        let [first, rest @ ..] = self.ring(facet) else { return 0.0 };
        let twice: DVec3 = rest.windows(2).map(|pair| (pair[0] - first).cross(pair[1] - first)).sum();
        0.5 * twice.dot(self.planes[facet].normal)
    }

    fn groups(&self, facet: usize) -> std::ops::Range<usize> {
        self.groups[facet] as usize..self.groups[facet + 1] as usize
    }

    /// Edges of a facet, from its first corner on.
    #[inline]
    pub fn edges(&self, facet: usize) -> &[EdgeGroup] {
        &self.edges[self.groups(facet)]
    }

    /// For each edge of [`WeldedFacets::edges`], the facet beyond it, or `NO_NEIGHBOUR`.
    #[inline]
    pub fn beyond(&self, facet: usize) -> &[u32] {
        let groups = self.groups(facet);
        &self.neighbours[groups.start * EDGES_PER_GROUP..groups.end * EDGES_PER_GROUP]
    }
}

/// For each corner, the number of the corner it is welded to.
fn welded(corners: &[DVec3]) -> Vec<usize> {
    let crowded = crowded(corners, WELD_DISTANCE);
    let mut order: Vec<usize> = (0..corners.len()).filter(|i| crowded[*i]).collect();
    order.sort_by(|a, b| corners[*a].x.total_cmp(&corners[*b].x));
    let (low, high) = corners
        .iter()
        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), c| (low.min(*c), high.max(*c)));
    weld(corners, order, (low, high), WELD_DISTANCE)
}

/// The ring without repeated corners and without spikes; empty if no surface is left.
fn ring(corners: impl Iterator<Item = u32>) -> Vec<u32> {
    let ring = without_repeats(corners);
    if ring.len() > 2 { ring } else { Vec::new() }
}
