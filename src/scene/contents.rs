//! A scene ready to be traced: surfaces, lights, stones, camera.

use super::camera::Camera;
use super::lights::Light;
use super::photon_guide::{BoundingSphere, PhotonGuide};
use super::stone_instance::PlacedStone;
use super::surface::Surface;
use glam::Vec3;

/// A scene ready to be traced.
///
/// ```
/// use cutlab::{RenderRequest, Scene, Stone};
///
/// let request = RenderRequest::scene("table")?.stone(&Stone::parse("oval")?);
/// let scene: Scene = request.build(&request.scene_file()?, (640, 480))?;
/// assert_eq!(scene.stones.len(), 1);
/// assert!(scene.has_caustics()); // the stone throws light on the table
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Scene {
    /// Its name.
    pub name: String,
    /// Surfaces.
    pub surfaces: Vec<Surface>,
    /// Light sources.
    pub lights: Vec<Light>,
    /// The stones.
    pub stones: Vec<PlacedStone>,
    /// The view.
    pub camera: Camera,
    /// Most segments of a path from the eye to a light; none follows each to the end of its power.
    pub depth: Option<u32>,
    /// Whether the camera leaves the background out: what it sees directly of lights, of surfaces that are
    /// backdrops, and of nothing at all is transparent. Stones still mirror and refract all of it.
    pub cut_out: bool,
}

impl Scene {
    /// Whether light can fall on a diffuse surface last from a stone or a mirror.
    pub fn has_caustics(&self) -> bool {
        let mirrors = self.surfaces.iter().filter(|s| s.finish.is_delta()).count();
        mirrors < self.surfaces.len() && (mirrors > 0 || !self.stones.is_empty())
    }

    /// Whether light can go straight from one place of a diffuse surface to another: a quad alone
    /// does not shine on itself.
    pub fn has_indirect_light(&self) -> bool {
        let mut diffuse = self.surfaces.iter().filter(|s| !s.finish.is_delta());
        match (diffuse.next(), diffuse.next()) {
            (Some(one), None) => one.shape.as_quad().is_none(),
            (one, _) => one.is_some(),
        }
    }

    /// Targets of photons: the stones, and spheres around each that double in width up to the whole world.
    /// What lies within r of a stone sends it light as 1/r², so each of them matters about as much as the
    /// next; without one, a photon that lands there by chance counts for very many.
    ///
    /// - `share`: of photons sent at any of them
    pub fn photon_guide(&self, share: f32) -> PhotonGuide {
        let stones: Vec<BoundingSphere> = self.stones.iter().map(PlacedStone::bounding_sphere).collect();
        let corners =
            |b: &BoundingSphere| [b.centre - Vec3::splat(b.radius), b.centre + Vec3::splat(b.radius)];
        let mut points: Vec<Vec3> = stones.iter().flat_map(corners).collect();
        points.extend(self.surfaces.iter().flat_map(|s| <[Vec3; 2]>::from(s.bounds())));
        let low = points.iter().copied().fold(Vec3::INFINITY, Vec3::min);
        let high = points.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
        let world = BoundingSphere { centre: 0.5 * (low + high), radius: 0.5 * low.distance(high) };
        let wider = |b: &BoundingSphere| {
            Some(BoundingSphere { radius: 2.0 * b.radius, ..*b }).filter(|b| b.radius < world.radius)
        };
        let targets = stones.iter().flat_map(|b| std::iter::successors(Some(*b), wider)).collect();
        PhotonGuide { share: if stones.is_empty() { 0.0 } else { share }, targets, world }
    }
}
