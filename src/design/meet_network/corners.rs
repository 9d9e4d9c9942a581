//! Corners of a stone: the facets that pass through each, and by how much they miss it.

use super::parts::{FacetOfPart, Frame};
use crate::geometry::polyhedron::Face;
use crate::geometry::{Plane, Polyhedron};
use glam::{DMat3, DVec3};
use std::collections::BTreeSet;

/// Edges shorter than this part of the width have no length that is meant: the facets at their ends meet
/// in one corner. A tenth of the smallest that a faceter sees on a stone of 10 mm, and above what three
/// decimals of a file leave.
const ONE_CORNER: f64 = 1e-4;

/// Facets that pass a place within this part of the width meet there exactly: what eight decimals leave.
const EXACT: f64 = 1e-7;

/// A corner of the stone.
#[derive(Debug, Clone)]
pub struct Corner {
    /// The facets that meet there, numbers in the design; the first three fix it.
    pub facets: Vec<usize>,
    /// Where it is, in the network's frame.
    pub(super) position: DVec3,
    /// Height of the corner above each facet's plane: 0 for the first three, rounding of the file for the
    /// others.
    pub(super) misses: Vec<f64>,
    /// Columns: what the corner moves by for a distance of each of the first three.
    pub(super) moves: DMat3,
}

impl Corner {
    /// The corner of these facets when their planes are `planes`.
    pub(super) fn moved(&self, planes: &[Plane]) -> (DVec3, DMat3) {
        let [a, b, c] = [0, 1, 2].map(|i| planes[self.facets[i]]);
        let moves = DMat3::from_cols(a.normal, b.normal, c.normal).transpose().inverse();
        (moves * DVec3::new(a.distance, b.distance, c.distance), moves)
    }
}

/// A facet's corners, counter-clockwise seen from outside, and its area as it was.
#[derive(Debug, Clone)]
pub(super) struct Outline {
    pub facet: usize,
    corners: Vec<usize>,
    area: f64,
}

impl Outline {
    /// What is left of the facet's area when its corners are at these places, in parts of what it was; negative
    /// of a facet turned inside out.
    pub fn left(&self, places: &[DVec3], normal: DVec3) -> f64 {
        area(&self.corners, places, normal) / self.area
    }
}

fn area(corners: &[usize], places: &[DVec3], normal: DVec3) -> f64 {
    let first = places[corners[0]];
    let fan = corners[1..].windows(2).map(|w| (places[w[0]] - first).cross(places[w[1]] - first));
    0.5 * fan.sum::<DVec3>().dot(normal)
}

/// The corners of a solid, and its facets by them.
///
/// - `planes`: of the design, in the network's frame
pub(super) fn recover(
    solid: &Polyhedron,
    planes: &[Plane],
    frame: &Frame,
    width: f64,
) -> (Vec<Corner>, Vec<Outline>) {
    let mut root: Vec<usize> = (0..solid.vertices.len()).collect();
    fn find(root: &mut [usize], mut v: usize) -> usize {
        while root[v] != v {
            root[v] = root[root[v]];
            v = root[v];
        }
        v
    }
    for face in &solid.faces {
        for (i, &a) in face.corners.iter().enumerate() {
            let b = face.corners[(i + 1) % face.corners.len()];
            if solid.vertices[a].distance(solid.vertices[b]) < ONE_CORNER * width {
                let (a, b) = (find(&mut root, a), find(&mut root, b));
                root[a.max(b)] = a.min(b);
            }
        }
    }
    let mut around: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); solid.vertices.len()];
    for face in &solid.faces {
        for &v in &face.corners {
            around[find(&mut root, v)].insert(face.plane);
        }
    }
    let mut corners = Vec::new();
    let mut number = vec![None; solid.vertices.len()];
    let mut places: Vec<Vec<DVec3>> = vec![Vec::new(); solid.vertices.len()];
    for (v, vertex) in solid.vertices.iter().enumerate() {
        places[find(&mut root, v)].push(*vertex - frame.origin);
    }
    for (v, facets) in around.iter().enumerate().filter(|(_, facets)| facets.len() > 2) {
        if let Some(corner) = corner(facets, planes, &places[v], EXACT * width) {
            number[v] = Some(corners.len());
            corners.push(corner);
        }
    }
    let places: Vec<DVec3> = corners.iter().map(|c: &Corner| c.position).collect();
    let outline = |face: &Face| {
        let mut own: Vec<usize> = face.corners.iter().filter_map(|&v| number[find(&mut root, v)]).collect();
        own.dedup();
        let area = if own.len() > 2 { area(&own, &places, planes[face.plane].normal) } else { 0.0 };
        (area > 0.0).then_some(Outline { facet: face.plane, corners: own, area })
    };
    let outlines = solid.faces.iter().filter_map(outline).collect();
    (corners, outlines)
}

/// The corner of facets near some places: three facets fix it, of those that meet there exactly, if more than
/// three do, the three that cross most squarely.
///
/// - `exact`: distance
fn corner(facets: &BTreeSet<usize>, planes: &[Plane], near: &[DVec3], exact: f64) -> Option<Corner> {
    let through = |place: &DVec3| -> Vec<usize> {
        facets.iter().copied().filter(|&f| planes[f].signed_distance(*place).abs() < exact).collect()
    };
    let met = near.iter().map(through).reduce(|a, b| if b.len() > a.len() { b } else { a })?;
    let all: Vec<usize> = facets.iter().copied().collect();
    let basis = squarest(&met, planes).filter(|_| met.len() > 3).or_else(|| squarest(&all, planes))?;
    let mut ordered = basis.to_vec();
    ordered.extend(all.into_iter().filter(|f| !basis.contains(f)));
    let mut corner =
        Corner { facets: ordered, position: DVec3::ZERO, misses: Vec::new(), moves: DMat3::IDENTITY };
    (corner.position, corner.moves) = corner.moved(planes);
    corner.misses = corner.facets.iter().map(|&f| planes[f].signed_distance(corner.position)).collect();
    corner.misses[..3].fill(0.0);
    Some(corner)
}

/// The three facets that cross most squarely; none if all are nearly parallel to one line.
fn squarest(all: &[usize], planes: &[Plane]) -> Option<[usize; 3]> {
    /// Of many facets so many are tried by threes.
    const TRIED: usize = 12;
    /// The least volume that three normals span.
    const LEAST: f64 = 1e-4;
    let step = all.len().div_ceil(TRIED).max(1);
    let some: Vec<usize> = all.iter().copied().step_by(step).collect();
    let mut best: Option<(f64, [usize; 3])> = None;
    for (i, &a) in some.iter().enumerate() {
        for (j, &b) in some.iter().enumerate().skip(i + 1) {
            for &c in &some[j + 1..] {
                let square = planes[a].normal.cross(planes[b].normal).dot(planes[c].normal).abs();
                // ties go to the first, whatever the rounding
                if best.is_none_or(|(s, _)| square > s * (1.0 + 1e-6)) {
                    best = Some((square, [a, b, c]));
                }
            }
        }
    }
    best.filter(|(square, _)| *square > LEAST).map(|(_, basis)| basis)
}

/// Of corners that are each other's images under the stone's symmetry the first: same height, same
/// distance from the axis, facets of the same parts. Only corners in which more than three facets meet.
pub(super) fn representatives(corners: &[Corner], facets: &[FacetOfPart], width: f64) -> Vec<usize> {
    let mut kept: Vec<(usize, f64, f64, Vec<usize>)> = Vec::new();
    let near = 1e-5 * width;
    for (i, corner) in corners.iter().enumerate().filter(|(_, c)| c.facets.len() > 3) {
        let (radius, height) = (corner.position.truncate().length(), corner.position.z);
        let mut parts: Vec<usize> = corner.facets.iter().map(|f| facets[*f].part).collect();
        parts.sort_unstable();
        let known = kept
            .iter()
            .any(|(_, r, z, p)| (r - radius).abs() < near && (z - height).abs() < near && *p == parts);
        if !known {
            kept.push((i, radius, height, parts));
        }
    }
    kept.into_iter().map(|(i, ..)| i).collect()
}
