//! Where light enters: points of the outline seen from above, points of the crown by area.

use super::ExperimentError;
use crate::cut::Zone;
use crate::walk::Stone;
use glam::{DVec2, DVec3, Vec3};

/// Whether light through facet with unit normal `n` goes through the crown (the table included).
fn is_crown(n: DVec3) -> bool {
    matches!(Zone::of(n), Zone::Table | Zone::Crown)
}

/// For each facet 1 if it belongs to the crown (or is the table), else 0.
pub(super) fn crown_flags(stone: &Stone) -> Vec<f32> {
    stone.planes.iter().map(|p| if is_crown(p.normal) { 1.0 } else { 0.0 }).collect()
}

/// Picks a piece by weight from a uniform number and hands back the rest of that number, again
/// uniform in [0, 1).
#[derive(Debug, Clone)]
struct Pick {
    /// Running sums of the weights; the last is the total.
    upto: Vec<f64>,
}

impl Pick {
    fn new(weights: impl Iterator<Item = f64>) -> Self {
        let upto = weights
            .scan(0.0, |sum, w| {
                *sum += w;
                Some(*sum)
            })
            .collect();
        Self { upto }
    }

    fn total(&self) -> f64 {
        self.upto.last().copied().unwrap_or(0.0)
    }

    fn at(&self, u: f64) -> (usize, f64) {
        let x = u * self.total();
        let i = self.upto.partition_point(|s| *s <= x).min(self.upto.len().saturating_sub(1));
        let from = if i == 0 { 0.0 } else { self.upto[i - 1] };
        (i, ((x - from) / (self.upto[i] - from)).clamp(0.0, 1.0))
    }
}

/// The crown of a stone as triangles, walking frame.
#[derive(Debug, Clone)]
pub(super) struct Crown {
    /// Facet and corners of each triangle.
    triangles: Vec<(usize, [DVec3; 3])>,
    pick: Pick,
}

impl Crown {
    pub(super) fn new(stone: &Stone) -> Result<Self, ExperimentError> {
        let mut triangles = Vec::new();
        for (f, plane) in stone.planes.iter().enumerate() {
            if !is_crown(plane.normal) {
                continue;
            }
            let corners: Vec<_> = stone.solid.polygon(f).map(|v| stone.from_design(v)).collect();
            let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
            for (i, &a) in corners.iter().enumerate() {
                triangles.push((f, [middle, a, corners[(i + 1) % corners.len()]]));
            }
        }
        let area = |t: &(usize, [DVec3; 3])| 0.5 * (t.1[1] - t.1[0]).cross(t.1[2] - t.1[0]).length();
        let pick = Pick::new(triangles.iter().map(area));
        if pick.total() > 0.0 { Ok(Self { triangles, pick }) } else { Err(ExperimentError::NoCrown) }
    }

    /// Area of the crown, walking units squared.
    pub(super) fn area(&self) -> f64 {
        self.pick.total()
    }

    /// Facet and point, uniform by area.
    pub(super) fn sample(&self, u: [f64; 2]) -> (usize, Vec3) {
        let (i, along) = self.pick.at(u[0]);
        let (facet, [middle, a, b]) = &self.triangles[i];
        let rim = *a + (*b - *a) * along;
        (*facet, (*middle + (rim - *middle) * u[1].sqrt()).as_vec3())
    }
}

/// A facet whose normal rises by less than this is upright to rounding: nothing of it is seen from
/// above. A steep facet of a tilted stone is seen, and mirrors nearly all that falls on it.
const UPRIGHT: f64 = 1e-9;

/// The outline of a stone seen from straight above, walking frame.
#[derive(Debug, Clone)]
pub(super) struct Outline {
    middle: DVec2,
    corners: Vec<DVec2>,
    pick: Pick,
    /// Facets that face up: number, normal divided by its z, distance divided by it.
    roof: Vec<(usize, DVec2, f64)>,
}

impl Outline {
    pub(super) fn new(stone: &Stone) -> Result<Self, ExperimentError> {
        let corners: Vec<DVec2> = stone
            .solid
            .outline()
            .iter()
            .map(|p| stone.from_design(p.extend(stone.centre.z)).truncate())
            .collect();
        let middle = corners.iter().sum::<DVec2>() / corners.len().max(1) as f64;
        let pick = Pick::new((0..corners.len()).map(|i| {
            let next = corners[(i + 1) % corners.len()];
            0.5 * (corners[i] - middle).perp_dot(next - middle)
        }));
        let roof: Vec<_> = stone
            .planes
            .iter()
            .enumerate()
            .filter(|(_, p)| p.normal.z > UPRIGHT)
            .map(|(i, p)| (i, p.normal.truncate() / p.normal.z, p.distance / p.normal.z))
            .collect();
        if pick.total() > 0.0 && !roof.is_empty() {
            Ok(Self { middle, corners, pick, roof })
        } else {
            Err(ExperimentError::NoCrown)
        }
    }

    /// Area within the outline, walking units squared.
    pub(super) fn area(&self) -> f64 {
        self.pick.total()
    }

    /// Facet and point that a vertical ray meets, uniform over the outline.
    pub(super) fn sample(&self, u: [f64; 2]) -> (usize, Vec3) {
        let (i, along) = self.pick.at(u[0]);
        let (a, b) = (self.corners[i], self.corners[(i + 1) % self.corners.len()]);
        let p = self.middle + (a + (b - a) * along - self.middle) * u[1].sqrt();
        let mut top = (0, f64::INFINITY);
        for (facet, slope, height) in &self.roof {
            let z = height - slope.dot(p);
            if z < top.1 {
                top = (*facet, z);
            }
        }
        (top.0, p.extend(top.1).as_vec3())
    }
}
