//! Daylight: the clear sky and the sun in it.
//!
//! Source: A. J. Preetham, P. Shirley and B. Smits, *A practical analytic model for daylight*,
//! SIGGRAPH 1999, appendix A: the sky's distribution of luminance and chromaticity fitted to
//! simulated atmospheres, and what the atmosphere leaves of the sun's light. Directions have z up;
//! azimuths go from +y toward +x, as on a compass. Checked in `tests/library/daylight.rs` against the
//! illuminances that lighting engineers use.

use super::cie;
use glam::Vec3;
use std::f32::consts::PI;

/// Radius of the sun's disc, degrees.
pub const SUN_RADIUS_DEG: f32 = 0.265;

/// Illuminance of a surface that faces the sun outside the atmosphere, klx.
/// Source: S. Darula, R. Kittler and C. A. Gueymard, *Solar Energy* 79 (2005) 559.
const SUN_KLX: f32 = 133.3;

/// c₂/T of the sun's spectrum, taken as that of a black body at its effective temperature of
/// 5772 K (IAU 2015), nm.
const SUN_C2_OVER_T: f32 = 1.438_777e7 / 5772.0;

/// Absorption of ozone at 380, 390 … 730 nm per cm at standard pressure. Source: the paper's table 2,
/// from M. Iqbal, *An Introduction to Solar Radiation*, 1983.
#[rustfmt::skip]
const OZONE_PER_CM: [f32; 36] = [
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.002, 0.003, 0.006, 0.009, 0.014, 0.021,
    0.03, 0.04, 0.048, 0.063, 0.075, 0.085, 0.103, 0.12, 0.12, 0.115, 0.125, 0.12,
    0.105, 0.09, 0.079, 0.067, 0.057, 0.048, 0.036, 0.028, 0.023, 0.018, 0.014, 0.011,
];
/// How much ozone there is above us, cm at standard pressure.
const OZONE_CM: f32 = 0.35;

/// A clear sky.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClearSky {
    /// Unit direction to the sun.
    pub sun: Vec3,
    turbidity: f32,
    /// Chromaticities x and y, and luminance in kcd/m², at the zenith.
    zenith: [f32; 3],
}

impl ClearSky {
    /// A sky by where its sun stands.
    ///
    /// - `elevation_deg`: of the sun above the horizon, 0 to 90; `azimuth_deg`: from +y toward +x
    /// - `turbidity`: how hazy the air is, 2 (clear) to 10 (hazy)
    pub fn new(elevation_deg: f32, azimuth_deg: f32, turbidity: f32) -> ClearSky {
        let (sin, cos) = elevation_deg.to_radians().sin_cos();
        let (east, north) = azimuth_deg.to_radians().sin_cos();
        let theta = (90.0 - elevation_deg).to_radians();
        let chi = (4.0 / 9.0 - turbidity / 120.0) * (PI - 2.0 * theta);
        let luminance = (4.0453 * turbidity - 4.9710) * chi.tan() - 0.2155 * turbidity + 2.4192;
        let cubic = |[a, b, c, d]: [f32; 4]| ((a * theta + b) * theta + c) * theta + d;
        let in_turbidity =
            |[two, one, zero]: [[f32; 4]; 3]| (cubic(two) * turbidity + cubic(one)) * turbidity + cubic(zero);
        let x = in_turbidity([
            [0.00166, -0.00375, 0.00209, 0.0],
            [-0.02903, 0.06377, -0.03202, 0.00394],
            [0.11693, -0.21196, 0.06052, 0.25886],
        ]);
        let y = in_turbidity([
            [0.00275, -0.00610, 0.00317, 0.0],
            [-0.04214, 0.08970, -0.04153, 0.00516],
            [0.15346, -0.26756, 0.06670, 0.26688],
        ]);
        ClearSky { sun: Vec3::new(cos * east, cos * north, sin), turbidity, zenith: [x, y, luminance] }
    }

    /// XYZ of the sky in a unit direction, Y in kcd/m²; below the horizon that of the horizon.
    pub fn sky(&self, d: Vec3) -> Vec3 {
        let t = self.turbidity;
        let [x, y, luminance] = [
            [
                -0.0193 * t - 0.2592,
                -0.0665 * t + 0.0008,
                -0.0004 * t + 0.2125,
                -0.0641 * t - 0.8989,
                -0.0033 * t + 0.0452,
            ],
            [
                -0.0167 * t - 0.2608,
                -0.0950 * t + 0.0092,
                -0.0079 * t + 0.2102,
                -0.0441 * t - 1.6537,
                -0.0109 * t + 0.0529,
            ],
            [
                0.1787 * t - 1.4630,
                -0.3554 * t + 0.4275,
                -0.0227 * t + 5.3251,
                0.1206 * t - 2.5771,
                -0.0670 * t + 0.3703,
            ],
        ]
        .map(|perez| {
            let of = |d: Vec3| distribution(perez, d.z, d.dot(self.sun));
            of(d) / of(Vec3::Z)
        });
        let [x, y, luminance] = [self.zenith[0] * x, self.zenith[1] * y, self.zenith[2] * luminance];
        Vec3::new(x / y, 1.0, (1.0 - x - y) / y) * luminance.max(0.0)
    }

    /// XYZ of the sun's disc, Y in kcd/m².
    pub fn sun(&self) -> Vec3 {
        let planck = |nm: f32| ((SUN_C2_OVER_T / nm).exp() - 1.0).recip() * (nm / 560.0).powi(-5);
        let (mut seen, mut outside) = (Vec3::ZERO, 0.0);
        for nm in cie::nodes() {
            let light = cie::matching(nm) * planck(nm);
            seen += light * self.transmittance(nm);
            outside += light.y;
        }
        let steradians = PI * SUN_RADIUS_DEG.to_radians().sin().powi(2);
        seen / outside * SUN_KLX / steradians
    }

    /// Share of the sun's light that comes through molecules, dust and ozone.
    fn transmittance(&self, nm: f32) -> f32 {
        let sin = self.sun.z.clamp(0.0, 1.0);
        let zenith_deg = sin.acos().to_degrees();
        let air = 1.0 / (sin + 0.15 * (93.885 - zenith_deg).powf(-1.253));
        let um = nm / 1000.0;
        let dust = 0.046_083_66 * self.turbidity - 0.045_860_26;
        let at = ((nm - 380.0) / 10.0).clamp(0.0, 35.0);
        let i = (at as usize).min(34);
        let ozone = OZONE_PER_CM[i] + (OZONE_PER_CM[i + 1] - OZONE_PER_CM[i]) * (at - i as f32);
        let depth = 0.008_735 * um.powf(-4.08) + dust * um.powf(-1.3) + ozone * OZONE_CM;
        (-depth * air).exp()
    }
}

/// The five-parameter distribution of R. Perez, R. Seals and J. Michalsky, *Solar Energy* 50 (1993) 235.
///
/// - `cos_theta`: of the angle to the zenith; `cos_gamma`: of that to the sun
fn distribution([a, b, c, d, e]: [f32; 5], cos_theta: f32, cos_gamma: f32) -> f32 {
    let gamma = cos_gamma.clamp(-1.0, 1.0).acos();
    let toward_horizon = 1.0 + a * (b / cos_theta.max(0.01)).exp();
    toward_horizon * (1.0 + c * (d * gamma).exp() + e * gamma.cos().powi(2))
}
