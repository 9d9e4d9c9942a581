//! Diffuse surfaces: one-sided parallelograms with a spectrum.

use glam::Vec3;

/// Share of light that a diffuse surface gives back, by wavelength.
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
}

impl Reflectance {
    /// Reflectance at `nm`, in 0..=1.
    pub fn at(&self, nm: f32) -> f32 {
        const SOFTNESS_NM: f32 = 8.0;
        match *self {
            Self::Grey(r) => r,
            Self::Edge { low, high, edge_nm } => {
                low + (high - low) / (1.0 + ((edge_nm - nm) / SOFTNESS_NM).exp())
            }
        }
    }
}

/// A parallelogram that reflects diffusely on one side; from behind it is not there.
#[derive(Debug, Clone, Copy)]
pub struct Surface {
    /// A corner.
    pub corner: Vec3,
    /// One edge from the corner.
    pub u: Vec3,
    /// The other edge; `u × v` points to the reflecting side.
    pub v: Vec3,
    /// Its colour.
    pub reflectance: Reflectance,
}

impl Surface {
    /// Unit normal of the reflecting side.
    pub fn normal(&self) -> Vec3 {
        self.u.cross(self.v).normalize()
    }

    /// Distance along a ray to the reflecting side, if it is met.
    pub fn hit(&self, origin: Vec3, direction: Vec3) -> Option<f32> {
        parallelogram_hit(self.corner, self.u, self.v, origin, direction)
    }

    /// Whether a point of the plane lies within the edges.
    pub fn holds(&self, p: Vec3) -> bool {
        within(self.u, self.v, p - self.corner)
    }
}

/// Distance to the front of a parallelogram along a ray.
pub(super) fn parallelogram_hit(
    corner: Vec3,
    u: Vec3,
    v: Vec3,
    origin: Vec3,
    direction: Vec3,
) -> Option<f32> {
    let n = u.cross(v);
    let toward = n.dot(direction);
    if toward >= 0.0 {
        return None;
    }
    let t = n.dot(corner - origin) / toward;
    // a ray that starts on the surface does not meet it again
    if t <= 1e-5 * corner.distance(origin) {
        return None;
    }
    within(u, v, origin + direction * t - corner).then_some(t)
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
    fn one_side_reflects() {
        let floor = Surface {
            corner: Vec3::new(-1.0, -1.0, 0.0),
            u: Vec3::X * 2.0,
            v: Vec3::Y * 2.0,
            reflectance: Reflectance::Grey(0.5),
        };
        assert_eq!(floor.normal(), Vec3::Z);
        assert_eq!(floor.hit(Vec3::new(0.5, 0.0, 3.0), -Vec3::Z), Some(3.0));
        assert_eq!(floor.hit(Vec3::new(0.5, 0.0, -3.0), Vec3::Z), None);
        assert_eq!(floor.hit(Vec3::new(1.5, 0.0, 3.0), -Vec3::Z), None);
    }
}
