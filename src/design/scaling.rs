//! Length to width: a design of tiers scaled along one axis, as faceters make ovals and rectangles of round and square
//! designs: every plane becomes its affine image, so what met in a point still does.

use super::families::CutError;
use super::families::fancy_brilliant::tiers_of;
use super::tiers::Design;
use crate::geometry::Plane;
use glam::DVec3;

/// The parameter that every cut of tiers takes.
pub const LENGTH_TO_WIDTH: &str = "length-to-width";

/// Least and greatest length to width.
const RANGE: (f64, f64) = (1.0, 6.0);

/// The design with `ratio` times the extent along y (toward the wheel's index 0 and its opposite)
/// that it has along x, which it keeps. Angles and indices follow; tiers are divided where their
/// facets no longer have one angle. Checked in `tests/library/cuts.rs`.
pub fn scale_length_to_width(design: Design, ratio: f64) -> Result<Design, CutError> {
    if !(RANGE.0..=RANGE.1).contains(&ratio) {
        let (from, to) = RANGE;
        return Err(CutError::OutOfRange { key: LENGTH_TO_WIDTH, value: ratio, unit: "", from, to });
    }
    let (low, high) = design.solid()?.bounds();
    let stretch = ratio * (high.x - low.x) / (high.y - low.y);
    if (stretch - 1.0).abs() < 1e-12 {
        return Ok(design);
    }
    let image = |p: &Plane| {
        let normal = p.normal * DVec3::new(1.0, stretch.recip(), 1.0);
        Plane { normal: normal.normalize(), distance: p.distance / normal.length() }
    };
    let gear = design.gear;
    let tiers = design.tiers.iter().flat_map(|tier| {
        let planes = tier.facets.iter().map(|f| image(&f.plane)).collect();
        let mut parts = tiers_of(&tier.name, gear, planes);
        parts.iter_mut().for_each(|part| part.instructions.clone_from(&tier.instructions));
        parts
    });
    let symmetry = design.symmetry.map(|(order, mirror)| (if order % 2 == 0 { 2 } else { 1 }, mirror));
    Ok(Design { tiers: tiers.collect(), symmetry, ..design })
}
