//! The camera: a pinhole with a field of view, a thin lens of some width, or parallel rays.

use crate::color::Illuminant;
use crate::sampling::warps;
use glam::{Mat3, Vec2, Vec3};
use std::sync::Arc;

/// A camera's projection.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Lens {
    /// A pinhole: full angle of the field across the width, in degrees.
    Perspective(f32),
    /// A thin lens: sharp in one plane across the view, blurred before and behind it.
    ///
    /// A point at depth z shows as a disc whose diameter, measured in the plane in focus, is
    /// 2 · `radius` · |z − `focus`| / z. Source: the thin-lens equation, Born & Wolf, *Principles of
    /// Optics*, §4.4. Checked in `tests/library/depth_of_field.rs`.
    Thin {
        /// Full angle of the field across the width, in degrees, from the lens's middle.
        field_deg: f32,
        /// Radius of its opening, world units.
        radius: f32,
        /// Distance of the plane in focus along the view, world units.
        focus: f32,
    },
    /// Parallel rays: what lies across the width, in world units.
    Orthographic(f32),
}

impl Lens {
    /// Whether rays of one place of the picture differ by where they meet the lens.
    pub fn is_open(&self) -> bool {
        matches!(self, Lens::Thin { .. })
    }

    /// Diameter of the opening of a lens with an f-number.
    ///
    /// - `f_number`: focal length over diameter
    /// - `field_deg`: full angle across the width of a picture of 36 mm, the small-picture format
    /// - `focus_mm`: distance of the plane in focus
    ///
    /// Returns millimetres. The picture lies 18 mm / tan(field / 2) behind the lens; focal length
    /// and the two distances follow 1/f = 1/focus + 1/picture.
    pub fn opening_mm(f_number: f32, field_deg: f32, focus_mm: f32) -> f32 {
        const FRAME_MM: f32 = 36.0;
        let picture_mm = 0.5 * FRAME_MM / (0.5 * field_deg.to_radians()).tan();
        (1.0 / focus_mm + 1.0 / picture_mm).recip() / f_number
    }
}

/// A camera.
#[derive(Debug, Clone)]
pub struct Camera {
    /// Position, world frame.
    pub position: Vec3,
    /// Point in the middle of the picture, world frame.
    pub target: Vec3,
    /// Projection.
    pub lens: Lens,
    /// Width over height of the picture.
    pub aspect: f32,
    /// Exposure in stops.
    pub stops: f32,
    /// Light that it shows as white.
    pub white: Arc<Illuminant>,
    /// Whether its colours are flat: each camera ray shows white, red, green, blue or black, whichever has
    /// the greatest share of its light, as in drawings of what gem viewers show. Linear light keeps the
    /// shares, by the three bands of [`crate::color::rgb_upsampling::basis`].
    pub flat: bool,
}

impl Camera {
    /// Origin and unit direction of the ray through a place of the picture and the middle of the lens.
    ///
    /// - `u`: 0 at the left edge, 1 at the right; `v`: 0 at the top, 1 at the bottom
    pub fn ray(&self, u: f32, v: f32) -> (Vec3, Vec3) {
        self.ray_by(u, v, Vec2::ZERO)
    }

    /// The ray of [`Camera::ray`] by any place of the lens.
    ///
    /// - `on_lens`: two uniforms, ignored by a pinhole
    pub fn ray_through(&self, u: f32, v: f32, on_lens: [f32; 2]) -> (Vec3, Vec3) {
        self.ray_by(u, v, if self.lens.is_open() { warps::uniform_disc(on_lens) } else { Vec2::ZERO })
    }

    /// - `on_lens`: a place of the unit disc
    fn ray_by(&self, u: f32, v: f32, on_lens: Vec2) -> (Vec3, Vec3) {
        let forward = (self.target - self.position).normalize();
        // a camera that looks straight down has +y at the top
        let right = self.right();
        let up = right.cross(forward);
        let across = right * (2.0 * u - 1.0) + up * ((1.0 - 2.0 * v) / self.aspect);
        let toward = |field_deg: f32| forward + across * (0.5 * field_deg.to_radians()).tan();
        match self.lens {
            Lens::Perspective(field_deg) => (self.position, toward(field_deg).normalize()),
            Lens::Thin { field_deg, radius, focus } => {
                let off = (right * on_lens.x + up * on_lens.y) * radius;
                (self.position + off, (toward(field_deg) * focus - off).normalize())
            }
            Lens::Orthographic(width) => (self.position + across * (0.5 * width), forward),
        }
    }

    /// The camera turned about its target.
    pub fn turned(&self, turn: Mat3) -> Camera {
        Camera { position: self.target + turn * (self.position - self.target), ..self.clone() }
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
            flat: false,
        };
        let (_, left) = camera.ray(0.0, 0.5);
        assert!((left.x.atan2(left.y).to_degrees() + 19.0).abs() < 1e-4);
        assert!(camera.ray(0.5, 0.0).1.z > 0.0);
        let parallel = Camera { lens: Lens::Orthographic(3.0), ..camera.clone() };
        let (from, along) = parallel.ray(1.0, 0.5);
        assert!((from.x - 1.5).abs() < 1e-5 && along == Vec3::Y);
        let behind = camera.turned(Mat3::from_rotation_z(std::f32::consts::PI));
        assert!((behind.position - Vec3::new(0.0, 8.0, 2.0)).length() < 1e-4);
    }
}
