//! Convex solids: planes, their intersection, triangles, measures.

mod carving;
pub mod measure;
pub mod mesh;
pub mod plane;
pub mod polyhedron;
pub mod recover;
mod surface;

pub use plane::Plane;
pub use polyhedron::{Polyhedron, SolidError};
