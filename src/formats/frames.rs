//! The frame that each design format's own program expects: where the origin stands and how large the
//! design is. Shapes are kept; sizes are not, because no such format has a unit.

use super::error::FormatError;
use crate::design::{Design, LengthUnit};
use crate::materials::Material;
use glam::DVec3;
use std::borrow::Cow;

/// Largest absolute coordinate of a design written for the GemCad family, whose programs cut the stone
/// out of a cube of rough of ±2 to ±2.2 units: the median of 1,943 public designs.
const GEMCAD_LARGEST: f64 = 1.1;

/// A design without unit whose largest coordinate lies in this range keeps its distances: nearly all
/// public designs do (0.73 to 1.54).
const GEMCAD_USUAL: std::ops::RangeInclusive<f64> = 0.73..=1.5;

/// Every plane is at least this part of the farthest one's distance away from the origin: GemCad leaves
/// out a facet through the origin, and its binary form stores 1/distance.
const NEAREST: f64 = 1e-6;

/// The design in GemCad's frame: the origin inside the stone, the largest coordinate near 1.1.
pub fn for_gemcad(design: &Design) -> Result<Cow<'_, Design>, FormatError> {
    let solid =
        |d: &Design| d.solid().map_err(|cause| FormatError::Solid { file: design.name.clone(), cause });
    let before = solid(design)?;
    let (low, high) = before.bounds();
    let inside = |shift: DVec3| is_inside(design, shift);
    let (_, centre) = before.volume_and_centre();
    let shift = if inside(DVec3::ZERO) { DVec3::ZERO } else { -centre };
    let largest = (low + shift).abs().max((high + shift).abs()).max_element();
    let keeps_size = design.unit == LengthUnit::Free && GEMCAD_USUAL.contains(&largest);
    let scale = if keeps_size { 1.0 } else { GEMCAD_LARGEST / largest };
    if shift == DVec3::ZERO && scale == 1.0 {
        return Ok(Cow::Borrowed(design));
    }
    Ok(Cow::Owned(placed(design, shift, scale)))
}

/// The design with its origin inside: as it is, or else moved to its centre of volume.
pub fn about_origin(design: &Design) -> Result<Cow<'_, Design>, FormatError> {
    if is_inside(design, DVec3::ZERO) {
        return Ok(Cow::Borrowed(design));
    }
    let solid = design.solid().map_err(|cause| FormatError::Solid { file: design.name.clone(), cause })?;
    Ok(Cow::Owned(placed(design, -solid.volume_and_centre().1, 1.0)))
}

/// The design in Gem Cut Studio's frame: max(|x|, |y|) = 1 and z from −h to h, as in all public files.
pub fn for_gem_cut_studio(design: &Design) -> Result<Design, FormatError> {
    let solid = design.solid().map_err(|cause| FormatError::Solid { file: design.name.clone(), cause })?;
    let (low, high) = solid.bounds();
    let level = DVec3::new(0.0, 0.0, -0.5 * (low.z + high.z));
    let (_, centre) = solid.volume_and_centre();
    let aside = DVec3::new(-centre.x, -centre.y, level.z);
    let shift = if is_inside(design, level) { level } else { aside };
    let across = (low + shift).abs().max((high + shift).abs()).truncate().max_element();
    Ok(placed(design, shift, across.recip()))
}

/// The index of refraction that a design file states: the one that the design was drawn for, or
/// diamond's to three decimals if none is known.
pub fn index_drawn_for(design: &Design) -> f64 {
    design.refractive_index.unwrap_or_else(|| stated(Material::diamond()))
}

/// The design as drawn for that material's index, to three decimals.
pub fn drawn_for(design: &Design, material: &Material) -> Design {
    Design { refractive_index: Some(stated(material)), ..design.clone() }
}

fn stated(material: &Material) -> f64 {
    (1e3 * material.index_d()).round() / 1e3
}

/// Whether the origin lies well inside the design once that is moved by `shift`.
fn is_inside(design: &Design, shift: DVec3) -> bool {
    let distances = || design.facets().map(|f| f.plane.moved(shift).distance);
    let farthest = distances().map(f64::abs).fold(0.0, f64::max);
    distances().all(|d| d >= NEAREST * farthest)
}

/// The design moved, then scaled about the origin.
fn placed(design: &Design, shift: DVec3, scale: f64) -> Design {
    let mut design = design.clone();
    for facet in design.tiers.iter_mut().flat_map(|t| &mut t.facets) {
        facet.plane = facet.plane.moved(shift).scaled(scale);
    }
    design
}
