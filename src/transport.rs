//! Paths through a scene: what a ray meets, and how light goes through a stone.

pub mod crossing;

use crate::scene::{Light, Scene};
use glam::Vec3;

/// What a ray in the world meets first.
#[derive(Debug, Clone, Copy)]
pub enum Event {
    /// A surface: its number, the place, and its unit normal on the ray's side.
    Surface(usize, Vec3, Vec3),
    /// The shining side of a light: its number, and the colour its emitter shows.
    Light(usize, Vec3),
    /// A stone: its number, and how the ray arrives.
    Stone(usize, Arrival),
    /// Nothing.
    Nothing,
}

/// A ray at a stone's surface, in its walking frame.
#[derive(Debug, Clone, Copy)]
pub struct Arrival {
    /// The facet.
    pub facet: usize,
    /// The place.
    pub point: Vec3,
    /// Unit direction.
    pub direction: Vec3,
}

/// A shadow ray sees a light that is not nearer than this share of the way to it.
const ALL_THE_WAY: f32 = 1.0 - 1e-4;

impl Scene {
    /// Meetings with facets inside a stone after which a path is too long for the scene.
    ///
    /// - `others`: segments of the path that lie outside the stone
    pub fn most_meetings(&self, others: u32) -> u32 {
        self.depth.map_or(u32::MAX, |depth| depth.saturating_sub(others).max(1))
    }

    /// The first meeting of a ray.
    ///
    /// - `origin`, `direction` (unit): world frame
    /// - `past`: the stone that the ray has just left, which is convex and cannot be met again
    pub fn first(&self, origin: Vec3, direction: Vec3, past: Option<usize>) -> Event {
        let mut nearest = f32::INFINITY;
        let mut event = Event::Nothing;
        for (i, surface) in self.surfaces.iter().enumerate() {
            if let Some((t, normal)) = surface.hit(origin, direction).filter(|h| h.0 < nearest) {
                nearest = t;
                event = Event::Surface(i, origin + direction * t, normal);
            }
        }
        for (i, light) in self.lights.iter().enumerate() {
            if let Some((t, colour)) = light.emitter.hit(origin, direction).filter(|h| h.0 < nearest) {
                nearest = t;
                event = Event::Light(i, colour);
            }
        }
        for (i, placed) in self.stones.iter().enumerate().filter(|(i, _)| Some(*i) != past) {
            let (o, d) = (placed.point_to_stone(origin), placed.direction_to_stone(direction));
            if let Some(hit) = placed.stone.hit(o, d).filter(|h| h.distance * placed.radius < nearest) {
                nearest = hit.distance * placed.radius;
                event =
                    Event::Stone(i, Arrival { facet: hit.facet, point: o + d * hit.distance, direction: d });
            }
        }
        event
    }

    /// Irradiance that comes straight from one light at a place, unoccluded rays only: as a colour
    /// for [`Light::at`].
    ///
    /// - `places`: pairs of uniforms, one for each shadow ray
    pub fn direct_irradiance(
        &self,
        light: &Light,
        point: Vec3,
        normal: Vec3,
        places: impl IntoIterator<Item = [f32; 2]>,
    ) -> Vec3 {
        let (mut sum, mut count) = (Vec3::ZERO, 0);
        for u in places {
            count += 1;
            let Some(glimpse) = light.emitter.seen_from(point, normal, u) else { continue };
            let cos = normal.dot(glimpse.direction);
            if cos > 0.0 && !self.hidden(point, glimpse.direction, glimpse.distance * ALL_THE_WAY) {
                sum += glimpse.radiance * cos;
            }
        }
        sum / count.max(1) as f32
    }

    /// Whether a stone or a surface stands in the way of a shadow ray.
    fn hidden(&self, point: Vec3, direction: Vec3, distance: f32) -> bool {
        let by_stone = self.stones.iter().any(|placed| {
            let (o, d) = (placed.point_to_stone(point), placed.direction_to_stone(direction));
            placed.stone.hit(o, d).is_some_and(|h| h.distance * placed.radius < distance)
        });
        by_stone || self.surfaces.iter().any(|s| s.hides(point, direction, distance))
    }
}
