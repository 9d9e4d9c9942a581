//! Surfaces around the stones: parallelograms and meshes, diffuse or mirrors, the same on both sides.

use super::scene_mesh::SceneMesh;
pub use super::surface_hit::SurfaceHit;
use crate::color::rgb_upsampling;
use glam::{Mat3, Vec3};
use std::sync::Arc;

/// Share of light that a surface gives back, by wavelength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reflectance {
    /// The same at every wavelength.
    Grey(f32),
    /// `low` below `edge_nm`, `high` above, over a soft edge of about 30 nm: with low < high red to
    /// yellow, with low > high blue to cyan.
    Edge {
        /// Reflectance at short wavelengths.
        low: f32,
        /// Reflectance at long wavelengths.
        high: f32,
        /// Wavelength of the middle, nm.
        edge_nm: f32,
    },
    /// Parts of [`rgb_upsampling::basis`], each in 0..=1.
    Mixture(Vec3),
}

impl Reflectance {
    /// Reflectance at `nm`, in 0..=1.
    pub fn value(&self, nm: f32) -> f32 {
        const SOFTNESS_NM: f32 = 8.0;
        match *self {
            Self::Grey(r) => r,
            Self::Mixture(parts) => rgb_upsampling::basis(nm).dot(parts),
            Self::Edge { low, high, edge_nm } => {
                low + (high - low) / (1.0 + ((edge_nm - nm) / SOFTNESS_NM).exp())
            }
        }
    }
}

/// What a surface does with light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bsdf {
    /// Scatters it evenly.
    Diffuse(Reflectance),
    /// Mirrors it.
    Mirror(Reflectance),
}

/// A surface's shape.
#[derive(Debug, Clone)]
pub enum Shape {
    /// A parallelogram. For light it is there from both sides; the camera looks through its back.
    Quad(Quad),
    /// Triangles, there from both sides for light and camera.
    Mesh(Arc<SceneMesh>),
}

/// A surface.
#[derive(Debug, Clone)]
pub struct Surface {
    /// Its shape.
    pub shape: Shape,
    /// What it does with light.
    pub finish: Bsdf,
    /// Whether it is background, such as a floor or a wall: a picture that leaves its background out
    /// ([`super::Scene::cut_out`]) does not show it.
    pub backdrop: bool,
}

impl Surface {
    /// A diffuse parallelogram; `u × v` points to its front.
    pub fn quad(corner: Vec3, u: Vec3, v: Vec3, reflectance: Reflectance) -> Surface {
        let shape = Shape::Quad(Quad { corner, u, v });
        Surface { shape, finish: Bsdf::Diffuse(reflectance), backdrop: true }
    }

    /// The first intersection of a ray with either side.
    ///
    /// - `near`: intersections no farther than this do not count
    pub fn intersect(&self, origin: Vec3, direction: Vec3, near: f32) -> Option<SurfaceHit> {
        match &self.shape {
            Shape::Quad(quad) => quad.intersect(origin, direction).filter(|hit| hit.distance > near),
            Shape::Mesh(mesh) => mesh.intersect(origin, direction, near),
        }
    }

    /// Where a ray that leaves the surface starts: of a mesh, which it may meet again, a little off, so
    /// that rounding does not put it on the other side.
    pub fn start(&self, point: Vec3, normal: Vec3) -> Vec3 {
        match &self.shape {
            Shape::Quad(_) => point,
            Shape::Mesh(mesh) => point + normal * mesh.offset(point),
        }
    }

    /// The surface turned about a point, then moved.
    pub fn moved(&self, turn: Mat3, about: Vec3, by: Vec3) -> Surface {
        let point = |p: Vec3| about + turn * (p - about) + by;
        let shape = match &self.shape {
            Shape::Mesh(mesh) => Shape::Mesh(Arc::new(mesh.moved(&point))),
            Shape::Quad(q) => Shape::Quad(Quad { corner: point(q.corner), u: turn * q.u, v: turn * q.v }),
        };
        Surface { shape, ..self.clone() }
    }

    /// Height of its lowest corner.
    pub fn lowest(&self) -> f32 {
        match &self.shape {
            Shape::Mesh(mesh) => mesh.lowest(),
            Shape::Quad(_) => self.bounds().0.z,
        }
    }

    /// Lowest and highest corner of its box.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        match &self.shape {
            Shape::Mesh(mesh) => mesh.bounds(),
            Shape::Quad(q) => {
                let corners = [q.corner, q.corner + q.u, q.corner + q.v, q.corner + q.u + q.v];
                corners.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |b, c| (b.0.min(*c), b.1.max(*c)))
            }
        }
    }
}

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

    /// Whether a point of the plane lies within the edges.
    pub fn contains(&self, p: Vec3) -> bool {
        within(self.u, self.v, p - self.corner)
    }
}

/// Distance to a parallelogram along a ray, and whether its front is met.
pub(super) fn intersect_parallelogram(
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
