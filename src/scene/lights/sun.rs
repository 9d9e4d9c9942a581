//! The sun: a small disc, far away, as bright and as yellow as the air leaves it.

use super::sky::parts;
use super::{EmissionSample, Emitter, LightSample, LightType};
use crate::color::daylight::SUN_RADIUS_DEG;
use crate::sampling::warps;
use crate::scene::PhotonGuide;
use glam::{Mat3, Vec3};
use std::f32::consts::PI;
use std::sync::Arc;

/// `sun-elevation`, `sun-azimuth`, `turbidity`.
pub static KIND: LightType = LightType {
    name: "sun",
    about: "the sun at sun-elevation, sun-azimuth (degrees) through air of turbidity 2 to 10; radiance 1 counts in kcd/m²",
    read: |entry, _| {
        let sky = entry.clear_sky()?;
        Ok(Arc::new(Sun { direction: sky.sun, colour: parts(sky.sun()) }))
    },
};

/// A disc at infinity.
#[derive(Debug, Clone, Copy)]
pub struct Sun {
    /// Unit direction to its middle.
    pub direction: Vec3,
    /// Radiance as parts of [`crate::color::rgb_upsampling::basis`].
    pub colour: Vec3,
}

fn sin2() -> f32 {
    SUN_RADIUS_DEG.to_radians().sin().powi(2)
}

impl Sun {
    /// A direction to a place of it; all are as likely.
    fn place(&self, u: [f32; 2]) -> Vec3 {
        let across = warps::uniform_disc(u) * sin2().sqrt();
        warps::to_world(self.direction, across.extend((1.0 - across.length_squared()).sqrt()))
    }

    /// Irradiance of a surface that faces it.
    fn irradiance(&self) -> Vec3 {
        self.colour * (PI * sin2())
    }
}

impl Emitter for Sun {
    fn intersect(&self, _: Vec3, direction: Vec3) -> Option<(f32, Option<Vec3>)> {
        // by the sine: the cosine of so small an angle has no digits left
        let within = direction.cross(self.direction).length_squared() <= sin2();
        (within && direction.dot(self.direction) > 0.0).then_some((f32::INFINITY, Some(self.colour)))
    }

    fn sample_li(&self, _: Vec3, normal: Vec3, u: [f32; 2]) -> Option<LightSample> {
        let direction = self.place(u);
        let radiance = self.irradiance();
        (direction.dot(normal) > 0.0).then_some(LightSample {
            direction,
            distance: f32::INFINITY,
            radiance_over_pdf: radiance,
        })
    }

    fn sample_le(&self, aim: &PhotonGuide, [s, t, pick, u, v]: [f32; 5]) -> Option<EmissionSample> {
        let from = self.place([s, t]);
        let (point, area) = aim.beam(-from, pick, [u, v]);
        Some(EmissionSample { point, direction: -from, power: self.irradiance() * area })
    }

    fn importance(&self, aim: &PhotonGuide) -> f32 {
        self.irradiance().element_sum() / 3.0 * aim.area()
    }

    fn power(&self) -> Option<f32> {
        None
    }

    fn turned(&self, turn: Mat3, _: Vec3) -> Arc<dyn Emitter> {
        Arc::new(Sun { direction: turn * self.direction, ..*self })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::kronecker::KroneckerPoints;
    use crate::sampling::random::Purpose;

    /// [D] Irradiance is π sin² of the radius × the cosine; every direction drawn hits the disc, and
    /// shares of rings about its middle are those of their areas (χ² with 9 degrees of freedom).
    #[test]
    fn it_is_an_even_disc_of_its_size() {
        let direction = Vec3::new(0.48, -0.6, 0.64);
        let sun = Sun { direction, colour: Vec3::splat(1e6) };
        let n = 10_000;
        let (mut seen, mut rings) = (0.0, [0.0; 10]);
        for u in KroneckerPoints::<2>::new(1, Purpose::TEST, 0, 0..n) {
            let light_sample = sun.sample_li(Vec3::ZERO, Vec3::Z, u.map(|x| x as f32)).expect("above");
            // a hair less for the roundness of f32
            let toward = warps::to_world(direction, Vec3::Z).lerp(light_sample.direction, 0.999).normalize();
            assert!(sun.intersect(Vec3::ZERO, toward).is_some());
            seen += f64::from(light_sample.radiance_over_pdf.y * light_sample.direction.z) / n as f64;
            let share = light_sample.direction.cross(direction).length_squared() / sin2();
            rings[((share * 10.0) as usize).min(9)] += 1.0;
        }
        let expected =
            1e6 * std::f64::consts::PI * f64::from(SUN_RADIUS_DEG).to_radians().sin().powi(2) * 0.64;
        assert!((seen / expected - 1.0).abs() < 1e-4, "{seen} {expected}");
        let even = n as f64 / 10.0;
        let chi2: f64 = rings.iter().map(|r: &f64| (r - even).powi(2) / even).sum();
        assert!(chi2 < 27.9, "{chi2}: {rings:?}");
        assert!(sun.intersect(Vec3::ZERO, -direction).is_none());
    }
}
