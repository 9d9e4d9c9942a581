//! Build context of a scene's entries: unit, files, overrides.

use super::Pose;
use super::file_access::Files;
use crate::design::Design;
use crate::limits::{self, Exceeded, Limits};
use crate::materials::Material;
use crate::trace::ConvexStone;
use glam::Vec3;
use std::cell::Cell;
use std::path::{Path, PathBuf};

/// Overrides of a scene's stones and light. A field that is none leaves what the scene has.
#[derive(Debug, Clone, Default)]
pub struct SceneOverrides {
    /// Stones, for the scene's places in order.
    pub designs: Vec<Design>,
    /// Materials of single stones, before that of all.
    pub materials: Vec<Option<Material>>,
    /// Material of all.
    pub material: Option<Material>,
    /// Girdle width of all, mm.
    pub size_mm: Option<f64>,
    /// Pose of all.
    pub pose: Option<Pose>,
    /// Whether light keeps its polarisation from facet to facet; it does if neither this nor the scene
    /// says.
    pub polarisation: Option<bool>,
    /// The panorama of every light that shows one.
    pub panorama: Option<PathBuf>,
    /// Whether the scene may name files outside its own folder.
    pub allow_outside: bool,
    /// Whether the camera leaves the background out: [`super::Scene::cut_out`].
    pub cut_out: bool,
    /// The most that is read of the files that the scene names.
    pub limits: Limits,
}

/// Context in which entries become parts of a scene.
pub struct BuildContext<'a> {
    /// World length of one of the file's units.
    pub unit: f32,
    /// Where files that the scene names are looked for.
    pub files: &'a Files,
    /// The panorama in place of those that the scene names.
    pub panorama: Option<&'a Path>,
    /// Centre of the first stone; the origin where there is none.
    pub centre: Vec3,
    /// The most that is read of anything.
    pub limits: Limits,
    /// Triangles and pixels of the files that were read for the scene so far.
    pub(super) read: [Cell<usize>; 2],
}

impl BuildContext<'_> {
    /// A length of the file in the world.
    pub fn length(&self, l: f32) -> f32 {
        l * self.unit
    }

    /// Counts the triangles of a mesh that was read.
    pub fn count_triangles(&self, n: usize) -> Result<(), Exceeded> {
        self.read[0].update(|sum| sum.saturating_add(n));
        self.limits.check(&limits::SCENE_TRIANGLES, self.read[0].get())
    }

    /// Counts the pixels of a panorama that was read.
    pub fn count_pixels(&self, n: usize) -> Result<(), Exceeded> {
        self.read[1].update(|sum| sum.saturating_add(n));
        self.limits.check(&limits::SCENE_PIXELS, self.read[1].get())
    }

    /// A point of the file in the world.
    pub fn point(&self, p: [f32; 3]) -> Vec3 {
        Vec3::from_array(p) * self.unit
    }
}

/// The greatest number in a scene: what is beyond it has no digits left in `f32` for a stone.
pub(super) const GREATEST: f64 = 1e9;

/// A stone of the tracer at its size.
pub(super) fn stone_to_trace(design: Design, size_mm: Option<f64>) -> Result<ConvexStone, String> {
    let design = match size_mm {
        Some(mm) => design.sized(mm).map_err(|e| e.to_string())?,
        None => design,
    };
    Ok(ConvexStone::new(design.solid().map_err(|e| e.to_string())?))
}
