//! The disc light: it shines from one side, as the cosine within a cone.

use super::square::sample_area;
use super::{EmissionSample, Emitter, LightSample, LightType};
use crate::sampling::warps;
use crate::scene::PhotonGuide;
use glam::{Mat3, Vec3};
use std::f32::consts::PI;
use std::sync::Arc;

/// `at`, `to`, `radius`.
pub static KIND: LightType = LightType {
    name: "disc",
    about: "a disc that shines from one side: at, to, radius",
    read: |entry, place| {
        let radius = entry.radius(place)?;
        Ok(Arc::new(Disc::facing(entry.position(place)?, entry.to(place)?, radius, 90.0)))
    },
};

/// A disc that shines from one side.
#[derive(Debug, Clone, Copy)]
pub struct Disc {
    centre: Vec3,
    normal: Vec3,
    radius: f32,
    /// Squared sine of the half-angle of its cone: 1 shines everywhere.
    sin2: f32,
}

impl Disc {
    /// A disc around `centre` that shines toward `target`.
    ///
    /// - `half_deg`: half-angle of its cone, 90 for a diffuse disc; its radiance is the same in all
    ///   directions within
    pub fn facing(centre: Vec3, target: Vec3, radius: f32, half_deg: f32) -> Disc {
        let sin2 = half_deg.min(90.0).to_radians().sin().powi(2);
        Disc { centre, normal: (target - centre).normalize(), radius, sin2 }
    }

    fn area(&self) -> f32 {
        PI * self.radius * self.radius
    }

    fn shines(&self, cos: f32) -> bool {
        cos > 0.0 && cos * cos >= 1.0 - self.sin2
    }

    fn place(&self, u: [f32; 2]) -> Vec3 {
        self.centre + warps::to_world(self.normal, (warps::uniform_disc(u) * self.radius).extend(0.0))
    }
}

impl Emitter for Disc {
    fn intersect(&self, origin: Vec3, direction: Vec3) -> Option<(f32, Option<Vec3>)> {
        let toward = -self.normal.dot(direction);
        let t = -self.normal.dot(self.centre - origin) / toward;
        let within = (origin + direction * t).distance_squared(self.centre) <= self.radius * self.radius;
        let colour = if self.shines(toward) { Vec3::ONE } else { Vec3::ZERO };
        (t > 0.0 && within).then_some((t, (toward > 0.0).then_some(colour)))
    }

    fn sample_li(&self, point: Vec3, _: Vec3, u: [f32; 2]) -> Option<LightSample> {
        let light_sample = sample_area(point, self.place(u), self.normal, self.area())?;
        self.shines(-self.normal.dot(light_sample.direction)).then_some(light_sample)
    }

    fn sample_le(&self, aim: &PhotonGuide, [s, t, pick, u, v]: [f32; 5]) -> Option<EmissionSample> {
        let point = self.place([s, t]);
        let (direction, weight) = aim.direction(point, self.normal, self.sin2, pick, [u, v])?;
        Some(EmissionSample { point, direction, power: Vec3::splat(PI * self.area() * self.sin2 * weight) })
    }

    fn importance(&self, aim: &PhotonGuide) -> f32 {
        self.area() * aim.pdf(self.centre, self.normal).min(PI * self.sin2)
    }

    /// π sin² × area.
    fn power(&self) -> Option<f32> {
        Some(PI * self.area() * self.sin2)
    }

    fn turned(&self, turn: Mat3, about: Vec3) -> Arc<dyn Emitter> {
        let centre = about + turn * (self.centre - about);
        Arc::new(Disc { centre, normal: turn * self.normal, ..*self })
    }
}
