//! The entry of a scene file for a light, and how it becomes one.

use super::panorama::Panorama;
use super::scene_file::BuildContext;
use super::schema::{FieldError, field_error, positive, require_name, span, turned};
use crate::color::daylight::ClearSky;
use crate::color::viewers::{VIEWERS, Viewer};
use glam::{Mat3, Vec3};
use serde::Deserialize;

/// `[[light]]`
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct LightEntry {
    pub(super) kind: String,
    pub(super) at: Option<[f32; 3]>,
    pub(super) to: Option<[f32; 3]>,
    pub(super) side: Option<f32>,
    pub(super) radius: Option<f32>,
    pub(super) cone: Option<f32>,
    pub(super) viewer: Option<String>,
    pub(super) panorama: Option<String>,
    pub(super) sun_elevation: Option<f32>,
    pub(super) sun_azimuth: Option<f32>,
    pub(super) turbidity: Option<f32>,
    pub(super) turn: Option<[f64; 3]>,
    pub(super) radiance: Option<f32>,
    pub(super) power: Option<f32>,
    pub(super) colour: Option<[f32; 3]>,
    pub(super) spectrum: Option<String>,
}

impl LightEntry {
    /// Whether it shows a panorama.
    pub(super) fn has_panorama(&self) -> bool {
        self.panorama.is_some()
    }

    /// Its place.
    pub(super) fn position(&self, place: &BuildContext) -> Result<Vec3, FieldError> {
        self.at.map(|p| place.point(p)).ok_or_else(|| field_error("at", "at is missing"))
    }

    /// Its target; the first stone if the entry has none.
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
        let sky = Panorama::open(&path, place.limits).map_err(|e| field_error("panorama", e))?;
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

    /// Its rotation.
    pub(super) fn turned(&self) -> Mat3 {
        turned(self.turn).as_mat3()
    }
}
