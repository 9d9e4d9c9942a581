//! The camera: a pinhole with a field of view, or parallel rays.

use crate::optics::Illuminant;
use glam::{Mat3, Vec3};

/// How much a camera sees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Lens {
    /// A pinhole: full angle of the field across the width, in degrees.
    Perspective(f32),
    /// Parallel rays: what lies across the width, in world units.
    Orthographic(f32),
}

/// A camera.
#[derive(Debug, Clone, Copy)]
pub struct Camera {
    /// Where it stands.
    pub position: Vec3,
    /// What it looks at.
    pub target: Vec3,
    /// What it sees.
    pub lens: Lens,
    /// Width over height of the picture.
    pub aspect: f32,
    /// Exposure in stops.
    pub stops: f32,
    /// Light that it shows as white.
    pub white: &'static Illuminant,
}

impl Camera {
    /// Origin and unit direction of the ray through a place of the picture.
    ///
    /// - `u`: 0 at the left edge, 1 at the right; `v`: 0 at the top, 1 at the bottom
    pub fn ray(&self, u: f32, v: f32) -> (Vec3, Vec3) {
        let forward = (self.target - self.position).normalize();
        // a camera that looks straight down has +y at the top
        let right = self.right();
        let up = right.cross(forward);
        let across = right * (2.0 * u - 1.0) + up * ((1.0 - 2.0 * v) / self.aspect);
        match self.lens {
            Lens::Perspective(field_deg) => {
                let half = (0.5 * field_deg.to_radians()).tan();
                (self.position, (forward + across * half).normalize())
            }
            Lens::Orthographic(width) => (self.position + across * (0.5 * width), forward),
        }
    }

    /// The camera carried around its target.
    pub fn turned(&self, turn: Mat3) -> Camera {
        Camera { position: self.target + turn * (self.position - self.target), ..*self }
    }

    /// The camera's horizontal axis, to the right of the picture.
    pub fn right(&self) -> Vec3 {
        (self.target - self.position).cross(Vec3::Z).try_normalize().unwrap_or(Vec3::X)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_field_spans_the_width() {
        let camera = Camera {
            position: Vec3::new(0.0, -8.0, 2.0),
            target: Vec3::new(0.0, 0.0, 2.0),
            lens: Lens::Perspective(38.0),
            aspect: 2.0,
            stops: 0.0,
            white: Illuminant::equal_energy(),
        };
        let (_, left) = camera.ray(0.0, 0.5);
        assert!((left.x.atan2(left.y).to_degrees() + 19.0).abs() < 1e-4);
        assert!(camera.ray(0.5, 0.0).1.z > 0.0);
        let parallel = Camera { lens: Lens::Orthographic(3.0), ..camera };
        let (from, along) = parallel.ray(1.0, 0.5);
        assert!((from.x - 1.5).abs() < 1e-5 && along == Vec3::Y);
        let behind = camera.turned(Mat3::from_rotation_z(std::f32::consts::PI));
        assert!((behind.position - Vec3::new(0.0, 8.0, 2.0)).length() < 1e-4);
    }
}
