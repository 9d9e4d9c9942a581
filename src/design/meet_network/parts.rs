//! The parts of a design: facets of one angle and distance, which are cut at one setting and move as one.

use crate::design::tiers::{Design, Zone};
use crate::geometry::{Plane, Polyhedron};
use glam::{DVec2, DVec3};

/// Facets of one angle and distance.
#[derive(Debug, Clone)]
pub struct Part {
    /// Where they are.
    pub zone: Zone,
    /// Angle of their normals from +z in radians: 0 of a table, π/2 of a girdle, π of a culet.
    pub polar: f64,
    /// Their distance from the origin of the network's frame.
    pub distance: f64,
    /// Their numbers in [`Design::facets`].
    pub facets: Vec<usize>,
}

/// How far facets of one part may differ.
struct Alike {
    /// In angle, radians.
    polar: f64,
    /// In distance, parts of the stone's radius.
    distance: f64,
}

/// Facets that were cut by angle and index: above the rounding of a file with three decimals of a degree
/// and five of a distance.
const CUT: Alike = Alike { polar: 2e-5, distance: 2e-5 };

/// Facets of a mesh: above the rounding of `f32` and of five decimals.
const MEASURED: Alike = Alike { polar: 3.5e-4, distance: 1e-4 };

/// The frame in which the network is solved: its origin lies on the stone's axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    pub origin: DVec3,
}

impl Frame {
    /// A design whose facets have indices is cut about its own axis; of another the axis goes through the
    /// centre of mass.
    pub fn of(design: &Design, solid: &Polyhedron) -> Frame {
        let is_cut = design.tiers.iter().any(|t| t.angle_deg.is_some());
        let centre = solid.volume_and_centre().1;
        Frame { origin: if is_cut { DVec3::ZERO } else { centre } }
    }

    /// A plane of the design in this frame.
    pub fn to(self, plane: &Plane) -> Plane {
        plane.moved(-self.origin)
    }

    /// A plane of this frame in the design's.
    pub fn from(self, plane: &Plane) -> Plane {
        plane.moved(self.origin)
    }
}

/// A facet as one of its part.
#[derive(Debug, Clone, Copy)]
pub(super) struct FacetOfPart {
    pub part: usize,
    /// Direction of its normal seen from above, a unit vector.
    pub azimuth: DVec2,
    /// Its angle and distance less those of the part: rounding.
    polar: f64,
    distance: f64,
}

impl FacetOfPart {
    pub fn new(part: usize, azimuth: DVec2, polar: f64, distance: f64) -> FacetOfPart {
        FacetOfPart { part, azimuth, polar, distance }
    }

    /// Turned about the axis by so many radians, counter-clockwise seen from +z.
    pub fn turned(self, angle: f64) -> FacetOfPart {
        FacetOfPart { azimuth: DVec2::from_angle(angle).rotate(self.azimuth), ..self }
    }

    /// Its unit normal when the part has the polar angle `polars[part]`.
    pub fn normal(&self, polars: &[f64]) -> DVec3 {
        let (sin, cos) = sin_cos(polars[self.part] + self.polar);
        (self.azimuth * sin).extend(cos)
    }

    /// What its normal changes by for each radian of the polar angle.
    pub fn turning(&self, polars: &[f64]) -> DVec3 {
        let (sin, cos) = sin_cos(polars[self.part] + self.polar);
        (self.azimuth * cos).extend(-sin)
    }

    /// Its plane when the parts have these angles and distances.
    pub fn plane(&self, polars: &[f64], distances: &[f64]) -> Plane {
        Plane { normal: self.normal(polars), distance: distances[self.part] + self.distance }
    }
}

/// Sine and cosine, exact for the horizontal and the vertical.
fn sin_cos(polar: f64) -> (f64, f64) {
    use std::f64::consts::{FRAC_PI_2, PI};
    match polar {
        0.0 => (0.0, 1.0),
        FRAC_PI_2 => (1.0, 0.0),
        PI => (0.0, -1.0),
        other => other.sin_cos(),
    }
}

/// The parts of a design, and its facets as theirs.
pub(super) fn of_design(design: &Design, solid: &Polyhedron, frame: &Frame) -> (Vec<Part>, Vec<FacetOfPart>) {
    let radius = solid.bounding_sphere().1;
    let mut parts: Vec<Part> = Vec::new();
    let mut facets = Vec::new();
    for (number, (tier, facet)) in
        design.tiers.iter().flat_map(|t| t.facets.iter().map(move |f| (t, f))).enumerate()
    {
        let alike = if tier.angle_deg.is_some() { CUT } else { MEASURED };
        let plane = frame.to(&facet.plane);
        let zone = Zone::from_normal(plane.normal);
        let across = plane.normal.truncate();
        let polar = across.length().atan2(plane.normal.z);
        let same = |p: &Part| {
            p.zone == zone
                && (p.polar - polar).abs() <= alike.polar
                && (p.distance - plane.distance).abs() <= alike.distance * radius
        };
        let part = parts.iter().position(same).unwrap_or_else(|| {
            parts.push(Part { zone, polar, distance: plane.distance, facets: Vec::new() });
            parts.len() - 1
        });
        parts[part].facets.push(number);
        facets.push(FacetOfPart {
            part,
            azimuth: across.try_normalize().unwrap_or(DVec2::NEG_Y),
            polar: polar - parts[part].polar,
            distance: plane.distance - parts[part].distance,
        });
    }
    (parts, facets)
}
