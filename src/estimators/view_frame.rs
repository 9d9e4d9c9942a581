//! View frame: the direction a stone is viewed from, and the axes of the picture. The stone stands still;
//! viewer and light turn about it.

use glam::{DVec2, DVec3, Vec3};

/// A viewer at infinity and his picture, in the stone's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViewFrame {
    /// Unit, towards the viewer: the zenith of his horizon.
    pub axis: DVec3,
    /// Unit, to the right of his picture.
    pub right: DVec3,
    /// Unit, up in his picture; right × top = axis.
    pub top: DVec3,
}

impl ViewFrame {
    /// The face-up stone.
    pub const FACE_UP: ViewFrame = ViewFrame { axis: DVec3::Z, right: DVec3::X, top: DVec3::Y };

    /// A stone turned from face-up about a horizontal axis, before a viewer who stays.
    ///
    /// - `degrees`: right-handed about the axis; `azimuth`: of the axis, degrees from +x towards +y
    ///
    /// Checked in this file's tests and in `tests/library/tilts.rs` against stones that are turned themselves.
    pub fn tilted(degrees: f64, azimuth: f64) -> ViewFrame {
        let (sin, cos) = azimuth.to_radians().sin_cos();
        ViewFrame::FACE_UP.turned(degrees, DVec3::new(cos, sin, 0.0))
    }

    /// The stone turned further.
    ///
    /// - `degrees`: right-handed about `axle`, a unit vector of the stone's frame
    pub fn turned(&self, degrees: f64, axle: DVec3) -> ViewFrame {
        // the viewer goes the other way
        let (sin, cos) = (-degrees).to_radians().sin_cos();
        let turn =
            |v: DVec3| (v * cos + axle.cross(v) * sin + axle * (axle.dot(v) * (1.0 - cos))).normalize();
        ViewFrame { axis: turn(self.axis), right: turn(self.right), top: turn(self.top) }
    }

    /// Where a point of the stone lies in the picture.
    pub fn project(&self, p: DVec3) -> DVec2 {
        DVec2::new(self.right.dot(p), self.top.dot(p))
    }

    /// Sine of the elevation of a direction above the viewer's horizon.
    pub fn sin_elevation(&self, direction: Vec3) -> f32 {
        direction.dot(self.axis.as_vec3())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stone_turned_about_x_shows_the_viewer_its_side() {
        // turned by 90° about +x, what was at +y comes to the top (+z)
        let side = ViewFrame::tilted(90.0, 0.0);
        assert!((side.axis - DVec3::Y).length() < 1e-12, "{side:?}");
        let any = ViewFrame::tilted(17.0, 40.0);
        assert!((any.right.cross(any.top) - any.axis).length() < 1e-12);
        assert!((any.axis.z - 17f64.to_radians().cos()).abs() < 1e-12);
        assert_eq!(ViewFrame::tilted(0.0, 33.0).axis, DVec3::Z);
    }
}
