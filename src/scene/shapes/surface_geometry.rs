//! What every shape of a surface can do: be met by a ray, and be divided into triangles.

use super::super::surface_hit::SurfaceHit;
use glam::Vec3;

/// The geometry of a surface, in the world.
pub trait SurfaceGeometry {
    /// The first intersection of a ray with either side.
    ///
    /// - `near`: intersections no farther than this do not count
    fn intersect(&self, origin: Vec3, direction: Vec3, near: f32) -> Option<SurfaceHit>;

    /// Where a ray that leaves the surface starts: the point itself, unless rounding might put it on the
    /// other side of a surface that it may meet again.
    fn start(&self, point: Vec3, _normal: Vec3) -> Vec3 {
        point
    }

    /// Lowest and highest corner of its box.
    fn bounds(&self) -> (Vec3, Vec3);

    /// Height of its lowest corner.
    fn lowest(&self) -> f32 {
        self.bounds().0.z
    }

    /// The surface in triangles, counterclockwise seen from its front; neighbours follow each other.
    fn triangles(&self) -> Vec<[Vec3; 3]>;
}
