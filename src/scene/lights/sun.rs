//! The sun: a small disc, far away, as bright and as yellow as the air leaves it.

use super::sky::parts;
use super::{Emitter, Glimpse, Kind, Start};
use crate::math::sample;
use crate::optics::daylight::SUN_RADIUS_DEG;
use crate::scene::Aim;
use glam::{Mat3, Vec3};
use std::f32::consts::PI;
use std::sync::Arc;

/// `sun-elevation`, `sun-azimuth`, `turbidity`.
pub static KIND: Kind = Kind {
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
    /// Radiance as parts of [`crate::optics::rgb::basis`].
    pub colour: Vec3,
}

fn sin2() -> f32 {
    SUN_RADIUS_DEG.to_radians().sin().powi(2)
}

impl Sun {
    /// A direction to a place of it; all are as likely.
    fn place(&self, u: [f32; 2]) -> Vec3 {
        let across = sample::disc(u) * sin2().sqrt();
        sample::about(self.direction, across.extend((1.0 - across.length_squared()).sqrt()))
    }

    /// Irradiance of a surface that faces it.
    fn irradiance(&self) -> Vec3 {
        self.colour * (PI * sin2())
    }
}

impl Emitter for Sun {
    fn hit(&self, _: Vec3, direction: Vec3) -> Option<(f32, Option<Vec3>)> {
        // by the sine: the cosine of so small an angle has no digits left
        let within = direction.cross(self.direction).length_squared() <= sin2();
        (within && direction.dot(self.direction) > 0.0).then_some((f32::INFINITY, Some(self.colour)))
    }

    fn seen_from(&self, _: Vec3, normal: Vec3, u: [f32; 2]) -> Option<Glimpse> {
        let direction = self.place(u);
        let radiance = self.irradiance();
        (direction.dot(normal) > 0.0).then_some(Glimpse { direction, distance: f32::INFINITY, radiance })
    }

    fn leave(&self, aim: &Aim, [s, t, pick, u, v]: [f32; 5]) -> Option<Start> {
        let from = self.place([s, t]);
        let (point, area) = aim.beam(-from, pick, [u, v]);
        Some(Start { point, direction: -from, power: self.irradiance() * area })
    }

    fn reach(&self, aim: &Aim) -> f32 {
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
    use crate::math::points::Points;
    use crate::math::random::Purpose;

    /// [D] Irradiance is π sin² of the radius × the cosine; every direction drawn hits the disc, and
    /// shares of rings about its middle are those of their areas (χ² with 9 degrees of freedom).
    #[test]
    fn it_is_an_even_disc_of_its_size() {
        let direction = Vec3::new(0.48, -0.6, 0.64);
        let sun = Sun { direction, colour: Vec3::splat(1e6) };
        let n = 10_000;
        let (mut seen, mut rings) = (0.0, [0.0; 10]);
        for u in Points::<2>::new(1, Purpose::Test, 0, 0..n) {
            let glimpse = sun.seen_from(Vec3::ZERO, Vec3::Z, u.map(|x| x as f32)).expect("above");
            // a hair less for the roundness of f32
            let toward = sample::about(direction, Vec3::Z).lerp(glimpse.direction, 0.999).normalize();
            assert!(sun.hit(Vec3::ZERO, toward).is_some());
            seen += f64::from(glimpse.radiance.y * glimpse.direction.z) / n as f64;
            let share = glimpse.direction.cross(direction).length_squared() / sin2();
            rings[((share * 10.0) as usize).min(9)] += 1.0;
        }
        let expected =
            1e6 * std::f64::consts::PI * f64::from(SUN_RADIUS_DEG).to_radians().sin().powi(2) * 0.64;
        assert!((seen / expected - 1.0).abs() < 1e-4, "{seen} {expected}");
        let even = n as f64 / 10.0;
        let chi2: f64 = rings.iter().map(|r: &f64| (r - even).powi(2) / even).sum();
        assert!(chi2 < 27.9, "{chi2}: {rings:?}");
        assert!(sun.hit(Vec3::ZERO, -direction).is_none());
    }
}
