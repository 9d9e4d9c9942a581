//! Intersection of rays with a scene: surfaces, lights and stones.

use crate::scene::{Light, Scene, Surface};
use glam::Vec3;

/// What a ray in the world meets first.
#[derive(Debug, Clone, Copy)]
pub enum Intersection {
    /// A surface.
    Surface(SurfacePoint),
    /// A light: its number, and the colour its emitter shows; black behind it, which takes in all light.
    Light(usize, Vec3),
    /// A stone: its number, and how the ray arrives.
    Stone(usize, StoneHit),
    /// Nothing: the ray sees what shines from infinity, [`Scene::distant_lights`].
    None,
}

/// A point of a surface, on one of its sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// Number of the surface.
    pub surface: usize,
    /// The place.
    pub point: Vec3,
    /// Unit normal on that side.
    pub normal: Vec3,
    /// Whether the side is the surface's front.
    pub front: bool,
}

/// What a ray has just left. A stone, a light and a quad are convex and cannot be met again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Past {
    /// None of these.
    Nothing,
    /// The stone of this number.
    Stone(usize),
    /// The surface of this number; the ray starts at [`Scene::start`].
    Surface(usize),
    /// The light of this number.
    Light(usize),
}

/// A ray at a stone's surface, in its trace frame.
#[derive(Debug, Clone, Copy)]
pub struct StoneHit {
    /// The facet.
    pub facet: usize,
    /// The place.
    pub point: Vec3,
    /// Unit direction.
    pub direction: Vec3,
}

/// A shadow ray sees a light that is not nearer than this share of the way to it.
const SHADOW_RAY_SHARE: f32 = 1.0 - 1e-4;
/// A lamp may lie in a surface: light that leaves it does not meet what is nearer than this share of its
/// distance from the origin, in which rounding decides what lies before and behind.
const MIN_DISTANCE_SHARE: f32 = 1e-5;

impl Scene {
    /// Interactions with facets inside a stone after which a path is too long for the scene.
    ///
    /// - `others`: segments of the path that lie outside the stone
    pub fn max_bounces(&self, others: u32) -> u32 {
        self.depth.map_or(u32::MAX, |depth| depth.saturating_sub(others).max(1))
    }

    /// The first intersection of a ray of light.
    ///
    /// - `origin`, `direction` (unit): world frame
    /// - `past`: what the ray has just left
    pub fn intersect(&self, origin: Vec3, direction: Vec3, past: Past) -> Intersection {
        self.nearest_intersection(origin, direction, past, false)
    }

    /// The first thing that the camera sees along a ray, straight or by mirrors: backs of quads and of
    /// lamps are cut away, so that it can look into a room from outside.
    pub fn intersect_seen(&self, origin: Vec3, direction: Vec3, past: Past) -> Intersection {
        self.nearest_intersection(origin, direction, past, true)
    }

    fn nearest_intersection(
        &self,
        origin: Vec3,
        direction: Vec3,
        past: Past,
        cut_away: bool,
    ) -> Intersection {
        let mut nearest = f32::INFINITY;
        let mut event = Intersection::None;
        for (i, surface) in self.surfaces.iter().enumerate() {
            let Some(near) = self.min_distance(i, origin, past) else { continue };
            let Some(hit) = surface.intersect(origin, direction, near) else { continue };
            let hidden = cut_away && !hit.front && surface.shape.as_quad().is_some();
            if hit.distance < nearest && !hidden {
                nearest = hit.distance;
                let point = origin + direction * hit.distance;
                event = Intersection::Surface(SurfacePoint {
                    surface: i,
                    point,
                    normal: hit.normal,
                    front: hit.front,
                });
            }
        }
        for (i, light) in self.lights.iter().enumerate().filter(|(i, _)| Past::Light(*i) != past) {
            let Some((t, colour)) = light.emitter.intersect(origin, direction) else { continue };
            if t < nearest && !(cut_away && colour.is_none()) {
                nearest = t;
                event = Intersection::Light(i, colour.unwrap_or(Vec3::ZERO));
            }
        }
        for (i, placed) in self.stones.iter().enumerate().filter(|(i, _)| Past::Stone(*i) != past) {
            let (o, d) = (placed.point_to_stone(origin), placed.direction_to_stone(direction));
            if let Some(hit) = placed.stone.intersect(o, d).filter(|h| h.distance * placed.radius < nearest) {
                nearest = hit.distance * placed.radius;
                event = Intersection::Stone(
                    i,
                    StoneHit { facet: hit.facet, point: o + d * hit.distance, direction: d },
                );
            }
        }
        event
    }

    /// Where a ray that leaves a surface starts.
    pub fn start(&self, at: &SurfacePoint) -> Vec3 {
        self.surfaces[at.surface].start(at.point, at.normal)
    }

    /// The distance from which on a ray can meet a surface; none if it cannot.
    fn min_distance(&self, surface: usize, origin: Vec3, past: Past) -> Option<f32> {
        match past {
            Past::Surface(s) if s == surface && self.surfaces[s].shape.as_quad().is_some() => None,
            Past::Light(_) => Some(MIN_DISTANCE_SHARE * origin.abs().max_element()),
            _ => Some(0.0),
        }
    }

    /// Every light that shines from infinity along a ray that meets nothing, and the colour seen there:
    /// none hides another.
    pub fn distant_lights(&self, direction: Vec3) -> impl Iterator<Item = (&Light, Vec3)> {
        let far = self.lights.iter().filter(|light| light.emitter.is_far());
        far.filter_map(move |light| Some((light, light.emitter.intersect(Vec3::ZERO, direction)?.1?)))
    }

    /// Irradiance that comes straight from one light at a place, unoccluded rays only: as a colour
    /// for [`Light::radiance_at`].
    ///
    /// - `light`: its number
    /// - `places`: pairs of uniforms, one for each shadow ray
    pub fn direct_irradiance(
        &self,
        light: usize,
        at: &SurfacePoint,
        places: impl IntoIterator<Item = [f32; 2]>,
    ) -> Vec3 {
        self.direct_light(light, at, places, |_| 1.0)
    }

    /// The same with light from each direction weighted.
    ///
    /// - `weight`: of light that goes in a direction (unit): [`super::Bsdf::eval`] gives the light that is
    ///   scattered, as the irradiance of a Lambertian surface that would scatter as much
    pub fn direct_light(
        &self,
        light: usize,
        at: &SurfacePoint,
        places: impl IntoIterator<Item = [f32; 2]>,
        weight: impl Fn(Vec3) -> f32,
    ) -> Vec3 {
        let from = SurfacePoint { point: self.start(at), ..*at };
        let (mut sum, mut count) = (Vec3::ZERO, 0);
        for u in places {
            count += 1;
            let seen = self.lights[light].emitter.sample_li(from.point, at.normal, u);
            let Some(light_sample) = seen else { continue };
            let cos = at.normal.dot(light_sample.direction);
            if cos > 0.0
                && !self.is_occluded(
                    &from,
                    light_sample.direction,
                    light_sample.distance * SHADOW_RAY_SHARE,
                    light,
                )
            {
                sum += light_sample.radiance_over_pdf * cos * weight(-light_sample.direction);
            }
        }
        sum / count.max(1) as f32
    }

    /// Whether anything stands in the way of a shadow ray to a light.
    ///
    /// - `from`: its start
    fn is_occluded(&self, from: &SurfacePoint, direction: Vec3, distance: f32, light: usize) -> bool {
        let by_stone = self.stones.iter().any(|placed| {
            let (o, d) = (placed.point_to_stone(from.point), placed.direction_to_stone(direction));
            placed.stone.intersect(o, d).is_some_and(|h| h.distance * placed.radius < distance)
        });
        let by_surface = |(i, surface): (usize, &Surface)| {
            let near = self.min_distance(i, from.point, Past::Surface(from.surface));
            let hit = near.and_then(|near| surface.intersect(from.point, direction, near));
            hit.is_some_and(|hit| hit.distance < distance)
        };
        let by_lamp = |(i, other): (usize, &Light)| {
            let lamp = i != light && !other.emitter.is_far();
            lamp && other.emitter.intersect(from.point, direction).is_some_and(|(t, _)| t < distance)
        };
        by_stone
            || self.surfaces.iter().enumerate().any(by_surface)
            || self.lights.iter().enumerate().any(by_lamp)
    }
}
