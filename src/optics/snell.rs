//! Snell's law at a smooth facet: the angle and the direction of refracted light, and Fresnel's amplitudes there.
//!
//! The only place of these formulas: in `f64` for beams, the reference tracer and stones that are not convex, in
//! `f32` for the lanes of a packet. Nothing here branches, so that a loop over lanes vectorises.

use std::ops::{Add, Div, Mul, Sub};

/// A floating-point number: `f32` or `f64`.
pub trait Real:
    Copy + PartialOrd + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// The least positive normal number.
    const MIN_POSITIVE: Self;
    /// The larger of two numbers.
    fn max(self, other: Self) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
}

macro_rules! real {
    ($($number:ident)*) => {$(
        impl Real for $number {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const MIN_POSITIVE: Self = $number::MIN_POSITIVE;

            #[inline(always)]
            fn max(self, other: Self) -> Self {
                $number::max(self, other)
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                $number::sqrt(self)
            }
        }
    )*};
}

real!(f32 f64);

/// Snell's law for light that meets a smooth facet.
///
/// Source: Born & Wolf, *Principles of Optics*, §1.5. Checked below and in `tests/library/optics.rs`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Snell<T> {
    /// n_incident / n_transmitted.
    pub ratio: T,
    /// Cosine of incidence.
    pub cos_i: T,
    /// Squared sine of refraction; 1 or more at total reflection.
    pub sin2_t: T,
    /// Cosine of refraction; 0 at total reflection.
    pub cos_t: T,
}

impl<T: Real> Snell<T> {
    /// Light that meets a facet.
    ///
    /// - `cos_i`: |incident · normal|, in 0..=1; `ratio`: n_incident / n_transmitted
    #[inline(always)]
    pub fn new(cos_i: T, ratio: T) -> Snell<T> {
        let sin2_t = ratio * ratio * (T::ONE - cos_i * cos_i);
        Snell { ratio, cos_i, sin2_t, cos_t: (T::ONE - sin2_t).max(T::ZERO).sqrt() }
    }

    /// Whether light passes; if not, it is reflected totally.
    #[inline(always)]
    pub fn passes(&self) -> bool {
        self.sin2_t < T::ONE
    }

    /// Unit direction of the light that passes; means nothing at total reflection.
    ///
    /// - `incident`: unit; `normal`: unit, on the side that the light goes to
    #[inline(always)]
    pub fn refracted(&self, incident: [T; 3], normal: [T; 3]) -> [T; 3] {
        let Snell { ratio, cos_i, cos_t, .. } = *self;
        let bend = cos_t - ratio * cos_i;
        let [dx, dy, dz] = incident;
        let [nx, ny, nz] = normal;
        [ratio * dx + bend * nx, ratio * dy + bend * ny, ratio * dz + bend * nz]
    }

    /// Fresnel's amplitude coefficients of reflection, across (s) and in (p) the plane of incidence, where
    /// light passes.
    #[inline(always)]
    pub fn amplitudes(&self) -> (T, T) {
        let Snell { ratio: n, cos_i, cos_t, .. } = *self;
        let s = (n * cos_i - cos_t) / (n * cos_i + cos_t);
        let p = (cos_i - n * cos_t) / (cos_i + n * cos_t);
        (s, p)
    }

    /// Real and imaginary part of r_s r_p* at total reflection, where cos t = iκ and its size is 1:
    /// A²/|A|² with A = n (cos²i + κ²) + i κ cos i (n² − 1), n the ratio of the indices.
    #[inline(always)]
    pub fn total_reflection(&self) -> (T, T) {
        let Snell { ratio: n, cos_i, sin2_t, .. } = *self;
        let kappa = (sin2_t - T::ONE).max(T::ZERO).sqrt();
        let (x, y) = (n * (cos_i * cos_i + kappa * kappa), cos_i * kappa * (n * n - T::ONE));
        let size = (x * x + y * y).max(T::MIN_POSITIVE);
        ((x * x - y * y) / size, (x * y + x * y) / size)
    }
}

impl Snell<f64> {
    /// The same, rounded to `f32`.
    pub fn to_f32(self) -> Snell<f32> {
        let Snell { ratio, cos_i, sin2_t, cos_t } = self;
        Snell { ratio: ratio as f32, cos_i: cos_i as f32, sin2_t: sin2_t as f32, cos_t: cos_t as f32 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    /// Index of diamond.
    const INDEX: f64 = 2.417;

    /// Facets turned by 0 to 90° before light from above, with both ratios of the indices.
    fn facets() -> impl Iterator<Item = (DVec3, DVec3, f64)> {
        (0..=900).flat_map(|tenth| {
            let (sin, cos) = (0.1 * f64::from(tenth)).to_radians().sin_cos();
            let normal = DVec3::new(0.6 * sin, 0.8 * sin, cos);
            [INDEX, 1.0 / INDEX].map(|ratio| (DVec3::Z, normal, ratio))
        })
    }

    #[test]
    fn refracted_light_keeps_to_snells_law() {
        for (incident, normal, ratio) in facets() {
            let law = Snell::new(incident.dot(normal), ratio);
            if !law.passes() {
                assert_eq!(law.cos_t, 0.0);
                continue;
            }
            let refracted = DVec3::from(law.refracted(incident.into(), normal.into()));
            assert!((refracted.length() - 1.0).abs() < 1e-15, "{refracted}");
            assert!((refracted.dot(normal) - law.cos_t).abs() < 1e-14);
            // n sin i = n' sin t, in one plane: n (d × N) is the same before and behind
            assert!((refracted.cross(normal) - ratio * incident.cross(normal)).length() < 1e-15);
        }
    }

    #[test]
    fn f32_and_f64_agree_to_the_rounding_of_f32() {
        let mut compared = 0;
        for (incident, normal, ratio) in facets() {
            let exact = Snell::new(incident.dot(normal), ratio);
            let lane = Snell::new(exact.cos_i as f32, ratio as f32);
            // near the critical angle cos t is the root of a small difference
            if (exact.sin2_t - 1.0).abs() < 1e-3 {
                continue;
            }
            compared += 1;
            assert_eq!(exact.passes(), lane.passes());
            let near = |a: f64, b: f32| assert!((a - f64::from(b)).abs() < 2e-5, "{a} {b} {exact:?}");
            near(exact.cos_t, lane.cos_t);
            if exact.passes() {
                let (d, n) = (incident.as_vec3(), normal.as_vec3());
                let [exactly, roughly] = [
                    exact.refracted(incident.into(), normal.into()),
                    lane.refracted(d.into(), n.into()).map(f64::from),
                ];
                assert!((DVec3::from(exactly) - DVec3::from(roughly)).length() < 2e-5);
                near(exact.amplitudes().0, lane.amplitudes().0);
                near(exact.amplitudes().1, lane.amplitudes().1);
                let rounded = exact.to_f32().refracted(d.into(), n.into()).map(f64::from);
                assert!((DVec3::from(exactly) - DVec3::from(rounded)).length() < 1e-6);
            } else {
                near(exact.total_reflection().0, lane.total_reflection().0);
                near(exact.total_reflection().1, lane.total_reflection().1);
            }
        }
        assert!(compared > 1500, "{compared}");
    }
}
