//! A hit on a surface: distance, normal and side.

use glam::Vec3;

/// Where a ray meets a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceHit {
    /// Distance along the ray.
    pub distance: f32,
    /// Unit normal on the ray's side.
    pub normal: Vec3,
    /// Whether that side is the front: of a quad the one that u × v points to, of a triangle the one
    /// from which its corners run counterclockwise.
    pub front: bool,
}
