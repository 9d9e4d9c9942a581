//! The quad: a parallelogram. For light it is there from both sides; the camera looks through its back.

use super::super::build_context::BuildContext;
use super::super::field_error::{FieldError, field_error};
use super::super::schema::LEAST;
use super::super::surface_hit::SurfaceHit;
use super::surface_geometry::SurfaceGeometry;
use glam::{Mat3, Vec3};

/// A parallelogram.
#[derive(Debug, Clone, Copy)]
pub struct Quad {
    /// A corner.
    pub corner: Vec3,
    /// One edge from the corner.
    pub u: Vec3,
    /// The other edge; `u × v` points to the front.
    pub v: Vec3,
}

impl Quad {
    /// The quad of a surface's entry.
    pub(super) fn read(corners: [[f32; 3]; 3], place: &BuildContext) -> Result<Quad, FieldError> {
        let [corner, u, v] = corners.map(|p| place.point(p));
        let shorter = u.length().min(v.length());
        if shorter < LEAST || u.cross(v).length() <= 1e-9 * u.length() * v.length() {
            return Err(field_error("u", "u and v span no area"));
        }
        Ok(Quad { corner, u, v })
    }

    /// Unit normal of the front.
    pub fn normal(&self) -> Vec3 {
        self.u.cross(self.v).normalize()
    }

    /// The intersection of a ray with either side.
    pub fn intersect(&self, origin: Vec3, direction: Vec3) -> Option<SurfaceHit> {
        let (distance, front) = intersect_parallelogram(self.corner, self.u, self.v, origin, direction)?;
        let normal = if front { self.normal() } else { -self.normal() };
        Some(SurfaceHit { distance, normal, front })
    }

    /// The quad turned, with its corner moved.
    pub(super) fn moved(&self, turn: Mat3, point: &dyn Fn(Vec3) -> Vec3) -> Quad {
        Quad { corner: point(self.corner), u: turn * self.u, v: turn * self.v }
    }

    /// Whether a point of the plane lies within the edges.
    pub fn contains(&self, p: Vec3) -> bool {
        within(self.u, self.v, p - self.corner)
    }
}

impl SurfaceGeometry for Quad {
    fn intersect(&self, origin: Vec3, direction: Vec3, near: f32) -> Option<SurfaceHit> {
        Quad::intersect(self, origin, direction).filter(|hit| hit.distance > near)
    }

    fn bounds(&self) -> (Vec3, Vec3) {
        let Quad { corner, u, v } = *self;
        let corners = [corner, corner + u, corner + v, corner + u + v];
        corners.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |b, c| (b.0.min(*c), b.1.max(*c)))
    }

    fn triangles(&self) -> Vec<[Vec3; 3]> {
        let Quad { corner, u, v } = *self;
        vec![[corner, corner + u, corner + u + v], [corner, corner + u + v, corner + v]]
    }
}

/// Distance to a parallelogram along a ray, and whether its front is met.
pub(crate) fn intersect_parallelogram(
    corner: Vec3,
    u: Vec3,
    v: Vec3,
    origin: Vec3,
    direction: Vec3,
) -> Option<(f32, bool)> {
    let n = u.cross(v);
    let toward = n.dot(direction);
    let t = n.dot(corner - origin) / toward;
    // a ray within the plane has no t
    (t > 0.0 && within(u, v, origin + direction * t - corner)).then_some((t, toward < 0.0))
}

fn within(u: Vec3, v: Vec3, p: Vec3) -> bool {
    let (uu, vv, uv) = (u.length_squared(), v.length_squared(), u.dot(v));
    let (pu, pv) = (p.dot(u), p.dot(v));
    let det = uu * vv - uv * uv;
    let (a, b) = (pu * vv - pv * uv, pv * uu - pu * uv);
    (0.0..=det).contains(&a) && (0.0..=det).contains(&b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quad_is_met_from_both_sides() {
        let floor = Quad { corner: Vec3::new(-1.0, -1.0, 0.0), u: Vec3::X * 2.0, v: Vec3::Y * 2.0 };
        assert_eq!(floor.normal(), Vec3::Z);
        let above = floor.intersect(Vec3::new(0.5, 0.0, 3.0), -Vec3::Z);
        assert_eq!(above, Some(SurfaceHit { distance: 3.0, normal: Vec3::Z, front: true }));
        let below = floor.intersect(Vec3::new(0.5, 0.0, -3.0), Vec3::Z);
        assert_eq!(below, Some(SurfaceHit { distance: 3.0, normal: -Vec3::Z, front: false }));
        assert_eq!(floor.intersect(Vec3::new(1.5, 0.0, 3.0), -Vec3::Z), None);
        assert_eq!(floor.intersect(Vec3::new(0.5, 0.0, 3.0), Vec3::Z), None);
        assert_eq!(floor.intersect(Vec3::new(0.5, 0.0, 0.0), Vec3::X), None);
    }
}
