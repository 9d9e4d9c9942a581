//! Paths through a scene: what a ray meets, and how light goes through the stone.

pub mod crossing;

use crate::scene::Scene;
use glam::Vec3;

/// What a ray in the world meets first.
#[derive(Debug, Clone, Copy)]
pub enum Event {
    /// A diffuse surface: its number and the place.
    Surface(usize, Vec3),
    /// The shining side of a light: its number.
    Light(usize),
    /// The stone: the facet, the place in the walking frame, and the ray's direction there.
    Stone { facet: usize, point: Vec3, direction: Vec3 },
    /// Nothing.
    Nothing,
}

impl Scene {
    /// The first meeting of a ray.
    ///
    /// - `origin`, `direction` (unit): world frame
    /// - `past_stone`: the ray has just left the stone, which is convex and cannot be met again
    pub fn first(&self, origin: Vec3, direction: Vec3, past_stone: bool) -> Event {
        let mut nearest = f32::INFINITY;
        let mut event = Event::Nothing;
        for (i, surface) in self.surfaces.iter().enumerate() {
            if let Some(t) = surface.hit(origin, direction).filter(|t| *t < nearest) {
                nearest = t;
                event = Event::Surface(i, origin + direction * t);
            }
        }
        for (i, light) in self.lights.iter().enumerate() {
            if let Some(t) = light.hit(origin, direction).filter(|t| *t < nearest) {
                nearest = t;
                event = Event::Light(i);
            }
        }
        if !past_stone {
            let (o, d) = (self.stone.point_to_stone(origin), self.stone.direction_to_stone(direction));
            if let Some(hit) = self.stone.stone.hit(o, d).filter(|h| h.distance * self.stone.radius < nearest)
            {
                return Event::Stone { facet: hit.facet, point: o + d * hit.distance, direction: d };
            }
        }
        event
    }

    /// Irradiance that comes straight from the lights at a place, unoccluded ones only, at every
    /// wavelength (lights are of equal energy).
    ///
    /// - `strata`: each light is sampled at `strata`² jittered points
    /// - `jitter`: gives pairs of uniforms
    pub fn direct_irradiance(
        &self,
        point: Vec3,
        normal: Vec3,
        strata: usize,
        mut jitter: impl FnMut() -> [f32; 2],
    ) -> f32 {
        let mut sum = 0.0;
        for light in &self.lights {
            let weight = light.area() * light.radiance / (strata * strata) as f32;
            for i in 0..strata * strata {
                let u = jitter();
                let cell = [(i % strata) as f32, (i / strata) as f32];
                let st = [(cell[0] + u[0]) / strata as f32, (cell[1] + u[1]) / strata as f32];
                let to_light = light.point(st) - point;
                let distance2 = to_light.length_squared();
                let direction = to_light / distance2.sqrt();
                let cosines = normal.dot(direction).max(0.0) * (-light.normal().dot(direction)).max(0.0);
                if cosines > 0.0 && !self.stone_hides(point, direction) {
                    sum += weight * cosines / distance2;
                }
            }
        }
        sum
    }

    /// Whether the stone stands in the way of a shadow ray. Lights lie beyond the stone in every
    /// scene, and convex rooms hide nothing else.
    fn stone_hides(&self, point: Vec3, direction: Vec3) -> bool {
        let (o, d) = (self.stone.point_to_stone(point), self.stone.direction_to_stone(direction));
        self.stone.stone.hit(o, d).is_some()
    }
}
