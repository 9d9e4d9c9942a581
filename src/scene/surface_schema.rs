//! The entry of a scene file for a surface, and its reflectance.

use super::Reflectance;
use super::field_error::{FieldError, field_error};
use crate::color::rgb_upsampling;
use glam::Vec3;
use serde::Deserialize;

/// A reflectance as written.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
enum ReflectanceEntry {
    Grey(f32),
    Rgb([f32; 3]),
    Edge { low: f32, high: f32, edge: f32 },
}

/// `[[surface]]`
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SurfaceEntry {
    pub(super) corner: Option<[f32; 3]>,
    pub(super) u: Option<[f32; 3]>,
    pub(super) v: Option<[f32; 3]>,
    pub(super) mesh: Option<String>,
    pub(super) at: Option<[f32; 3]>,
    pub(super) turn: Option<[f64; 3]>,
    pub(super) scale: Option<f32>,
    reflectance: ReflectanceEntry,
    #[serde(default)]
    pub(super) mirror: bool,
    pub(super) backdrop: Option<bool>,
}

impl SurfaceEntry {
    /// Its reflectance.
    pub(super) fn reflectance(&self) -> Result<Reflectance, FieldError> {
        let stated = match self.reflectance {
            ReflectanceEntry::Grey(r) => [r; 3],
            ReflectanceEntry::Rgb(rgb) => rgb,
            ReflectanceEntry::Edge { low, high, .. } => [low, high, low],
        };
        if let Some(r) = stated.iter().find(|r| !(0.0..=1.0).contains(*r)) {
            return Err(field_error(
                "reflectance",
                format!("a reflectance lies between 0 and 1, not at {r}"),
            ));
        }
        Ok(match self.reflectance {
            ReflectanceEntry::Grey(r) => Reflectance::Grey(r),
            ReflectanceEntry::Rgb(rgb) => {
                Reflectance::Mixture(rgb_upsampling::upsample(rgb.into()).min(Vec3::ONE))
            }
            ReflectanceEntry::Edge { low, high, edge } => Reflectance::Edge { low, high, edge_nm: edge },
        })
    }
}
