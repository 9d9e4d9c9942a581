//! The sky of a clear day without its sun, and below the horizon a ground in the light of both.

use super::LightType;
use super::dome::Dome;
use crate::color::cie;
use crate::color::daylight::{ClearSky, SUN_RADIUS_DEG};
use crate::color::rgb_upsampling;
use crate::scene::panorama::Panorama;
use glam::{Mat3, Vec3};
use std::f32::consts::PI;
use std::sync::Arc;

/// `sun-elevation`, `sun-azimuth`, `turbidity`.
pub static KIND: LightType = LightType {
    name: "sky",
    about: "the clear sky around a sun at sun-elevation, sun-azimuth (degrees), turbidity 2 to 10; radiance 1 counts in kcd/m²",
    read: |entry, _| Ok(Arc::new(Dome::showing(panorama(&entry.clear_sky()?), Mat3::IDENTITY))),
};

/// Pixels of the table of the sky: a third of a degree each.
const SIZE: (usize, usize) = (1024, 512);

/// Reflectance of the ground below the horizon: grass, earth, paving.
const GROUND: f32 = 0.2;

/// Parts of [`rgb_upsampling::basis`] that look like an XYZ colour where the light's own spectrum looks white.
pub(super) fn parts(xyz: Vec3) -> Vec3 {
    rgb_upsampling::upsample(cie::srgb_matrix() * xyz)
}

/// The sky as a table from which directions are drawn.
fn panorama(sky: &ClearSky) -> Panorama {
    // irradiance on the ground, over π
    let mut light = sky.sun() * sky.sun.z * SUN_RADIUS_DEG.to_radians().sin().powi(2);
    let (across, down) = (64, 32);
    for i in 0..across * down {
        // equal shares of the ground as the sky's light falls on it
        let (sin2, phi) =
            (((i / across) as f32 + 0.5) / down as f32, 2.0 * PI * (i % across) as f32 / across as f32);
        let (z, r) = ((1.0 - sin2).sqrt(), sin2.sqrt());
        light += sky.sky(Vec3::new(r * phi.sin(), r * phi.cos(), z)) / (across * down) as f32;
    }
    let ground = parts(light * GROUND);
    let colour = |d: Vec3| if d.z > 0.0 { parts(sky.sky(d)) } else { ground };
    Panorama::painted(SIZE, colour, crc32fast::hash(format!("{sky:?}").as_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::kronecker::KroneckerPoints;
    use crate::sampling::random::Purpose;
    use crate::scene::lights::Emitter;

    /// [D] Irradiance by drawn directions is that by a quadrature of the model, on flat and tilted
    /// ground, with the tenth part of a fifth of it that the ground below sends up to a slope.
    #[test]
    fn drawn_directions_carry_the_light_of_the_model() {
        let sky = ClearSky::new(35.0, 120.0, 3.0);
        let dome = Dome::showing(panorama(&sky), Mat3::IDENTITY);
        for normal in [Vec3::Z, Vec3::new(0.6, 0.0, 0.8), Vec3::X] {
            let n = 400;
            let mut expected = 0.0;
            for i in 0..n * n {
                let z = ((i / n) as f32 + 0.5) / n as f32;
                let phi = 2.0 * PI * ((i % n) as f32 + 0.5) / n as f32;
                let r = (1.0 - z * z).sqrt();
                let d = Vec3::new(r * phi.sin(), r * phi.cos(), z);
                let from_ground = Vec3::new(d.x, d.y, -d.z);
                let cosines = [d, from_ground].map(|d| d.dot(normal).max(0.0));
                let parts = parts(sky.sky(d)) * cosines[0]
                    + dome.intersect(Vec3::ZERO, -Vec3::Z).and_then(|h| h.1).expect("all round") * cosines[1];
                expected += f64::from(parts.y) * 2.0 * f64::from(PI) / f64::from(n * n);
            }
            let n = 200_000;
            let places = KroneckerPoints::<2>::new(1, Purpose::TEST, 0, 0..n);
            let seen: f64 = places
                .filter_map(|u| dome.sample_li(Vec3::ZERO, normal, u.map(|x| x as f32)))
                .map(|g| f64::from(g.radiance_over_pdf.y * g.direction.dot(normal)) / n as f64)
                .sum();
            assert!((seen / expected - 1.0).abs() < 5e-3, "{normal}: {seen} {expected}");
        }
    }
}
