//! Entry sampling: points of the silhouette that a viewer sees, points of the crown by area.

use super::{EstimatorError, ViewFrame};
use crate::design::Zone;
use crate::geometry::measure::convex_hull;
use crate::sampling::discrete_cdf::DiscreteCdf;
use crate::trace::ConvexStone;
use crate::trace::nonconvex::MeshStone;
use glam::{DVec2, DVec3, Vec3};

/// Whether light through facet with unit normal `n` goes through the crown (the table included).
pub(super) fn is_crown(n: DVec3) -> bool {
    matches!(Zone::from_normal(n), Zone::Table | Zone::Crown)
}

/// For each facet 1 if it belongs to the crown (or is the table), else 0.
pub(super) fn crown_flags(stone: &ConvexStone) -> Vec<f32> {
    flags(stone, is_crown)
}

/// Whether a facet with unit normal `n` belongs to the pavilion (or is the culet).
pub(super) fn is_pavilion(n: DVec3) -> bool {
    matches!(Zone::from_normal(n), Zone::Pavilion | Zone::Culet)
}

/// For each facet 1 if it belongs to the pavilion (or is the culet), else 0.
pub(super) fn pavilion_flags(stone: &ConvexStone) -> Vec<f32> {
    flags(stone, is_pavilion)
}

/// For each facet 1 if it is the table, else 0.
pub(super) fn table_flags(stone: &ConvexStone) -> Vec<f32> {
    flags(stone, |n| Zone::from_normal(n) == Zone::Table)
}

/// For each facet 1 if its unit normal is of a kind, else 0.
pub(super) fn flags(stone: &ConvexStone, is_flagged: impl Fn(DVec3) -> bool) -> Vec<f32> {
    stone.planes.iter().map(|p| if is_flagged(p.normal) { 1.0 } else { 0.0 }).collect()
}

/// The crown of a stone as triangles, trace frame.
#[derive(Debug, Clone)]
pub(super) struct Crown {
    /// Facet and corners of each triangle.
    triangles: Vec<(usize, [DVec3; 3])>,
    pick: DiscreteCdf,
}

impl Crown {
    /// The crown of a stone that is not convex: every facet that faces up, in a concavity too.
    pub(super) fn from_mesh(stone: &MeshStone) -> Result<Self, EstimatorError> {
        Self::from_triangles(
            stone.triangles().filter(|(facet, _)| is_crown(stone.planes[*facet].normal)).collect(),
        )
    }

    pub(super) fn new(stone: &ConvexStone) -> Result<Self, EstimatorError> {
        let mut triangles = Vec::new();
        for (f, plane) in stone.planes.iter().enumerate() {
            if !is_crown(plane.normal) {
                continue;
            }
            let corners: Vec<_> = stone.solid.polygon(f).map(|v| stone.point_from_design(v)).collect();
            let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
            for (i, &a) in corners.iter().enumerate() {
                triangles.push((f, [middle, a, corners[(i + 1) % corners.len()]]));
            }
        }
        Self::from_triangles(triangles)
    }

    fn from_triangles(triangles: Vec<(usize, [DVec3; 3])>) -> Result<Self, EstimatorError> {
        let area = |t: &(usize, [DVec3; 3])| 0.5 * (t.1[1] - t.1[0]).cross(t.1[2] - t.1[0]).length();
        let pick = DiscreteCdf::new(triangles.iter().map(area));
        if pick.total() > 0.0 { Ok(Self { triangles, pick }) } else { Err(EstimatorError::NoCrown) }
    }

    /// Area of the crown, trace units squared.
    pub(super) fn area(&self) -> f64 {
        self.pick.total()
    }

    /// Facet and point, uniform by area.
    pub(super) fn sample(&self, u: [f64; 2]) -> (usize, DVec3) {
        let (i, along) = self.pick.sample(u[0]);
        let (facet, [middle, a, b]) = &self.triangles[i];
        let rim = *a + (*b - *a) * along;
        (*facet, *middle + (rim - *middle) * u[1].sqrt())
    }
}

/// A facet whose normal rises by less than this is upright to rounding: nothing of it is seen from
/// above. A steep facet of a tilted stone is seen, and mirrors nearly all that falls on it.
const UPRIGHT: f64 = 1e-9;

/// The outline of a stone as a viewer sees it, trace frame.
#[derive(Debug, Clone)]
pub(super) struct Silhouette {
    view_frame: ViewFrame,
    middle: DVec2,
    corners: Vec<DVec2>,
    pick: DiscreteCdf,
    /// Facets that face the viewer: number, slope in the picture, height at its middle.
    upper_facets: Vec<(usize, DVec2, f64)>,
}

impl Silhouette {
    pub(super) fn new(stone: &ConvexStone, view_frame: ViewFrame) -> Result<Self, EstimatorError> {
        let flat = stone.solid.vertices.iter().map(|v| view_frame.project(stone.point_from_design(*v)));
        let corners = convex_hull(flat.collect());
        let middle = corners.iter().sum::<DVec2>() / corners.len().max(1) as f64;
        let pick = DiscreteCdf::new((0..corners.len()).map(|i| {
            let next = corners[(i + 1) % corners.len()];
            0.5 * (corners[i] - middle).perp_dot(next - middle)
        }));
        let roof: Vec<_> = (0..)
            .zip(&stone.planes)
            .map(|(i, plane)| (i, plane, plane.normal.dot(view_frame.axis)))
            .filter(|(.., cosine)| *cosine > UPRIGHT)
            .map(|(i, p, cosine)| (i, view_frame.project(p.normal) / cosine, p.distance / cosine))
            .collect();
        if pick.total() > 0.0 && !roof.is_empty() {
            Ok(Self { view_frame, middle, corners, pick, upper_facets: roof })
        } else {
            Err(EstimatorError::NoCrown)
        }
    }

    /// Area within the outline, trace units squared.
    pub(super) fn area(&self) -> f64 {
        self.pick.total()
    }

    /// A place of the picture, uniform over the outline.
    pub(super) fn sample_point(&self, u: [f64; 2]) -> DVec2 {
        let (i, along) = self.pick.sample(u[0]);
        let (a, b) = (self.corners[i], self.corners[(i + 1) % self.corners.len()]);
        self.middle + (a + (b - a) * along - self.middle) * u[1].sqrt()
    }

    /// Whether a place of the picture lies within the outline.
    pub(super) fn contains(&self, at: DVec2) -> bool {
        (0..self.corners.len()).all(|i| {
            let (a, b) = (self.corners[i], self.corners[(i + 1) % self.corners.len()]);
            (b - a).perp_dot(at - a) >= 0.0
        })
    }

    /// Facet and point that the line of sight through a place within the outline meets.
    pub(super) fn facet_above(&self, at: DVec2) -> (usize, Vec3) {
        let mut top = (0, f64::INFINITY);
        for (facet, slope, height) in &self.upper_facets {
            let z = height - slope.dot(at);
            if z < top.1 {
                top = (*facet, z);
            }
        }
        let ViewFrame { axis, right, top: up } = self.view_frame;
        (top.0, (right * at.x + up * at.y + axis * top.1).as_vec3())
    }

    /// Facet and point that a line of sight meets, uniform over the outline.
    pub(super) fn sample(&self, u: [f64; 2]) -> (usize, Vec3) {
        self.facet_above(self.sample_point(u))
    }
}
