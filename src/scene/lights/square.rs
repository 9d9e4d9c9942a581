//! The square light: it shines from one side.

use super::{Emitter, Glimpse, Kind, Start};
use crate::math::sample;
use crate::scene::Aim;
use crate::scene::surface::parallelogram_hit;
use glam::{Mat3, Vec3};
use std::f32::consts::PI;
use std::sync::Arc;

/// `at`, `to`, `side`: a square around `at` that shines toward `to`.
pub static KIND: Kind = Kind {
    name: "square",
    about: "a square that shines from one side: at, to, side",
    read: |entry, place| {
        let side = entry.side(place)?;
        Ok(Arc::new(Square::facing(entry.at(place)?, entry.to(place)?, side)))
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
        let (u, v) = sample::frame((target - centre).normalize());
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
    fn hit(&self, origin: Vec3, direction: Vec3) -> Option<(f32, Vec3)> {
        parallelogram_hit(self.corner, self.u, self.v, origin, direction).map(|t| (t, Vec3::ONE))
    }

    fn seen_from(&self, point: Vec3, _: Vec3, u: [f32; 2]) -> Option<Glimpse> {
        glimpse_of_area(point, self.point(u), self.normal(), self.area())
    }

    fn leave(&self, aim: &Aim, [s, t, pick, u, v]: [f32; 5]) -> Option<Start> {
        let point = self.point([s, t]);
        let (direction, weight) = aim.direction(point, self.normal(), 1.0, pick, [u, v])?;
        Some(Start { point, direction, power: Vec3::splat(PI * self.area() * weight) })
    }

    fn reach(&self, aim: &Aim) -> f32 {
        self.area() * aim.seen_from(self.point([0.5, 0.5]), self.normal())
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
pub(super) fn glimpse_of_area(point: Vec3, place: Vec3, normal: Vec3, area: f32) -> Option<Glimpse> {
    let to = place - point;
    let distance2 = to.length_squared();
    let direction = to / distance2.sqrt();
    let cos = -normal.dot(direction);
    let radiance = Vec3::splat(area * cos / distance2);
    (cos > 0.0).then(|| Glimpse { direction, distance: distance2.sqrt(), radiance })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_shines_where_it_faces() {
        let down = Square::facing_down(Vec3::new(0.0, 0.0, 3.0), 2.0);
        assert_eq!(down.normal(), -Vec3::Z);
        assert_eq!(down.hit(Vec3::ZERO, Vec3::Z), Some((3.0, Vec3::ONE)));
        assert_eq!(down.hit(Vec3::Z * 4.0, -Vec3::Z), None);
        let aimed = Square::facing(Vec3::new(3.0, 0.0, 4.0), Vec3::ZERO, 1.0);
        assert!((aimed.normal() - Vec3::new(-0.6, 0.0, -0.8)).length() < 1e-6);
        assert!((aimed.point([0.5, 0.5]) - Vec3::new(3.0, 0.0, 4.0)).length() < 1e-6);
    }
}
