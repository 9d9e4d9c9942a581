//! Lights: the catalogue of lights, one kind a file.

pub mod disc;
pub mod dome;
mod light;
pub mod sky;
pub mod sphere;
pub mod spot;
pub mod square;
pub mod sun;

use super::PhotonGuide;
use super::light_schema::LightEntry;
use super::named_data::illuminant;
use super::scene_file::BuildContext;
use super::schema::FieldError;
use super::schema::{field_error, positive, require_name};
use super::{BoundingSphere, PlacedStone};
use crate::color::rgb_upsampling;
use glam::Vec3;
pub use light::{EmissionSample, Emitter, Light, LightReader, LightSample, LightType};

/// Every kind of light.
pub static LIGHTS: &[&LightType] =
    &[&square::KIND, &disc::KIND, &sphere::KIND, &dome::KIND, &spot::KIND, &sky::KIND, &sun::KIND];

impl LightType {
    /// The kind called `name`.
    pub fn by_name(name: &str) -> Option<&'static LightType> {
        LIGHTS.iter().copied().find(|k| crate::parse::is_name(k.name, name))
    }
}

/// Greatest radiance: squares and sums of it stay far within `f32`.
const BRIGHTEST: f32 = 1e12;

impl LightEntry {
    /// The light, if no part of it lies in a stone.
    pub(super) fn light_outside(
        &self,
        place: &BuildContext,
        stones: &[PlacedStone],
    ) -> Result<Light, FieldError> {
        let light = self.light(place)?;
        if light.emitter.power().is_none() {
            return Ok(light); // it is at infinity
        }
        /// Places of the light that are tested, along a side of the square of uniforms.
        const GRID: u8 = 8;
        let world = BoundingSphere { centre: place.centre, radius: 1.0 };
        let aim = PhotonGuide { targets: Vec::new(), share: 0.0, world };
        let shares = (0..GRID)
            .flat_map(|y| (0..GRID).map(move |x| [x, y].map(|k| (f32::from(k) + 0.5) / f32::from(GRID))));
        let begin: Vec<Vec3> = shares
            .filter_map(|[s, t]| light.emitter.sample_le(&aim, [s, t, 0.5, 0.5, 0.5]))
            .map(|start| start.point)
            .chain(self.at.map(|p| place.point(p)))
            .collect();
        match stones.iter().position(|stone| begin.iter().any(|at| stone.contains(*at))) {
            Some(i) => Err(field_error("at", format!("the light reaches into stone {}", i + 1))),
            None => Ok(light),
        }
    }

    fn light(&self, place: &BuildContext) -> Result<Light, FieldError> {
        let all: Vec<&str> = LIGHTS.iter().map(|k| k.name).collect();
        let kind = require_name("kind", LightType::by_name(&self.kind), &self.kind, &all)?;
        let emitter = (kind.read)(self, place)?;
        let radiance = match (self.radiance, self.power, emitter.power()) {
            (radiance, None, _) => positive("radiance", radiance)?,
            (None, power, Some(of_one)) => positive("power", power)? / of_one,
            (None, Some(_), None) => return Err(field_error("power", "a light at infinity has a radiance")),
            (Some(_), Some(_), _) => return Err(field_error("power", "a light has a radiance or a power")),
        };
        if radiance > BRIGHTEST || radiance.is_nan() {
            let key = if self.power.is_some() { "power" } else { "radiance" };
            return Err(field_error(
                key,
                format!("{key} makes a radiance of {radiance:e}, beyond {BRIGHTEST:e}"),
            ));
        }
        if let Some(colour) = self.colour
            && (colour.iter().any(|part| *part < 0.0) || colour.iter().all(|part| *part == 0.0))
        {
            return Err(field_error(
                "colour",
                "a colour is [red, green, blue], none below 0 and not all of them 0",
            ));
        }
        let colour = self.colour.map_or(Vec3::ONE, |c| rgb_upsampling::upsample(c.into()));
        Ok(Light::new(
            emitter,
            illuminant("spectrum", self.spectrum.as_deref(), place.files, place.limits)?,
            colour * radiance,
        ))
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
    use std::sync::Arc;

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
            let mut stream = Stream::new(3, Purpose::TEST, 0);
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
        let mut stream = Stream::new(4, Purpose::TEST, 0);
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
