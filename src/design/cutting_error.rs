//! Stones as they come off the machine: cut from a design with the angle of every tier a little off.

use super::tiers::{Design, Zone};
use crate::geometry::{Plane, Polyhedron, SolidError};
use glam::{DVec2, DVec3};

/// Facets of a tier whose angles differ by less, in radians, are cut at one setting: above the rounding of three
/// decimals of a degree.
const ONE_ANGLE: f64 = 2e-5;

/// Stones cut from a design, each with the angle of every tier of crown and pavilion off by `error_deg` up or down,
/// and each facet as far from the middle of the stone as it was ([`super::edit::Keep::Depths`]): facets no longer
/// meet as drawn.
///
/// - `solid`: of the design
/// - `error_deg`: size of the error, in degrees
///
/// Of a design of T tiers there are N stones, N the least power of two above T. Which tiers are off upwards in which
/// stone is an orthogonal array: over the stones every tier is off upwards as often as downwards, and so is every
/// pair of tiers off alike as often as not. For a score that is of second order in the errors, the mean over these
/// stones is therefore that over all 2ᵀ choices of signs, or over any independent errors of standard deviation
/// `error_deg`. Design of experiment: R. L. Plackett and J. P. Burman, *Biometrika* 33 (1946) 305, here by
/// Sylvester's matrices.
pub fn stones(design: &Design, solid: &Polyhedron, error_deg: f64) -> Result<Vec<Polyhedron>, SolidError> {
    let planes = design.planes();
    let tiers = tiers(design);
    let count = tiers.iter().flatten().max().map_or(0, |last| last + 1);
    let middle = middle(design, solid);
    let cut = |stone: usize| {
        let planes: Vec<Plane> = planes
            .iter()
            .zip(&tiers)
            .map(|(plane, tier)| match tier {
                Some(tier) => tilted(plane, middle, sign(stone, *tier) * error_deg.to_radians()),
                None => *plane,
            })
            .collect();
        Polyhedron::from_planes(&planes)
    };
    (0..(count + 1).next_power_of_two()).map(cut).collect()
}

/// Whether a tier of a stone is off upwards (1) or downwards (−1): an entry of Sylvester's matrix, whose column of
/// ones no tier has.
fn sign(stone: usize, tier: usize) -> f64 {
    if (stone & (tier + 1)).count_ones().is_multiple_of(2) { 1.0 } else { -1.0 }
}

/// Of each facet the tier that sets its angle; none of table, culet and girdle.
fn tiers(design: &Design) -> Vec<Option<usize>> {
    let mut known: Vec<(usize, Zone, f64)> = Vec::new();
    let numbered = design.tiers.iter().enumerate();
    let facets = numbered.flat_map(|(tier, t)| t.facets.iter().map(move |f| (tier, f.plane.normal)));
    let setting = |(tier, normal): (usize, DVec3)| {
        let (zone, polar) = (Zone::from_normal(normal), normal.truncate().length().atan2(normal.z));
        if !matches!(zone, Zone::Crown | Zone::Pavilion) {
            return None;
        }
        let same = |k: &(usize, Zone, f64)| k.0 == tier && k.1 == zone && (k.2 - polar).abs() < ONE_ANGLE;
        Some(known.iter().position(same).unwrap_or_else(|| {
            known.push((tier, zone, polar));
            known.len() - 1
        }))
    };
    facets.map(setting).collect()
}

/// The middle of a stone: on the axis, halfway up the girdle, or at the height of the widest corner of a stone
/// without girdle facets. The axis goes through the origin of a design that is cut by angle and index, through the
/// centre of mass of another.
fn middle(design: &Design, solid: &Polyhedron) -> DVec3 {
    let is_cut = design.tiers.iter().any(|tier| tier.angle_deg.is_some());
    let axis = if is_cut { DVec2::ZERO } else { solid.volume_and_centre().1.truncate() };
    let is_girdle =
        |face: &usize| Zone::from_normal(solid.area_vector(*face).normalize_or_zero()) == Zone::Girdle;
    let heights = (0..solid.faces.len()).filter(is_girdle).flat_map(|face| solid.polygon(face).map(|c| c.z));
    let girdle = heights.fold(None, |range: Option<(f64, f64)>, z| {
        Some(range.map_or((z, z), |(low, high)| (low.min(z), high.max(z))))
    });
    let radius = |corner: &DVec3| corner.truncate().distance(axis);
    let widest = || solid.vertices.iter().copied().reduce(|a, b| if radius(&b) > radius(&a) { b } else { a });
    let z =
        girdle.map(|(low, high)| 0.5 * (low + high)).or_else(|| widest().map(|c| c.z)).unwrap_or_default();
    axis.extend(z)
}

/// A plane turned steeper by so many radians, as far from a point as it was.
fn tilted(plane: &Plane, point: DVec3, by: f64) -> Plane {
    let flat = plane.normal.truncate();
    let angle = flat.length().atan2(plane.normal.z.abs()) + by;
    let up = angle.cos() * plane.normal.z.signum();
    let normal = (flat.normalize_or_zero() * angle.sin()).extend(up);
    Plane { normal, distance: plane.distance + (normal - plane.normal).dot(point) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::edit::{EditRequest, Keep};
    use crate::design::library;
    use std::collections::BTreeMap;

    fn cut(name: &str) -> Design {
        library::design(name, &BTreeMap::new()).expect("a cut").expect("solved")
    }

    /// Over the stones of T tiers every product of two different signs, and every sign, has the mean 0.
    #[test]
    fn errors_are_balanced_and_independent() {
        for tiers in [1, 2, 3, 4, 7, 8, 20] {
            let stones = (tiers + 1_usize).next_power_of_two();
            let sum = |of: &dyn Fn(usize) -> f64| (0..stones).map(of).sum::<f64>();
            for a in 0..tiers {
                assert_eq!(sum(&|stone| sign(stone, a)), 0.0);
                assert!((0..a).all(|b| sum(&|stone| sign(stone, a) * sign(stone, b)) == 0.0));
            }
        }
    }

    /// Each stone is the one that `edit --keep depths` makes of the same errors, wherever the file's origin lies.
    #[test]
    fn a_stone_is_what_editing_at_depths_makes() {
        let mut compared = 0;
        for (name, raised) in [("tolkowsky", 0.0), ("classic", 0.0), ("classic", 0.3)] {
            let mut design = cut(name);
            design.family = None;
            for facet in design.tiers.iter_mut().flat_map(|tier| &mut tier.facets) {
                facet.plane = facet.plane.moved(raised * DVec3::Z);
            }
            let solid = design.solid().expect("closed");
            let stones = stones(&design, &solid, 0.2).expect("closed");
            let tiers = tiers(&design);
            let count = 1 + tiers.iter().flatten().max().expect("tiers");
            assert_eq!(stones.len(), (count + 1).next_power_of_two());
            for (i, stone) in stones.iter().enumerate() {
                let mut settings = Vec::new();
                let (mut crown, mut pavilion) = (0, 0);
                for tier in 0..count {
                    let facet = tiers.iter().position(|t| *t == Some(tier)).expect("a facet");
                    let up = Zone::from_normal(design.planes()[facet].normal) == Zone::Crown;
                    let (letter, number) = if up { ('C', &mut crown) } else { ('P', &mut pavilion) };
                    *number += 1;
                    let by = if sign(i, tier) > 0.0 { "+=0.2" } else { "-=0.2" };
                    settings.push(format!("{letter}{number}.angle{by}"));
                }
                let request = EditRequest::new(&settings).expect("settings").keep(Keep::Depths);
                // an edit refuses to lose a facet, as of a thin girdle; cutting errors may
                let Ok(edited) = request.run(&design).map(|edited| edited.solid) else { continue };
                compared += 1;
                assert!((stone.volume() / edited.volume() - 1.0).abs() < 1e-9, "{name} {settings:?}");
                assert!((stone.bounds().0 - edited.bounds().0).length() < 1e-9 * solid.width(), "{name}");
                assert!((stone.bounds().1 - edited.bounds().1).length() < 1e-9 * solid.width(), "{name}");
            }
        }
        assert!(compared > 12, "{compared}");
    }
}
