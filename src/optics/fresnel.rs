//! Reflection and refraction at a smooth facet: shares of power.

use super::snell::Snell;

/// What happens at a smooth facet to the components across (s) and in (p) the plane of incidence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FresnelCoefficients {
    /// Reflectance of the s component.
    pub r_s: f64,
    /// Reflectance of the p component.
    pub r_p: f64,
    /// Real part of r_s r_p*, the product of the amplitude coefficients.
    pub re: f64,
    /// Imaginary part of it; not 0 at total reflection only.
    pub im: f64,
    /// Cosine of refraction; 0 at total reflection.
    pub cos_t: f64,
}

impl FresnelCoefficients {
    /// Fresnel's coefficients.
    ///
    /// - `cos_i`: |incident · normal|, in 0..=1; `eta`: n_transmitted / n_incident
    #[inline]
    pub fn new(cos_i: f64, eta: f64) -> FresnelCoefficients {
        Self::of(&Snell::new(cos_i, 1.0 / eta))
    }

    /// Fresnel's coefficients of light that is refracted so.
    #[inline]
    pub fn of(law: &Snell<f64>) -> FresnelCoefficients {
        if law.passes() {
            let (s, p) = law.amplitudes();
            FresnelCoefficients { r_s: s * s, r_p: p * p, re: s * p, im: 0.0, cos_t: law.cos_t }
        } else {
            let (re, im) = law.total_reflection();
            FresnelCoefficients { r_s: 1.0, r_p: 1.0, re, im, cos_t: 0.0 }
        }
    }

    /// Reflectance of unpolarised light, (R_s + R_p)/2.
    #[inline]
    pub fn unpolarised_reflectance(&self) -> f64 {
        0.5 * (self.r_s + self.r_p)
    }
}

/// Unpolarised Fresnel reflectance of a smooth facet, (R_s + R_p)/2.
///
/// - `cos_i`: |incident · normal|, in 0..=1
/// - `eta`: n_transmitted / n_incident, dimensionless
///
/// Returns (reflectance in 0..=1, cosine of the refraction angle); the reflectance is exactly 1
/// and the cosine 0 beyond the critical angle.
/// Source: Born & Wolf, *Principles of Optics*, §1.5. Checked in this file's tests and in `tests/library/optics.rs`.
pub fn unpolarised(cos_i: f64, eta: f64) -> (f64, f64) {
    let facing = FresnelCoefficients::new(cos_i, eta);
    (facing.unpolarised_reflectance(), facing.cos_t)
}

/// The critical angle in degrees of a stone of index `n` in air: beyond it light is reflected
/// totally.
pub fn critical_angle_deg(n: f64) -> f64 {
    (1.0 / n).asin().to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_incidence_brewster_and_total_reflection() {
        let n: f64 = 2.417;
        let expected = ((n - 1.0) / (n + 1.0)).powi(2);
        assert!((unpolarised(1.0, n).0 - expected).abs() < 1e-15);
        assert!((unpolarised(1.0, 1.0 / n).0 - expected).abs() < 1e-15);
        // at Brewster's angle R_p = 0 and R_s = cos²(2θ)
        let brewster = n.atan();
        let r = unpolarised(brewster.cos(), n).0;
        assert!((r - 0.5 * (2.0 * brewster).cos().powi(2)).abs() < 1e-14);
        let critical = critical_angle_deg(n).to_radians();
        assert_eq!(unpolarised((critical + 1e-9).cos(), 1.0 / n).0, 1.0);
        assert!(unpolarised((critical - 1e-3).cos(), 1.0 / n).0 < 1.0);
        assert_eq!(unpolarised(0.0, n).0, 1.0);
    }
}
