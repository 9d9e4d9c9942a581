//! Convex solids: planes, their intersection, triangles, measures; closed meshes that are not convex.

pub mod body;
mod carving;
pub mod measure;
pub mod mesh;
pub mod plane;
pub mod polyhedron;
pub mod recover;
mod scale;
mod surface;

pub use body::Body;
pub use plane::Plane;
pub use polyhedron::{Polyhedron, SolidError};
