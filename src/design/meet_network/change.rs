//! What is to change about a network, and what comes of it.

use crate::geometry::Plane;

/// What is to change about a network's parts.
#[derive(Debug, Clone, Default)]
pub struct Change {
    /// Of each part the polar angle that it is to have, in radians; none leaves it, and lets it follow where
    /// the meets ask for that. Empty changes none.
    pub polars: Vec<Option<f64>>,
    /// Of each part the angle by which it is turned about the axis, in radians, counter-clockwise seen from
    /// +z. Empty turns none.
    pub turns: Vec<f64>,
    /// What the size of the table is multiplied by; none leaves it, as far as the meets do.
    pub table: Option<f64>,
    /// The same of the culet.
    pub culet: Option<f64>,
    /// What is added to the thickness of the girdle, in the design's unit; the crown moves.
    pub girdle: f64,
    /// Of each part what is added to its distance, in the design's unit, in place of its meets' choice.
    pub distances: Vec<Option<f64>>,
    /// Whether only distances may follow: no angle that is not set changes.
    pub angles_stay: bool,
}

/// A network solved.
#[derive(Debug, Clone)]
pub struct Solved {
    /// Planes in the order of the design's facets, in its frame.
    pub planes: Vec<Plane>,
    /// Polar angle of each part, in radians.
    pub polars: Vec<f64>,
    /// Parts whose angles followed though nobody asked for it.
    pub followed: Vec<usize>,
    /// Whether the outline had to change.
    pub is_outline_changed: bool,
}
