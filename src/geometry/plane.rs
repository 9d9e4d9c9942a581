//! A facet's plane: the half-space that a cut leaves.

use glam::{DMat3, DVec3};

/// The half-space `normal · x ≤ distance`.
///
/// ```
/// use cutlab::Plane;
/// use cutlab::glam::DVec3;
///
/// let table = Plane::new(DVec3::Z, 2.0);
/// assert_eq!(table.signed_distance(DVec3::new(1.0, 1.0, 3.0)), 1.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Unit normal, pointing out of the stone.
    pub normal: DVec3,
    /// Distance of the plane from the origin along the normal, in the design's unit.
    pub distance: f64,
}

impl Plane {
    /// The half-space with outward `normal` (any length but 0) and `distance` along it.
    pub fn new(normal: DVec3, distance: f64) -> Self {
        Self { normal: normal.normalize(), distance }
    }

    /// Signed height of `p` above the plane; positive outside the stone.
    pub fn signed_distance(&self, p: DVec3) -> f64 {
        self.normal.dot(p) - self.distance
    }

    /// The plane after the stone is scaled by `k` about the origin.
    pub fn scaled(&self, k: f64) -> Self {
        Self { normal: self.normal, distance: self.distance * k }
    }

    /// The plane after the stone is moved by `offset`.
    pub fn moved(&self, offset: DVec3) -> Self {
        Self { normal: self.normal, distance: self.distance + self.normal.dot(offset) }
    }

    /// The plane after the stone is turned by `rotation` about the origin.
    pub fn turned(&self, rotation: DMat3) -> Self {
        Self { normal: (rotation * self.normal).normalize(), distance: self.distance }
    }
}
