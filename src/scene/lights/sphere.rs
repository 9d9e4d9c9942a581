//! The sphere: a globe that shines all round.

use super::{EmissionSample, Emitter, LightSample, LightType};
use crate::sampling::warps;
use crate::scene::PhotonGuide;
use glam::{Mat3, Vec3};
use std::f32::consts::{PI, TAU};
use std::sync::Arc;

/// `at`, `radius`.
pub static KIND: LightType = LightType {
    name: "sphere",
    about: "a globe that shines all round: at, radius",
    read: |entry, place| {
        let radius = entry.radius(place)?;
        Ok(Arc::new(Sphere { centre: entry.position(place)?, radius }))
    },
};

/// A globe.
#[derive(Debug, Clone, Copy)]
pub struct Sphere {
    /// Its centre.
    pub centre: Vec3,
    /// Its radius.
    pub radius: f32,
}

impl Emitter for Sphere {
    fn intersect(&self, origin: Vec3, direction: Vec3) -> Option<(f32, Option<Vec3>)> {
        let to = self.centre - origin;
        let along = to.dot(direction);
        let apart2 = (to - direction * along).length_squared();
        let half2 = self.radius * self.radius - apart2;
        let t = along - half2.max(0.0).sqrt();
        (half2 >= 0.0 && t > 0.0).then_some((t, Some(Vec3::ONE)))
    }

    fn sample_li(&self, point: Vec3, _: Vec3, u: [f32; 2]) -> Option<LightSample> {
        let to = self.centre - point;
        let sin2 = self.radius * self.radius / to.length_squared();
        if sin2 >= 1.0 {
            return None;
        }
        // 1 − cos without the loss of digits for a small or distant globe
        let cap = sin2 / (1.0 + (1.0 - sin2).sqrt());
        let direction = warps::to_world(to.normalize(), warps::uniform_cone(u, 1.0 - cap));
        let along = to.dot(direction);
        let apart2 = (to - direction * along).length_squared();
        let distance = along - (self.radius * self.radius - apart2).max(0.0).sqrt();
        Some(LightSample { direction, distance, radiance_over_pdf: Vec3::splat(TAU * cap) })
    }

    fn sample_le(&self, aim: &PhotonGuide, [s, t, pick, u, v]: [f32; 5]) -> Option<EmissionSample> {
        let (z, phi) = (1.0 - 2.0 * s, TAU * t);
        let r = (1.0 - z * z).max(0.0).sqrt();
        let normal = Vec3::new(r * phi.cos(), r * phi.sin(), z);
        let point = self.centre + normal * self.radius;
        let (direction, weight) = aim.direction(point, normal, 1.0, pick, [u, v])?;
        Some(EmissionSample {
            point,
            direction,
            power: Vec3::splat(4.0 * PI * PI * self.radius.powi(2) * weight),
        })
    }

    fn importance(&self, aim: &PhotonGuide) -> f32 {
        let toward = aim.targets.first().map_or(Vec3::Z, |t| (t.centre - self.centre).normalize_or(Vec3::Z));
        PI * self.radius.powi(2) * aim.pdf(self.centre, toward)
    }

    /// π × 4πr².
    fn power(&self) -> Option<f32> {
        Some(4.0 * PI * PI * self.radius * self.radius)
    }

    fn turned(&self, turn: Mat3, about: Vec3) -> Arc<dyn Emitter> {
        Arc::new(Sphere { centre: about + turn * (self.centre - about), ..*self })
    }
}
