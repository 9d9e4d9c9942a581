//! Polygons of a mesh, and the rounding with which its numbers are stored.

use glam::DVec3;
use std::sync::Arc;

/// How exactly a mesh is stored.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stored {
    /// The most that a coordinate of a corner may be off by rounding, in the mesh's unit.
    pub corner: f64,
    /// The most that a coordinate of a stated unit normal may be off by rounding.
    pub normal: f64,
}

impl Stored {
    /// In `f64`, as good as exact.
    pub const EXACT: Stored = Stored { corner: 0.0, normal: 0.0 };
}

/// One polygon of a mesh.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Polygon {
    /// The facet it belongs to, or empty; shared, as thousands of polygons may have the same.
    pub name: Arc<str>,
    /// Numbers of its corners, in either winding.
    pub corners: Vec<usize>,
    /// The outward normal that the file states for the facet, if any; any length.
    pub normal: Option<DVec3>,
}
