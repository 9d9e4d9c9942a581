//! Polarised light at a facet: Stokes vectors and the Mueller matrices of Fresnel's equations.
//!
//! A Stokes vector is given about an axis across the ray: with (s, p = d × s, d) right-handed and
//! field components E_s, E_p, I = |E_s|² + |E_p|², Q = |E_s|² − |E_p|², U + iV = 2 E_s E_p*.
//! Source: Born & Wolf, *Principles of Optics*, §1.4–1.5. Checked in `tests/library/polarisation.rs`
//! against field components carried in complex numbers.

use super::fresnel::FresnelCoefficients;
use glam::DVec3;

/// A Stokes vector and the axis it is given about.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stokes {
    /// Power.
    pub i: f64,
    /// Excess along the axis over across it.
    pub q: f64,
    /// Excess at +45° from the axis.
    pub u: f64,
    /// Circular part.
    pub v: f64,
    /// Unit vector across the ray.
    pub axis: DVec3,
}

impl Stokes {
    /// Unpolarised light of power `i`.
    pub fn unpolarised(i: f64, axis: DVec3) -> Stokes {
        Stokes { i, q: 0.0, u: 0.0, v: 0.0, axis }
    }

    /// The same light about the axis across the plane of incidence of a ray `direction` on a facet
    /// with unit normal `normal`; at normal incidence any axis is one and the old one stays.
    pub fn about_incidence(self, direction: DVec3, normal: DVec3) -> Stokes {
        let across = direction.cross(normal);
        if across.length_squared() < 1e-12 {
            return self;
        }
        let axis = across.normalize();
        let (cos, sin) = (self.axis.dot(axis), direction.cross(self.axis).dot(axis));
        let (cos2, sin2) = (cos * cos - sin * sin, 2.0 * cos * sin);
        Stokes { q: cos2 * self.q + sin2 * self.u, u: cos2 * self.u - sin2 * self.q, axis, ..self }
    }

    /// The same light with `share` of its power.
    pub fn dimmed(self, share: f64) -> Stokes {
        Stokes { i: share * self.i, q: share * self.q, u: share * self.u, v: share * self.v, ..self }
    }

    /// What passes a facet of light given about its plane of incidence: what is not reflected.
    #[inline]
    pub fn transmitted(self, f: &FresnelCoefficients) -> Stokes {
        let (t_s, t_p) = (1.0 - f.r_s, 1.0 - f.r_p);
        let (mean, half, both) = (0.5 * (t_s + t_p), 0.5 * (t_s - t_p), (t_s * t_p).max(0.0).sqrt());
        Stokes {
            i: mean * self.i + half * self.q,
            q: half * self.i + mean * self.q,
            u: both * self.u,
            v: both * self.v,
            ..self
        }
    }

    /// What a facet reflects of light given about its plane of incidence.
    pub fn reflected(self, f: &FresnelCoefficients) -> Stokes {
        let (mean, half) = (f.unpolarised_reflectance(), 0.5 * (f.r_s - f.r_p));
        Stokes {
            i: mean * self.i + half * self.q,
            q: half * self.i + mean * self.q,
            u: f.re * self.u - f.im * self.v,
            v: f.im * self.u + f.re * self.v,
            ..self
        }
    }
}
