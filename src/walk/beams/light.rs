//! What a beam carries: a trait, so that a Stokes vector or a memory of the strongest exit can take
//! the place of a number.

use super::frame::Frame;
use crate::optics::fresnel;
use glam::DVec3;

/// A facet as the light of a beam meets it.
#[derive(Debug, Clone, Copy)]
pub struct Interface<'a> {
    /// |direction · normal| before the facet.
    pub cos_i: f64,
    /// Cosine behind the facet; 0 at total reflection.
    pub cos_t: f64,
    /// n behind / n before.
    pub eta: f64,
    /// Outward unit normal of the facet.
    pub normal: DVec3,
    /// Unit direction of the light that passes; the zero vector at total reflection.
    pub passed: DVec3,
    /// The beam that arrives: `across` and `direction` are what an orientation is referred to. At
    /// entry the frame of the beam inside, whose `across` is the same.
    pub frame: &'a Frame,
}

/// Light of a beam, as a share of the light that fell on its footprint.
pub trait Light: Copy {
    /// Its power: 1 for all that fell on the footprint.
    fn power(&self) -> f64;

    /// What passes a facet, and what is thrown back. No power is lost.
    fn split(&self, at: &Interface) -> (Self, Self);

    /// Whether it is worth following, whatever its power.
    fn goes_on(&self) -> bool {
        true
    }
}

/// Unpolarised at every facet: a power alone, split by (R_s + R_p)/2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scalar(pub f64);

impl Light for Scalar {
    #[inline]
    fn power(&self) -> f64 {
        self.0
    }

    #[inline]
    fn split(&self, at: &Interface) -> (Scalar, Scalar) {
        if at.cos_t == 0.0 {
            return (Scalar(0.0), *self);
        }
        let kept = self.0 * fresnel::unpolarised(at.cos_i, at.eta).0;
        (Scalar(self.0 - kept), Scalar(kept))
    }
}

/// Refraction of a unit `direction` at a surface.
///
/// - `normal`: unit, on the side that the light goes to
/// - `eta`: n behind / n before
///
/// Returns (cos_i, cos_t, direction behind), with 0 and the zero vector at total reflection.
#[inline]
pub fn refract(direction: DVec3, normal: DVec3, eta: f64) -> (f64, f64, DVec3) {
    let cos_i = direction.dot(normal).clamp(0.0, 1.0);
    let cos2_t = 1.0 - (1.0 - cos_i * cos_i) / (eta * eta);
    if cos2_t <= 0.0 {
        return (cos_i, 0.0, DVec3::ZERO);
    }
    let cos_t = cos2_t.sqrt();
    (cos_i, cos_t, (direction - normal * cos_i) / eta + normal * cos_t)
}
