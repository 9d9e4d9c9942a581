//! The polygons of a changed design's facets: which of them became others.

use super::changed_design::{ChangedDesign, size};
use super::error::FormatError;
use crate::design::Design;
use crate::geometry::Polyhedron;
use crate::geometry::polyhedron::PlaneStatus;
use glam::DVec3;

/// Corners that moved by less, in parts of the stone's size, stay as the file has them.
const SAME_CORNER: f64 = 1e-12;

/// The solids before and after.
pub struct ChangedPolygons {
    before: Polyhedron,
    after: Polyhedron,
    /// Corners that are nearer to each other are one.
    pub near: f64,
}

impl ChangedPolygons {
    /// - `file`: its name, for errors
    pub fn new(file: &str, changed: &ChangedDesign) -> Result<ChangedPolygons, FormatError> {
        let solid =
            |design: &Design| design.solid().map_err(|cause| FormatError::Solid { file: file.into(), cause });
        let near = SAME_CORNER * size(changed.before);
        Ok(ChangedPolygons { before: solid(changed.before)?, after: solid(&changed.after)?, near })
    }

    /// The corners of a facet, by its number in [`Design::facets`], counter-clockwise seen from outside, if they
    /// are others than before; empty if it no longer touches the stone.
    pub fn changed(&self, facet: usize) -> Option<Vec<DVec3>> {
        let (old, new) = (corners(&self.before, facet), corners(&self.after, facet));
        let n = new.len();
        let matches = |turn: usize| (0..n).all(|i| old[i].distance(new[(i + turn) % n]) <= self.near);
        let is_same = old.len() == n && (n == 0 || (0..n).any(matches));
        (!is_same).then_some(new)
    }
}

fn corners(solid: &Polyhedron, facet: usize) -> Vec<DVec3> {
    match solid.plane_status.get(facet) {
        Some(PlaneStatus::Facet(face)) => solid.polygon(*face).collect(),
        _ => Vec::new(),
    }
}
