//! The square light: uniform radiance from one side, equal energy at every wavelength.

use super::surface::parallelogram_hit;
use glam::Vec3;

/// A parallelogram that shines from one side.
#[derive(Debug, Clone, Copy)]
pub struct SquareLight {
    /// A corner.
    pub corner: Vec3,
    /// One edge from the corner.
    pub u: Vec3,
    /// The other edge; `u × v` points to the shining side.
    pub v: Vec3,
    /// Radiance at every wavelength.
    pub radiance: f32,
}

impl SquareLight {
    /// A horizontal square that shines downward.
    pub fn facing_down(centre: Vec3, side: f32, radiance: f32) -> SquareLight {
        let (u, v) = (Vec3::Y * side, Vec3::X * side);
        SquareLight { corner: centre - (u + v) / 2.0, u, v, radiance }
    }

    /// A square around `centre` that shines toward `target`.
    pub fn facing(centre: Vec3, target: Vec3, side: f32, radiance: f32) -> SquareLight {
        let (a, b) = crate::math::sample::frame((target - centre).normalize());
        let (u, v) = (a * side, b * side);
        SquareLight { corner: centre - (u + v) / 2.0, u, v, radiance }
    }

    /// Unit normal of the shining side.
    pub fn normal(&self) -> Vec3 {
        self.u.cross(self.v).normalize()
    }

    /// Area.
    pub fn area(&self) -> f32 {
        self.u.cross(self.v).length()
    }

    /// Power at each wavelength: π × area × radiance.
    pub fn power(&self) -> f32 {
        std::f32::consts::PI * self.area() * self.radiance
    }

    /// The point at the shares `st` of the two edges.
    pub fn point(&self, st: [f32; 2]) -> Vec3 {
        self.corner + self.u * st[0] + self.v * st[1]
    }

    /// Distance along a ray to the shining side, if it is met.
    pub fn hit(&self, origin: Vec3, direction: Vec3) -> Option<f32> {
        parallelogram_hit(self.corner, self.u, self.v, origin, direction)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_shines_where_it_faces() {
        let down = SquareLight::facing_down(Vec3::new(0.0, 0.0, 3.0), 2.0, 10.0);
        assert_eq!(down.normal(), -Vec3::Z);
        assert!((down.power() - std::f32::consts::PI * 40.0).abs() < 1e-3);
        assert_eq!(down.hit(Vec3::ZERO, Vec3::Z), Some(3.0));
        let aimed = SquareLight::facing(Vec3::new(3.0, 0.0, 4.0), Vec3::ZERO, 1.0, 1.0);
        assert!((aimed.normal() - Vec3::new(-0.6, 0.0, -0.8)).length() < 1e-6);
        assert!((aimed.point([0.5, 0.5]) - Vec3::new(3.0, 0.0, 4.0)).length() < 1e-6);
    }
}
