//! The camera: a pinhole with a field of view.

use glam::{Mat3, Vec3};

/// A pinhole camera.
#[derive(Debug, Clone, Copy)]
pub struct Camera {
    /// Where it stands.
    pub position: Vec3,
    /// What it looks at.
    pub target: Vec3,
    /// Full angle of the field, across the width, in degrees.
    pub field_deg: f32,
    /// Width over height of the picture.
    pub aspect: f32,
}

impl Camera {
    /// Unit direction through a place of the picture.
    ///
    /// - `u`: 0 at the left edge, 1 at the right; `v`: 0 at the top, 1 at the bottom
    pub fn ray(&self, u: f32, v: f32) -> Vec3 {
        let forward = (self.target - self.position).normalize();
        let right = forward.cross(Vec3::Z).normalize();
        let up = right.cross(forward);
        let half = (0.5 * self.field_deg.to_radians()).tan();
        (forward + right * (2.0 * u - 1.0) * half + up * (1.0 - 2.0 * v) * half / self.aspect).normalize()
    }

    /// The camera carried around the vertical through its target, counter-clockwise from above.
    pub fn turned(&self, degrees: f32) -> Camera {
        let turn = Mat3::from_rotation_z(degrees.to_radians());
        Camera { position: self.target + turn * (self.position - self.target), ..*self }
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
            field_deg: 38.0,
            aspect: 2.0,
        };
        let left = camera.ray(0.0, 0.5);
        assert!((left.x.atan2(left.y).to_degrees() + 19.0).abs() < 1e-4);
        assert!(camera.ray(0.5, 0.0).z > 0.0);
        let behind = camera.turned(180.0);
        assert!((behind.position - Vec3::new(0.0, 8.0, 2.0)).length() < 1e-4);
    }
}
