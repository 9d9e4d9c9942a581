//! The dome: light from all directions, far away. Uniform, a gem viewer's bands, or a panorama.

use super::{EmissionSample, Emitter, LightSample, LightType};
use crate::color::viewers::Viewer;
use crate::sampling::warps;
use crate::scene::PhotonGuide;
use crate::scene::panorama::Panorama;
use glam::{Mat3, Vec3};
use std::f32::consts::{PI, TAU};
use std::sync::Arc;

/// Nothing, `viewer` or `panorama`.
pub static KIND: LightType = LightType {
    name: "dome",
    about: "light from everywhere: uniform, or viewer = NAME, or panorama = FILE (.hdr, .exr)",
    read: |entry, place| {
        let sky = match (entry.viewer()?, entry.panorama(place)?) {
            (Some(viewer), _) => Sky::Bands(viewer),
            (None, Some(panorama)) => Sky::Panorama(Arc::new(panorama)),
            (None, None) => Sky::Uniform,
        };
        Ok(Arc::new(Dome { sky, world_from_sky: entry.turned() }))
    },
};

/// A sphere of light at infinity.
#[derive(Debug, Clone)]
pub struct Dome {
    sky: Sky,
    world_from_sky: Mat3,
}

#[derive(Debug, Clone)]
enum Sky {
    Uniform,
    Bands(&'static Viewer),
    Panorama(Arc<Panorama>),
}

impl Dome {
    /// Radiance 1 from everywhere.
    pub fn uniform() -> Dome {
        Dome { sky: Sky::Uniform, world_from_sky: Mat3::IDENTITY }
    }

    /// A panorama's radiance from everywhere.
    pub fn showing(panorama: Panorama, world_from_sky: Mat3) -> Dome {
        Dome { sky: Sky::Panorama(Arc::new(panorama)), world_from_sky }
    }

    fn colour(&self, direction: Vec3) -> Vec3 {
        let d = self.world_from_sky.transpose() * direction;
        match &self.sky {
            Sky::Uniform => Vec3::ONE,
            Sky::Bands(viewer) => viewer.bands[viewer.band(d.z)].colour,
            Sky::Panorama(panorama) => panorama.colour(d),
        }
    }

    /// A direction to the sky and its colour over the density.
    fn draw(&self, u: [f32; 2]) -> (Vec3, Vec3) {
        if let Sky::Panorama(panorama) = &self.sky {
            let (d, colour) = panorama.sample(u);
            return (self.world_from_sky * d, colour);
        }
        let (z, phi) = (1.0 - 2.0 * u[0], TAU * u[1]);
        let r = (1.0 - z * z).max(0.0).sqrt();
        let direction = Vec3::new(r * phi.cos(), r * phi.sin(), z);
        (direction, self.colour(direction) * (4.0 * PI))
    }
}

impl Emitter for Dome {
    fn intersect(&self, _: Vec3, direction: Vec3) -> Option<(f32, Option<Vec3>)> {
        Some((f32::INFINITY, Some(self.colour(direction))))
    }

    fn sample_li(&self, _: Vec3, normal: Vec3, u: [f32; 2]) -> Option<LightSample> {
        let (direction, radiance) = match &self.sky {
            Sky::Panorama(_) => self.draw(u),
            _ => {
                let direction = warps::to_world(normal, warps::cosine_hemisphere(u));
                let density = warps::cosine_hemisphere_pdf(direction.dot(normal).max(1e-6));
                (direction, self.colour(direction) / density)
            }
        };
        (direction.dot(normal) > 0.0).then_some(LightSample {
            direction,
            distance: f32::INFINITY,
            radiance_over_pdf: radiance,
        })
    }

    fn sample_le(&self, aim: &PhotonGuide, [s, t, pick, u, v]: [f32; 5]) -> Option<EmissionSample> {
        let (from, colour) = self.draw([s, t]);
        let (point, area) = aim.beam(-from, pick, [u, v]);
        Some(EmissionSample { point, direction: -from, power: colour * area })
    }

    fn importance(&self, aim: &PhotonGuide) -> f32 {
        let mean = match &self.sky {
            Sky::Panorama(panorama) => panorama.mean(),
            _ => 1.0,
        };
        4.0 * PI * mean * aim.area()
    }

    fn power(&self) -> Option<f32> {
        None
    }

    fn turned(&self, turn: Mat3, _: Vec3) -> Arc<dyn Emitter> {
        Arc::new(Dome { sky: self.sky.clone(), world_from_sky: turn * self.world_from_sky })
    }
}
