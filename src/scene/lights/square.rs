//! The square light: it shines from one side.

use super::{EmissionSample, Emitter, LightSample, LightType};
use crate::sampling::warps;
use crate::scene::PhotonGuide;
use crate::scene::shapes::quad::intersect_parallelogram;
use glam::{Mat3, Vec3};
use std::f32::consts::PI;
use std::sync::Arc;

/// `at`, `to`, `side`: a square around `at` that shines toward `to`.
pub static KIND: LightType = LightType {
    name: "square",
    about: "a square that shines from one side: at, to, side",
    read: |entry, place| {
        let side = entry.side(place)?;
        Ok(Arc::new(Square::facing(entry.position(place)?, entry.to(place)?, side)))
    },
};

/// A parallelogram that shines from one side.
#[derive(Debug, Clone, Copy)]
pub struct Square {
    /// A corner.
    pub corner: Vec3,
    /// One edge from the corner.
    pub u: Vec3,
    /// The other edge; `u × v` points to the shining side.
    pub v: Vec3,
}

impl Square {
    /// A square around `centre` that shines toward `target`.
    pub fn facing(centre: Vec3, target: Vec3, side: f32) -> Square {
        let (u, v) = warps::orthonormal_basis((target - centre).normalize());
        Square { corner: centre - (u + v) * (0.5 * side), u: u * side, v: v * side }
    }

    /// A horizontal square that shines downward.
    pub fn facing_down(centre: Vec3, side: f32) -> Square {
        let (u, v) = (Vec3::Y * side, Vec3::X * side);
        Square { corner: centre - (u + v) / 2.0, u, v }
    }

    /// Unit normal of the shining side.
    pub fn normal(&self) -> Vec3 {
        self.u.cross(self.v).normalize()
    }

    /// Area.
    pub fn area(&self) -> f32 {
        self.u.cross(self.v).length()
    }

    /// The point at the shares `st` of the two edges.
    pub fn point(&self, st: [f32; 2]) -> Vec3 {
        self.corner + self.u * st[0] + self.v * st[1]
    }
}

impl Emitter for Square {
    fn intersect(&self, origin: Vec3, direction: Vec3) -> Option<(f32, Option<Vec3>)> {
        let (t, front) = intersect_parallelogram(self.corner, self.u, self.v, origin, direction)?;
        Some((t, front.then_some(Vec3::ONE)))
    }

    fn sample_li(&self, point: Vec3, _: Vec3, u: [f32; 2]) -> Option<LightSample> {
        sample_area(point, self.point(u), self.normal(), self.area())
    }

    fn sample_le(&self, aim: &PhotonGuide, [s, t, pick, u, v]: [f32; 5]) -> Option<EmissionSample> {
        let point = self.point([s, t]);
        let (direction, weight) = aim.direction(point, self.normal(), 1.0, pick, [u, v])?;
        Some(EmissionSample { point, direction, power: Vec3::splat(PI * self.area() * weight) })
    }

    fn importance(&self, aim: &PhotonGuide) -> f32 {
        self.area() * aim.pdf(self.point([0.5, 0.5]), self.normal())
    }

    /// π × area.
    fn power(&self) -> Option<f32> {
        Some(PI * self.area())
    }

    fn turned(&self, turn: Mat3, about: Vec3) -> Arc<dyn Emitter> {
        let corner = about + turn * (self.corner - about);
        Arc::new(Square { corner, u: turn * self.u, v: turn * self.v })
    }
}

/// A place of a flat light seen from a point; none from behind.
pub(super) fn sample_area(point: Vec3, place: Vec3, normal: Vec3, area: f32) -> Option<LightSample> {
    let to = place - point;
    let distance2 = to.length_squared();
    let direction = to / distance2.sqrt();
    let cos = -normal.dot(direction);
    let radiance = Vec3::splat(area * cos / distance2);
    (cos > 0.0).then(|| LightSample { direction, distance: distance2.sqrt(), radiance_over_pdf: radiance })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_shines_where_it_faces() {
        let down = Square::facing_down(Vec3::new(0.0, 0.0, 3.0), 2.0);
        assert_eq!(down.normal(), -Vec3::Z);
        assert_eq!(down.intersect(Vec3::ZERO, Vec3::Z), Some((3.0, Some(Vec3::ONE))));
        assert_eq!(down.intersect(Vec3::Z * 4.0, -Vec3::Z), Some((1.0, None)));
        assert_eq!(down.intersect(Vec3::new(1.5, 0.0, 0.0), Vec3::Z), None);
        let aimed = Square::facing(Vec3::new(3.0, 0.0, 4.0), Vec3::ZERO, 1.0);
        assert!((aimed.normal() - Vec3::new(-0.6, 0.0, -0.8)).length() < 1e-6);
        assert!((aimed.point([0.5, 0.5]) - Vec3::new(3.0, 0.0, 4.0)).length() < 1e-6);
    }
}
