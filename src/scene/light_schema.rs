//! The entry of a scene file for a light, and how it becomes one.

use super::lights::{LIGHTS, LightType};
use super::panorama::Panorama;
use super::scene_file::BuildContext;
use super::schema::{FieldError, field_error, illuminant, positive, require_name, span, turned};
use super::{BoundingSphere, Light, PhotonGuide, PlacedStone};
use crate::color::daylight::ClearSky;
use crate::color::rgb_upsampling;
use crate::color::viewers::{VIEWERS, Viewer};
use glam::{Mat3, Vec3};
use serde::Deserialize;

/// Greatest radiance: squares and sums of it stay far within `f32`.
const BRIGHTEST: f32 = 1e12;

/// `[[light]]`
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct LightEntry {
    kind: String,
    at: Option<[f32; 3]>,
    to: Option<[f32; 3]>,
    side: Option<f32>,
    radius: Option<f32>,
    cone: Option<f32>,
    viewer: Option<String>,
    pub(super) panorama: Option<String>,
    sun_elevation: Option<f32>,
    sun_azimuth: Option<f32>,
    turbidity: Option<f32>,
    turn: Option<[f64; 3]>,
    radiance: Option<f32>,
    power: Option<f32>,
    colour: Option<[f32; 3]>,
    spectrum: Option<String>,
}

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
        /// Places of the light that are looked at, a side of the square of uniforms.
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
        Ok(Light::new(emitter, illuminant("spectrum", self.spectrum.as_deref())?, colour * radiance))
    }

    /// Whether it shows a panorama.
    pub(super) fn has_panorama(&self) -> bool {
        self.panorama.is_some()
    }

    /// Its place.
    pub(super) fn position(&self, place: &BuildContext) -> Result<Vec3, FieldError> {
        self.at.map(|p| place.point(p)).ok_or_else(|| field_error("at", "at is missing"))
    }

    /// What it shines at, the first stone unless it says.
    pub(super) fn to(&self, place: &BuildContext) -> Result<Vec3, FieldError> {
        let to = self.to.map_or(place.centre, |p| place.point(p));
        if self.position(place)?.distance(to) < 1e-6 {
            let key = if self.to.is_some() { "to" } else { "at" };
            return Err(field_error(key, "the light stands where it shines to"));
        }
        Ok(to)
    }

    /// Its side, in the world.
    pub(super) fn side(&self, place: &BuildContext) -> Result<f32, FieldError> {
        span("side", self.side, place)
    }

    /// Its radius, in the world.
    pub(super) fn radius(&self, place: &BuildContext) -> Result<f32, FieldError> {
        span("radius", self.radius, place)
    }

    /// The full angle of its cone, degrees.
    pub(super) fn cone_deg(&self) -> Result<f32, FieldError> {
        match positive("cone", self.cone)? {
            deg if (0.01..=180.0).contains(&deg) => Ok(deg),
            deg => Err(field_error("cone", format!("cone = {deg} is not from 0.01 to 180 degrees"))),
        }
    }

    /// The viewer it is, if any.
    pub(super) fn viewer(&self) -> Result<Option<&'static Viewer>, FieldError> {
        let all: Vec<&str> = VIEWERS.iter().map(|v| v.name).collect();
        self.viewer
            .as_deref()
            .map(|name| require_name("viewer", Viewer::by_name(name), name, &all))
            .transpose()
    }

    /// The panorama it shows, if any.
    pub(super) fn panorama(&self, place: &BuildContext) -> Result<Option<Panorama>, FieldError> {
        let Some(file) = &self.panorama else { return Ok(None) };
        let path = match place.panorama {
            Some(path) => path.to_owned(),
            None => place.files.find("panorama", file)?,
        };
        let sky = Panorama::open(&path).map_err(|e| field_error("panorama", e))?;
        place.count_pixels(sky.pixel_count()).map_err(|e| field_error("panorama", e.to_string()))?;
        Ok(Some(sky))
    }

    /// The clear sky that it is a part of.
    pub(super) fn clear_sky(&self) -> Result<ClearSky, FieldError> {
        let within = |key: &'static str, value: Option<f32>, low: f32, high: f32| match value {
            Some(x) if (low..=high).contains(&x) => Ok(x),
            Some(x) => Err(field_error(key, format!("{key} = {x} is not from {low} to {high}"))),
            None => Err(field_error(key, format!("{key} is missing"))),
        };
        Ok(ClearSky::new(
            within("sun-elevation", self.sun_elevation, 0.0, 90.0)?,
            within("sun-azimuth", self.sun_azimuth, -360.0, 360.0)?,
            within("turbidity", Some(self.turbidity.unwrap_or(3.0)), 2.0, 10.0)?,
        ))
    }

    /// How it is turned.
    pub(super) fn turned(&self) -> Mat3 {
        turned(self.turn).as_mat3()
    }
}
