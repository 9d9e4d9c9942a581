//! A light: its emitter, spectrum and radiance, and the kinds that scene files name.

use super::super::PhotonGuide;
use super::super::light_schema::LightEntry;
use super::super::scene_file::BuildContext;
use super::super::schema::FieldError;
use crate::color::{Illuminant, rgb_upsampling};
use glam::{Mat3, Vec3};
use std::fmt::Debug;
use std::sync::Arc;

/// Shape of a light and how it shines, at radiance 1. Colours are parts of
/// [`crate::color::rgb_upsampling::basis`]; white is 1, 1, 1.
pub trait Emitter: Debug + Send + Sync {
    /// Distance along a ray to the light and the colour seen there; no colour from behind, where it is
    /// dark. A light at infinity is at `f32::INFINITY`.
    ///
    /// The origin may lie on the light itself only if the ray does not start there: every light is
    /// convex, so a ray that leaves it cannot meet it again.
    fn intersect(&self, origin: Vec3, direction: Vec3) -> Option<(f32, Option<Vec3>)>;

    /// Samples a place of the light as seen from a point, for shadow rays.
    ///
    /// - `normal`: of the surface at the point; `u`: two uniforms
    fn sample_li(&self, point: Vec3, normal: Vec3, u: [f32; 2]) -> Option<LightSample>;

    /// Samples a photon's first ray.
    ///
    /// - `u`: five uniforms
    fn sample_le(&self, aim: &PhotonGuide, u: [f32; 5]) -> Option<EmissionSample>;

    /// Importance: about the power sent at the targets of `aim`, or into the world if it has none. Photons
    /// are divided among lights by it.
    fn importance(&self, aim: &PhotonGuide) -> f32;

    /// Power emitted; none for a light at infinity.
    fn power(&self) -> Option<f32>;

    /// Whether it shines from infinity: then it occludes no other light.
    fn is_far(&self) -> bool {
        self.power().is_none()
    }

    /// The light turned about a point.
    fn turned(&self, turn: Mat3, about: Vec3) -> Arc<dyn Emitter>;
}

/// A place of a light, seen from a surface.
#[derive(Debug, Clone, Copy)]
pub struct LightSample {
    /// Unit direction to it.
    pub direction: Vec3,
    /// How far away it is.
    pub distance: f32,
    /// Its colour over the density of the direction (per steradian): the mean over light samples,
    /// weighted by the cosine at the surface, is the irradiance.
    pub radiance_over_pdf: Vec3,
}

/// A photon's first ray.
#[derive(Debug, Clone, Copy)]
pub struct EmissionSample {
    /// Origin, world frame.
    pub point: Vec3,
    /// Unit direction.
    pub direction: Vec3,
    /// Power: the mean over starts is the power emitted.
    pub power: Vec3,
}

/// A light of a scene.
#[derive(Debug, Clone)]
pub struct Light {
    /// Shape.
    pub emitter: Arc<dyn Emitter>,
    /// Spectrum.
    pub spectrum: Arc<Illuminant>,
    /// Radiance as a mixture of colours of the spectrum; grey for a light of the spectrum alone.
    /// Scaled so that a grey light has the luminance of equal-energy light of that radiance.
    pub radiance: Vec3,
}

impl Light {
    /// A light of equal energy.
    pub fn white(emitter: impl Emitter + 'static, radiance: f32) -> Light {
        Light::new(Arc::new(emitter), Illuminant::equal_energy(), Vec3::splat(radiance))
    }

    /// A light of any spectrum.
    ///
    /// - `radiance`: that of equal-energy light of the same luminance
    pub fn new(emitter: Arc<dyn Emitter>, spectrum: Arc<Illuminant>, radiance: Vec3) -> Light {
        Light { emitter, radiance: radiance / spectrum.luminance(), spectrum }
    }

    /// The light turned about a point.
    pub fn turned(&self, turn: Mat3, about: Vec3) -> Light {
        Light { emitter: self.emitter.turned(turn, about), ..self.clone() }
    }

    /// Radiance or power at `nm` of a colour that the emitter gave.
    pub fn radiance_at(&self, colour: Vec3, nm: f32) -> f32 {
        let colour = colour * self.radiance;
        if colour == Vec3::ZERO {
            0.0
        } else if colour == Vec3::splat(colour.x) {
            self.spectrum.power(nm) * colour.x // the parts add up to 1
        } else {
            self.spectrum.power(nm) * rgb_upsampling::basis(nm).dot(colour)
        }
    }
}

/// Makes a light's shape of its entry.
pub type LightReader = fn(&LightEntry, &BuildContext) -> Result<Arc<dyn Emitter>, FieldError>;

/// A kind of light.
pub struct LightType {
    /// Its name in scene files.
    pub name: &'static str,
    /// What it is, and what its entry states.
    pub about: &'static str,
    /// Makes one of its entry.
    pub read: LightReader,
}
