//! A closed mesh that is not a convex solid: with concavities, or in several parts.

use super::measure::{calipers, convex_hull};
use super::triangulation::TriangleMesh;
use glam::{DMat3, DVec3};

/// A facet of a [`ClosedMesh`].
#[derive(Debug, Clone, PartialEq)]
pub struct ClosedMeshFacet {
    /// Its name in the file, possibly empty.
    pub name: String,
    /// Outward unit normal.
    pub normal: DVec3,
}

/// A closed triangulated surface. What a mesh reader hands out where the mesh is not the solid of
/// its facets' planes; see [`super::facet_recovery::Recovered::take_mesh`].
#[derive(Debug, Clone, PartialEq)]
pub struct ClosedMesh {
    /// Corners in use, each once, in the mesh's own unit.
    pub vertices: Vec<DVec3>,
    /// Facets: flat regions of the surface.
    pub facets: Vec<ClosedMeshFacet>,
    /// Corner numbers, counter-clockwise seen from outside.
    pub triangles: Vec<[usize; 3]>,
    /// For each triangle the facet it is part of.
    pub facet_of: Vec<usize>,
    /// Number of separate closed surfaces.
    pub shells: usize,
    /// How far the farthest corner stands out of a facet's plane, in parts of the diagonal.
    pub max_protrusion: f64,
    /// Volume enclosed, in the mesh's unit cubed; shells add up.
    pub volume: f64,
}

impl ClosedMesh {
    /// Its surface, faces numbered as the facets.
    pub fn mesh(&self) -> TriangleMesh {
        let (vertices, triangles) = (self.vertices.clone(), self.triangles.clone());
        TriangleMesh { vertices, triangles, faces: self.facet_of.clone() }
    }

    /// Smallest and largest coordinates.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        self.vertices
            .iter()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(lo, hi), &v| (lo.min(v), hi.max(v)))
    }

    /// Sum of the area vectors of each facet's triangles.
    pub fn area_vectors(&self) -> Vec<DVec3> {
        let mut areas = vec![DVec3::ZERO; self.facets.len()];
        for (triangle, facet) in self.triangles.iter().zip(&self.facet_of) {
            let [a, b, c] = triangle.map(|corner| self.vertices[corner]);
            areas[*facet] += 0.5 * (b - a).cross(c - a);
        }
        areas
    }

    /// The body turned about its origin.
    pub fn turned(mut self, rotation: DMat3) -> ClosedMesh {
        self.vertices.iter_mut().for_each(|v| *v = rotation * *v);
        self.facets.iter_mut().for_each(|f| f.normal = rotation * f.normal);
        self
    }

    /// Girdle width, as [`super::Polyhedron::width`].
    pub fn width(&self) -> f64 {
        calipers(&convex_hull(self.vertices.iter().map(|v| v.truncate()).collect())).0
    }

    /// The body made `k` times as large about its origin.
    pub fn scaled(mut self, k: f64) -> ClosedMesh {
        self.vertices.iter_mut().for_each(|v| *v *= k);
        self.volume *= k.powi(3);
        self
    }
}
