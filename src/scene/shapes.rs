//! Shapes of surfaces, one a file.

pub mod mesh;
pub mod quad;
mod surface_geometry;

use super::build_context::BuildContext;
use super::field_error::{FieldError, field_error};
use super::surface_schema::SurfaceEntry;
use glam::{Mat3, Vec3};
pub use mesh::SceneMesh;
pub use quad::Quad;
use std::sync::Arc;
pub use surface_geometry::SurfaceGeometry;

/// A surface's shape.
#[derive(Debug, Clone)]
pub enum Shape {
    /// A parallelogram. For light it is there from both sides; the camera looks through its back.
    Quad(Quad),
    /// Triangles, there from both sides for light and camera.
    Mesh(Arc<SceneMesh>),
}

impl Shape {
    /// Its geometry.
    pub fn geometry(&self) -> &dyn SurfaceGeometry {
        match self {
            Shape::Quad(quad) => quad,
            Shape::Mesh(mesh) => mesh.as_ref(),
        }
    }

    /// The quad that it is, if it is one: flat, so that a ray that leaves it does not meet it again, cut
    /// away before a camera behind it, and background unless its entry says otherwise.
    pub fn as_quad(&self) -> Option<&Quad> {
        if let Shape::Quad(quad) = self { Some(quad) } else { None }
    }

    /// The shape turned about a point, then moved.
    pub fn moved(&self, turn: Mat3, about: Vec3, by: Vec3) -> Shape {
        let point = |p: Vec3| about + turn * (p - about) + by;
        match self {
            Shape::Quad(quad) => Shape::Quad(quad.moved(turn, &point)),
            Shape::Mesh(mesh) => Shape::Mesh(Arc::new(mesh.moved(&point))),
        }
    }
}

impl SurfaceEntry {
    /// Its shape.
    pub(super) fn shape(&self, place: &BuildContext) -> Result<Shape, FieldError> {
        match (&self.mesh, self.corner, self.u, self.v) {
            (Some(file), None, None, None) => Ok(Shape::Mesh(Arc::new(SceneMesh::read(file, self, place)?))),
            (None, Some(corner), Some(u), Some(v)) => Ok(Shape::Quad(Quad::read([corner, u, v], place)?)),
            _ => Err(field_error("corner", "a surface has corner, u and v, or a mesh")),
        }
    }
}
