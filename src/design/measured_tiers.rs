//! Tiers read off the planes alone, for stones whose facets were never cut by angle and index.

use super::tiers::{Design, Gear, Zone};
use crate::geometry::Polyhedron;
use glam::DVec3;
use std::f64::consts::TAU;

/// Facets of one angle and distance.
#[derive(Debug, Clone)]
pub struct MeasuredTier {
    /// Where its facets are.
    pub zone: Zone,
    /// Mean angle from the girdle plane in degrees, negative on the pavilion.
    pub angle_deg: f64,
    /// Numbers of its facets in [`Design::facets`].
    pub facets: Vec<usize>,
    /// Their indices on the wheel, growing; none for horizontal facets.
    pub indices: Vec<f64>,
}

/// Angles in degrees within which facets are of one tier.
const ONE_ANGLE_DEG: f64 = 0.02;

/// Distances from the middle, in parts of the stone's radius, within which facets are of one tier: wider
/// than the rounding of `f32` and of five decimals, narrower than steps of a fancy girdle.
const ONE_DISTANCE: f64 = 1e-4;

/// The tiers of the design's standing facets, pavilion first, the steepest of each side first.
pub fn tiers(design: &Design, solid: &Polyhedron) -> Vec<MeasuredTier> {
    let (_, middle) = solid.volume_and_centre();
    let near = ONE_DISTANCE * solid.bounding_sphere().1;
    let normals: Vec<DVec3> = design.facets().map(|f| f.plane.normal).collect();
    let heights: Vec<f64> = design.facets().map(|f| -f.plane.signed_distance(middle)).collect();
    let mut tiers: Vec<MeasuredTier> = Vec::new();
    let standing: Vec<usize> = solid.faces.iter().map(|f| f.plane).collect();
    for facet in standing {
        let (zone, angle_deg) = (Zone::from_normal(normals[facet]), angle_deg(normals[facet]));
        let alike = |t: &&mut MeasuredTier| {
            let first = t.facets[0];
            t.zone == zone
                && (t.angle_deg - angle_deg).abs() < ONE_ANGLE_DEG
                && (heights[first] - heights[facet]).abs() < near
        };
        match tiers.iter_mut().find(alike) {
            Some(tier) => tier.facets.push(facet),
            None => tiers.push(MeasuredTier { zone, angle_deg, facets: vec![facet], indices: Vec::new() }),
        }
    }
    for tier in &mut tiers {
        let angles = tier.facets.iter().map(|&f| angle_deg(normals[f]));
        tier.angle_deg = angles.sum::<f64>() / tier.facets.len() as f64;
        if !matches!(tier.zone, Zone::Table | Zone::Culet) {
            tier.indices = tier.facets.iter().map(|&f| index(normals[f], design.gear)).collect();
            tier.indices.sort_by(f64::total_cmp);
        }
    }
    let place = |zone| match zone {
        Zone::Pavilion | Zone::Culet => 0,
        Zone::Girdle => 1,
        Zone::Crown | Zone::Table => 2,
    };
    let steep = |t: &MeasuredTier| t.angle_deg.abs();
    tiers.sort_by(|a, b| place(a.zone).cmp(&place(b.zone)).then(steep(b).total_cmp(&steep(a))));
    tiers
}

/// Angle from the girdle plane, negative on the pavilion.
fn angle_deg(n: DVec3) -> f64 {
    let angle = n.truncate().length().atan2(n.z.abs()).to_degrees();
    if Zone::from_normal(n) == Zone::Pavilion || Zone::from_normal(n) == Zone::Culet { -angle } else { angle }
}

/// Index on the wheel, above 0 and up to the number of teeth, a whole one if it is nearly that.
fn index(n: DVec3, gear: Gear) -> f64 {
    let teeth = gear.teeth.abs();
    let exact = gear.offset + gear.teeth * n.x.atan2(-n.y) / TAU;
    let index = if (exact - exact.round()).abs() < 1e-3 { exact.round() } else { exact }.rem_euclid(teeth);
    if index == 0.0 { teeth } else { index }
}
