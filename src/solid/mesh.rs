//! Triangles of a solid's facets, by constrained Delaunay triangulation.

use super::polyhedron::Polyhedron;
use crate::math::sample;
use glam::DVec3;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// A triangulated surface.
#[derive(Debug, Clone, Default)]
pub struct Mesh {
    /// Corner positions, shared between facets.
    pub vertices: Vec<DVec3>,
    /// Corner numbers, counter-clockwise seen from outside.
    pub triangles: Vec<[usize; 3]>,
    /// For each triangle the face it belongs to.
    pub faces: Vec<usize>,
}

impl Polyhedron {
    /// The facets as triangles: no sliver where a better diagonal exists, every edge shared by two.
    ///
    /// Each facet's corners are laid into its plane and triangulated with the outline as
    /// constraint; a facet that spade refuses (two corners that coincide in `f64`) is cut as a fan.
    /// Checked in `tests/geometry.rs`.
    pub fn triangulate(&self) -> Mesh {
        let mut mesh = Mesh { vertices: self.vertices.clone(), ..Mesh::default() };
        for (number, face) in self.faces.iter().enumerate() {
            let normal = self.area_vector(number).normalize_or_zero();
            let triangles = delaunay(self, &face.corners, normal)
                .filter(|t| t.len() == face.corners.len() - 2)
                .unwrap_or_else(|| fan(face.corners.len()));
            for t in triangles {
                mesh.triangles.push(t.map(|i| face.corners[i]));
                mesh.faces.push(number);
            }
        }
        mesh
    }
}

/// Triangles of one facet as numbers into its corners, counter-clockwise about `normal`.
fn delaunay(solid: &Polyhedron, corners: &[usize], normal: DVec3) -> Option<Vec<[usize; 3]>> {
    let (u, v) = sample::frame(normal.as_vec3());
    let (u, v) = (u.as_dvec3(), v.as_dvec3());
    let mut cdt = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
    let mut handles = Vec::with_capacity(corners.len());
    for &c in corners {
        let p = solid.vertices[c] - solid.vertices[corners[0]];
        handles.push(cdt.insert(Point2::new(p.dot(u), p.dot(v))).ok()?);
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
    Some(cdt.inner_faces().map(|f| f.vertices().map(|v| v.index())).collect())
}

fn fan(n: usize) -> Vec<[usize; 3]> {
    (1..n.saturating_sub(1)).map(|i| [0, i, i + 1]).collect()
}
