//! The entry of a scene file for a light, and how it becomes one.

use super::entries::{Wrong, illuminant, named, positive, span, turned, wrong};
use super::file::Place;
use super::lights::{Kind, LIGHTS};
use super::panorama::Panorama;
use super::{Aim, Ball, Light, PlacedStone};
use crate::optics::daylight::ClearSky;
use crate::optics::rgb;
use crate::optics::viewers::{VIEWERS, Viewer};
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
    pub(super) fn light_outside(&self, place: &Place, stones: &[PlacedStone]) -> Result<Light, Wrong> {
        let light = self.light(place)?;
        if light.emitter.power().is_none() {
            return Ok(light); // it is at infinity
        }
        /// Places of the light that are looked at, a side of the square of uniforms.
        const GRID: u8 = 8;
        let world = Ball { centre: place.centre, radius: 1.0 };
        let aim = Aim { targets: Vec::new(), share: 0.0, world };
        let shares = (0..GRID)
            .flat_map(|y| (0..GRID).map(move |x| [x, y].map(|k| (f32::from(k) + 0.5) / f32::from(GRID))));
        let begin: Vec<Vec3> = shares
            .filter_map(|[s, t]| light.emitter.leave(&aim, [s, t, 0.5, 0.5, 0.5]))
            .map(|start| start.point)
            .chain(self.at.map(|p| place.point(p)))
            .collect();
        match stones.iter().position(|stone| begin.iter().any(|at| stone.contains(*at))) {
            Some(i) => Err(wrong("at", format!("the light reaches into stone {}", i + 1))),
            None => Ok(light),
        }
    }

    fn light(&self, place: &Place) -> Result<Light, Wrong> {
        let all: Vec<&str> = LIGHTS.iter().map(|k| k.name).collect();
        let kind = named("kind", Kind::named(&self.kind), &self.kind, &all)?;
        let emitter = (kind.read)(self, place)?;
        let radiance = match (self.radiance, self.power, emitter.power()) {
            (radiance, None, _) => positive("radiance", radiance)?,
            (None, power, Some(of_one)) => positive("power", power)? / of_one,
            (None, Some(_), None) => return Err(wrong("power", "a light at infinity has a radiance")),
            (Some(_), Some(_), _) => return Err(wrong("power", "a light has a radiance or a power")),
        };
        if radiance > BRIGHTEST || radiance.is_nan() {
            let key = if self.power.is_some() { "power" } else { "radiance" };
            return Err(wrong(key, format!("{key} makes a radiance of {radiance:e}, beyond {BRIGHTEST:e}")));
        }
        if let Some(colour) = self.colour
            && (colour.iter().any(|part| *part < 0.0) || colour.iter().all(|part| *part == 0.0))
        {
            return Err(wrong(
                "colour",
                "a colour is [red, green, blue], none below 0 and not all of them 0",
            ));
        }
        let colour = self.colour.map_or(Vec3::ONE, |c| rgb::mixture(c.into()));
        Ok(Light::new(emitter, illuminant("spectrum", self.spectrum.as_deref())?, colour * radiance))
    }

    /// Whether it shows a panorama.
    pub(super) fn has_panorama(&self) -> bool {
        self.panorama.is_some()
    }

    /// Its place.
    pub(super) fn at(&self, place: &Place) -> Result<Vec3, Wrong> {
        self.at.map(|p| place.point(p)).ok_or_else(|| wrong("at", "at is missing"))
    }

    /// What it shines at, the first stone unless it says.
    pub(super) fn to(&self, place: &Place) -> Result<Vec3, Wrong> {
        let to = self.to.map_or(place.centre, |p| place.point(p));
        if self.at(place)?.distance(to) < 1e-6 {
            let key = if self.to.is_some() { "to" } else { "at" };
            return Err(wrong(key, "the light stands where it shines to"));
        }
        Ok(to)
    }

    /// Its side, in the world.
    pub(super) fn side(&self, place: &Place) -> Result<f32, Wrong> {
        span("side", self.side, place)
    }

    /// Its radius, in the world.
    pub(super) fn radius(&self, place: &Place) -> Result<f32, Wrong> {
        span("radius", self.radius, place)
    }

    /// The full angle of its cone, degrees.
    pub(super) fn cone_deg(&self) -> Result<f32, Wrong> {
        match positive("cone", self.cone)? {
            deg if (0.01..=180.0).contains(&deg) => Ok(deg),
            deg => Err(wrong("cone", format!("cone = {deg} is not from 0.01 to 180 degrees"))),
        }
    }

    /// The viewer it is, if any.
    pub(super) fn viewer(&self) -> Result<Option<&'static Viewer>, Wrong> {
        let all: Vec<&str> = VIEWERS.iter().map(|v| v.name).collect();
        self.viewer.as_deref().map(|name| named("viewer", Viewer::named(name), name, &all)).transpose()
    }

    /// The panorama it shows, if any.
    pub(super) fn panorama(&self, place: &Place) -> Result<Option<Panorama>, Wrong> {
        let Some(file) = &self.panorama else { return Ok(None) };
        let path = match place.panorama {
            Some(path) => path.to_owned(),
            None => place.files.find("panorama", file)?,
        };
        let sky = Panorama::open(&path).map_err(|e| wrong("panorama", e))?;
        place.count_pixels(sky.pixel_count()).map_err(|e| wrong("panorama", e.to_string()))?;
        Ok(Some(sky))
    }

    /// The clear sky that it is a part of.
    pub(super) fn clear_sky(&self) -> Result<ClearSky, Wrong> {
        let within = |key: &'static str, value: Option<f32>, low: f32, high: f32| match value {
            Some(x) if (low..=high).contains(&x) => Ok(x),
            Some(x) => Err(wrong(key, format!("{key} = {x} is not from {low} to {high}"))),
            None => Err(wrong(key, format!("{key} is missing"))),
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
