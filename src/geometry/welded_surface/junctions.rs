//! Corners that lie on other faces' edges.
//!
//! Where an edge is divided on one side only, both sides still meet along it: the surface is closed as a set
//! of points, though no two faces share the edge.

use super::{Polygon, WeldedSurface, without_repeats};
use std::collections::HashMap;

/// Edges that are not shared, beyond which nothing is tried: the time grows with their number squared.
const MOST: usize = 20_000;

impl WeldedSurface {
    /// The surface with the corners that lie on edges which are not shared made corners of those edges' faces
    /// as well.
    ///
    /// - `within`: how far from the edge a corner may lie
    pub fn with_corners_on_edges(self, polygons: &[Polygon], within: f64) -> WeldedSurface {
        let ring = |corners: &[usize]| {
            let n = corners.len();
            (0..n).map(|i| (corners[i], corners[(i + 1) % n])).collect::<Vec<_>>()
        };
        let mut shared: HashMap<(usize, usize), usize> = HashMap::new();
        for (a, b) in self.faces.iter().flat_map(|f| ring(&f.corners)) {
            *shared.entry((a.min(b), a.max(b))).or_default() += 1;
        }
        let is_open = |a: usize, b: usize| shared.get(&(a.min(b), a.max(b))) != Some(&2);
        let mut loose: Vec<usize> =
            shared.iter().filter(|(_, n)| **n != 2).flat_map(|((a, b), _)| [*a, *b]).collect();
        loose.sort_unstable();
        loose.dedup();
        if loose.len() > MOST {
            return self;
        }
        loose.sort_by(|&a, &b| self.vertices[a].x.total_cmp(&self.vertices[b].x));
        let on_edge = |a: usize, b: usize| {
            let (from, to) = (self.vertices[a], self.vertices[b]);
            let along = to - from;
            let first = loose.partition_point(|c| self.vertices[*c].x < from.x.min(to.x) - within);
            let near =
                loose[first..].iter().take_while(|c| self.vertices[**c].x <= from.x.max(to.x) + within);
            let mut on: Vec<(f64, usize)> = near
                .map(|&c| ((self.vertices[c] - from).dot(along) / along.length_squared(), c))
                .filter(|&(t, c)| {
                    let inner = t > 0.0 && t < 1.0 && c != a && c != b;
                    inner && (from + t * along).distance(self.vertices[c]) <= within
                })
                .collect();
            on.sort_by(|a, b| a.0.total_cmp(&b.0));
            on.into_iter().map(|(_, c)| c)
        };
        let mut found = 0;
        let outlines = self.faces.iter().map(|face| {
            let mut corners = Vec::with_capacity(face.corners.len());
            for (a, b) in ring(&face.corners) {
                corners.push(a);
                if is_open(a, b) {
                    let before = corners.len();
                    corners.extend(on_edge(a, b));
                    found += corners.len() - before;
                }
            }
            (face.polygon, without_repeats(corners.into_iter()))
        });
        let outlines: Vec<_> = outlines.filter(|(_, c)| c.len() > 2).collect();
        if found == 0 {
            return self;
        }
        WeldedSurface {
            divided_edges: found,
            ..WeldedSurface::from_outlines(self.vertices, polygons, outlines)
        }
    }
}
