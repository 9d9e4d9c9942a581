//! Convex solids: planes, their intersection, triangles, measures; closed meshes that are not convex.

pub mod axial_symmetry;
mod clip_scale;
pub mod closed_mesh;
pub mod facet_recovery;
mod half_space_clipper;
pub mod measure;
pub mod plane;
pub mod polygon;
pub mod polyhedron;
pub mod triangulation;
mod welded_surface;
pub mod welding;

pub use axial_symmetry::AxialSymmetry;
pub use closed_mesh::ClosedMesh;
pub use plane::Plane;
pub use polyhedron::{Polyhedron, SolidError};
