//! Sampling warps: uniform numbers to points and directions, each with its density.

use glam::{Vec2, Vec3};
use std::f32::consts::{PI, TAU};

/// A point of the unit disc, uniform by area (density 1/π).
///
/// - `u`: two uniforms in (0, 1)
pub fn uniform_disc(u: [f32; 2]) -> Vec2 {
    let (r, phi) = (u[0].sqrt(), TAU * u[1]);
    Vec2::new(r * phi.cos(), r * phi.sin())
}

/// A direction about +z with density cos θ / π; its z is the cosine.
pub fn cosine_hemisphere(u: [f32; 2]) -> Vec3 {
    let p = uniform_disc(u);
    p.extend((1.0 - p.length_squared()).max(0.0).sqrt())
}

/// Density of [`cosine_hemisphere`] per steradian.
pub fn cosine_hemisphere_pdf(cos_theta: f32) -> f32 {
    cos_theta.max(0.0) / PI
}

/// A direction uniform over the cone about +z whose half-angle has cosine `cos_max`.
pub fn uniform_cone(u: [f32; 2], cos_max: f32) -> Vec3 {
    let z = 1.0 - u[0] * (1.0 - cos_max);
    let r = (1.0 - z * z).max(0.0).sqrt();
    let phi = TAU * u[1];
    Vec3::new(r * phi.cos(), r * phi.sin(), z)
}

/// Density of [`uniform_cone`] per steradian, inside the cone.
pub fn uniform_cone_pdf(cos_max: f32) -> f32 {
    1.0 / (TAU * (1.0 - cos_max))
}

/// Two weights (b, c) of a point uniform in a triangle: a + b·(B−A) + c·(C−A).
pub fn uniform_triangle(u: [f32; 2]) -> [f32; 2] {
    let s = u[0].sqrt();
    [s * (1.0 - u[1]), s * u[1]]
}

/// Two unit vectors that with `n` form a right-handed frame.
///
/// Source: Duff et al., *Building an Orthonormal Basis, Revisited*, JCGT 6(1), 2017.
pub fn orthonormal_basis(n: Vec3) -> (Vec3, Vec3) {
    let sign = 1f32.copysign(n.z);
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    (Vec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x), Vec3::new(b, sign + n.y * n.y * a, -n.y))
}

/// A direction given about +z, turned to stand about `n`.
pub fn to_world(n: Vec3, local: Vec3) -> Vec3 {
    let (t, b) = orthonormal_basis(n);
    t * local.x + b * local.y + n * local.z
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::random::{Purpose, Stream};

    #[test]
    fn means_match_the_densities() {
        let mut s = Stream::new(1, Purpose::TEST, 0);
        let n = 100_000;
        let (mut cos, mut cone_z) = (0.0f64, 0.0f64);
        for _ in 0..n {
            cos += f64::from(cosine_hemisphere(s.pair()).z) / n as f64;
            cone_z += f64::from(uniform_cone(s.pair(), 0.5).z) / n as f64;
        }
        // E[cos θ] = 2/3 with standard deviation √(1/18); E[z] of the cone = 3/4 with 1/√48
        assert!((cos - 2.0 / 3.0).abs() < 4.0 * (1.0 / 18.0f64).sqrt() / (n as f64).sqrt());
        assert!((cone_z - 0.75).abs() < 4.0 * (1.0 / 48.0f64).sqrt() / (n as f64).sqrt());
    }

    #[test]
    fn the_frame_is_orthonormal_and_right_handed() {
        for n in [Vec3::Z, -Vec3::Z, Vec3::X, Vec3::new(0.6, -0.48, -0.64)] {
            let (t, b) = orthonormal_basis(n);
            assert!((t.cross(b) - n).length() < 1e-6);
            assert!(t.dot(b).abs() < 1e-6 && t.dot(n).abs() < 1e-6);
        }
    }
}
