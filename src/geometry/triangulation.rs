//! Triangles of a solid's facets, by constrained Delaunay triangulation.

use super::polyhedron::{Face, PlaneStatus, Polyhedron};
use super::welding::{weld, without_repeats};
use crate::sampling::warps;
use glam::{DVec2, DVec3};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};
use std::collections::HashMap;

/// A triangulated surface.
#[derive(Debug, Clone, Default)]
pub struct TriangleMesh {
    /// Corner positions, shared between facets.
    pub vertices: Vec<DVec3>,
    /// Corner numbers, counter-clockwise seen from outside.
    pub triangles: Vec<[usize; 3]>,
    /// For each triangle the face it belongs to.
    pub faces: Vec<usize>,
}

impl Polyhedron {
    /// The solid with corners nearer than `distance` to each other made one. Faces that shrink to an
    /// edge or a point go, and count as redundant.
    pub fn welded(&self, distance: f64) -> Polyhedron {
        let first = weld(&self.vertices, 0..self.vertices.len(), self.bounds(), distance);
        if first.iter().enumerate().all(|(i, &f)| i == f) {
            return self.clone();
        }
        let mut number: HashMap<usize, usize> = HashMap::new();
        let mut solid =
            Polyhedron { vertices: Vec::new(), faces: Vec::new(), plane_status: self.plane_status.clone() };
        for face in &self.faces {
            let corners = without_repeats(face.corners.iter().map(|&c| first[c]));
            if corners.len() < 3 {
                solid.plane_status[face.plane] = PlaneStatus::Redundant;
                continue;
            }
            solid.plane_status[face.plane] = PlaneStatus::Facet(solid.faces.len());
            let mut numbered = |c: usize| {
                *number.entry(c).or_insert_with(|| {
                    solid.vertices.push(self.vertices[c]);
                    solid.vertices.len() - 1
                })
            };
            let corners = corners.into_iter().map(&mut numbered).collect();
            solid.faces.push(Face { plane: face.plane, corners });
        }
        solid
    }

    /// The facets as triangles: no sliver where a better diagonal exists, every edge shared by two.
    ///
    /// Each facet's corners are laid into its plane and triangulated with the outline as
    /// constraint; a facet that spade refuses (two corners that coincide in `f64`) is cut as a fan.
    /// Checked in `tests/library/geometry.rs`.
    pub fn triangulate(&self) -> TriangleMesh {
        let mut mesh = TriangleMesh { vertices: self.vertices.clone(), ..TriangleMesh::default() };
        for (number, face) in self.faces.iter().enumerate() {
            let normal = self.area_vector(number).normalize_or_zero();
            let corners: Vec<DVec3> = self.polygon(number).collect();
            for t in triangles_of(&corners, normal) {
                mesh.triangles.push(t.map(|i| face.corners[i]));
                mesh.faces.push(number);
            }
        }
        mesh
    }
}

/// Triangles of a plane polygon, convex or not, as numbers into its corners, counter-clockwise
/// about `normal`; as a fan if its outline crosses or touches itself.
pub(super) fn triangles_of(corners: &[DVec3], normal: DVec3) -> Vec<[usize; 3]> {
    if corners.len() == 3 {
        return fan(3);
    }
    let (u, v) = warps::orthonormal_basis(normal.as_vec3());
    let (u, v) = (u.as_dvec3(), v.as_dvec3());
    let flat = |p: &DVec3| DVec2::new((*p - corners[0]).dot(u), (*p - corners[0]).dot(v));
    delaunay(&corners.iter().map(flat).collect::<Vec<_>>())
        .filter(|t| t.len() == corners.len() - 2)
        .unwrap_or_else(|| fan(corners.len()))
}

fn delaunay(corners: &[DVec2]) -> Option<Vec<[usize; 3]>> {
    let mut cdt = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
    let mut handles = Vec::with_capacity(corners.len());
    for p in corners {
        handles.push(cdt.insert(Point2::new(p.x, p.y)).ok()?);
    }
    if cdt.num_vertices() != corners.len() {
        return None;
    }
    for i in 0..handles.len() {
        let (a, b) = (handles[i], handles[(i + 1) % handles.len()]);
        if !cdt.can_add_constraint(a, b) {
            return None;
        }
        cdt.add_constraint(a, b);
    }
    let triangles = cdt.inner_faces().map(|f| f.vertices().map(|v| v.index()));
    Some(
        triangles
            .filter(|t| polygon_contains(corners, t.iter().map(|&i| corners[i]).sum::<DVec2>() / 3.0))
            .collect(),
    )
}

/// Whether the point lies inside the polygon.
fn polygon_contains(polygon: &[DVec2], p: DVec2) -> bool {
    let crossed = |i: &usize| {
        let (a, b) = (polygon[*i], polygon[(i + 1) % polygon.len()]);
        (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
    };
    (0..polygon.len()).filter(crossed).count() % 2 == 1
}

fn fan(n: usize) -> Vec<[usize; 3]> {
    (1..n.saturating_sub(1)).map(|i| [0, i, i + 1]).collect()
}
