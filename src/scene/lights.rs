//! Lights: the catalogue of what shines, one kind a file.

pub mod disc;
pub mod dome;
pub mod sky;
pub mod sphere;
pub mod spot;
pub mod square;
pub mod sun;

use super::PhotonGuide;
use super::light_schema::LightEntry;
use super::scene_file::BuildContext;
use super::schema::FieldError;
use crate::color::{Illuminant, rgb_upsampling};
use glam::{Mat3, Vec3};
use std::fmt::Debug;
use std::sync::Arc;

/// Shape of a light and how it shines, at radiance 1. Colours are parts of
/// [`crate::color::rgb_upsampling::basis`]; white is 1, 1, 1.
pub trait Emitter: Debug + Send + Sync {
    /// Distance along a ray to the light and the colour seen there; no colour from behind, where it is
    /// dark. What shines from infinity is at `f32::INFINITY`.
    ///
    /// The origin may lie on the light itself only if the ray does not start there: every light is
    /// convex, so a ray that leaves it cannot meet it again.
    fn intersect(&self, origin: Vec3, direction: Vec3) -> Option<(f32, Option<Vec3>)>;

    /// A place of the light as seen from a point, for shadow rays.
    ///
    /// - `normal`: of the surface at the point; `u`: two uniforms
    fn sample_li(&self, point: Vec3, normal: Vec3, u: [f32; 2]) -> Option<LightSample>;

    /// A photon's start.
    ///
    /// - `u`: five uniforms
    fn sample_le(&self, aim: &PhotonGuide, u: [f32; 5]) -> Option<EmissionSample>;

    /// Roughly the power sent at the targets of `aim`, or into the world if it has none: what
    /// decides how many photons a light gets.
    fn importance(&self, aim: &PhotonGuide) -> f32;

    /// Power emitted; none for a light at infinity.
    fn power(&self) -> Option<f32>;

    /// Whether it shines from infinity: then it stands in no other light's way.
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
    /// Where.
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
    pub spectrum: &'static Illuminant,
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
    pub fn new(emitter: Arc<dyn Emitter>, spectrum: &'static Illuminant, radiance: Vec3) -> Light {
        Light { emitter, spectrum, radiance: radiance / spectrum.luminance() }
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

/// Every kind of light.
pub static LIGHTS: &[&LightType] =
    &[&square::KIND, &disc::KIND, &sphere::KIND, &dome::KIND, &spot::KIND, &sky::KIND, &sun::KIND];

impl LightType {
    /// The kind called `name`.
    pub fn by_name(name: &str) -> Option<&'static LightType> {
        LIGHTS.iter().copied().find(|k| crate::parse::is_name(k.name, name))
    }
}

#[cfg(test)]
mod tests {
    use super::disc::Disc;
    use super::dome::Dome;
    use super::sphere::Sphere;
    use super::square::Square;
    use super::sun::Sun;
    use super::*;
    use crate::sampling::random::{Purpose, Stream};
    use crate::scene::photon_guide::BoundingSphere;
    use std::f32::consts::PI;

    fn every_kind() -> Vec<(&'static str, Arc<dyn Emitter>)> {
        let at = Vec3::new(0.3, -0.2, 4.0);
        vec![
            ("square", Arc::new(Square::facing(at, Vec3::ZERO, 1.0))),
            ("disc", Arc::new(Disc::facing(at, Vec3::ZERO, 0.6, 90.0))),
            ("spot", Arc::new(Disc::facing(at, Vec3::ZERO, 0.6, 20.0))),
            ("sphere", Arc::new(Sphere { centre: at, radius: 0.6 })),
            ("dome", Arc::new(Dome::uniform())),
            ("sun", Arc::new(Sun { direction: Vec3::new(0.0, 0.6, 0.8), colour: Vec3::ONE })),
        ]
    }

    /// [D] What a light throws on a small target by photons, aimed or not, is what shadow rays see
    /// there; and the power of all photons is the closed form.
    #[test]
    fn photons_and_shadow_rays_agree_and_power_has_its_closed_form() {
        let target = BoundingSphere { centre: Vec3::ZERO, radius: 0.5 };
        let world = BoundingSphere { centre: Vec3::ZERO, radius: 2.0 };
        for (name, light) in every_kind() {
            let mut stream = Stream::new(3, Purpose::Test, 0);
            let n = 100_000;
            // irradiance on the disc z = 0, |xy| < 0.3, facing up, times its area
            let mut seen = 0.0f64;
            for _ in 0..n {
                let at = (crate::sampling::warps::uniform_disc(stream.pair()) * 0.3).extend(0.0);
                if let Some(g) = light.sample_li(at, Vec3::Z, stream.pair()) {
                    let cos = g.direction.z.max(0.0);
                    seen += f64::from(g.radiance_over_pdf.y * cos * PI * 0.09) / f64::from(n);
                }
            }
            for share in [0.0, 0.5] {
                let aim = PhotonGuide { targets: vec![target], share, world };
                let (mut caught, mut all, mut hits) = (0.0f64, 0.0f64, 0);
                for _ in 0..n {
                    let u = std::array::from_fn(|_| stream.unit());
                    let Some(start) = light.sample_le(&aim, u) else { continue };
                    all += f64::from(start.power.y) / f64::from(n);
                    let t = -start.point.z / start.direction.z;
                    let at = start.point + start.direction * t;
                    if start.direction.z < 0.0 && t > 0.0 && at.truncate().length() < 0.3 {
                        caught += f64::from(start.power.y) / f64::from(n);
                        hits += 1;
                    }
                }
                // powers of hits differ by less than a factor of two
                let tolerance = 4.0 * 1.2 / f64::from(hits).sqrt() + 0.005;
                assert!((caught / seen - 1.0).abs() < tolerance, "{name} {share}: {caught} {seen}");
                if let Some(power) = light.power() {
                    assert!((all / f64::from(power) - 1.0).abs() < 0.03, "{name} {share}: {all} {power}");
                }
            }
        }
    }

    /// A lamp stands in the way from both sides, or is at infinity.
    #[test]
    fn lamps_are_dark_behind() {
        for (name, light) in every_kind() {
            let from = Vec3::new(0.3, -0.2, 9.0);
            match light.intersect(from, Vec3::new(0.01, 0.02, -1.0).normalize()) {
                Some((t, colour)) if t.is_finite() => {
                    assert_eq!(colour.is_some(), name == "sphere", "{name}: {colour:?}");
                    assert!(!light.is_far());
                }
                _ => assert!(light.is_far(), "{name}"),
            }
        }
    }

    #[test]
    fn what_a_light_sample_sees_is_there() {
        let mut stream = Stream::new(4, Purpose::Test, 0);
        for (name, light) in every_kind() {
            for _ in 0..1000 {
                let point = Vec3::new(stream.unit(), stream.unit(), 0.0);
                let Some(g) = light.sample_li(point, Vec3::Z, stream.pair()) else { continue };
                let (t, colour) = light.intersect(point, g.direction).expect(name);
                assert!(t == g.distance || (t - g.distance).abs() < 1e-3, "{name}: {t} {}", g.distance);
                assert!(colour.expect("its front").y > 0.0 || g.radiance_over_pdf.y == 0.0);
            }
        }
    }
}
