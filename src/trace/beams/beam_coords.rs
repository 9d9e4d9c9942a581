//! Beam coordinates: coordinates of a beam's cross-section that reflection leaves unchanged.

use crate::geometry::Plane;
use glam::{DVec2, DVec3};

/// Coordinates of the facet that a beam entered through, carried along the beam.
///
/// A ray of the beam is the point (u, v) of the entry facet's plane at which it entered; wherever
/// the beam is, the ray through a point `p` is `(across·p, along·p) − offset`. A footprint thus
/// keeps its coordinates from facet to facet and from wavelength to wavelength, and only the
/// projection changes, by one reflection.
#[derive(Debug, Clone, Copy)]
pub struct BeamCoords {
    /// u of a point, before the offset; always at right angles to the direction. A unit vector
    /// across the plane of incidence at entry, unless that was all but normal.
    pub across: DVec3,
    /// v of a point, before the offset; at right angles to the direction.
    pub along: DVec3,
    /// Offset subtracted from both.
    pub offset: DVec2,
    /// Unit direction of the beam inside.
    pub direction: DVec3,
}

/// The facet through which a beam enters, with its coordinates.
#[derive(Debug, Clone, Copy)]
pub struct EntryFacet {
    /// The facet's number.
    pub facet: usize,
    /// Its plane, trace frame.
    pub plane: Plane,
    /// Axis of u: unit, across the plane of incidence.
    pub u: DVec3,
    /// Axis of v: unit, normal × u.
    pub v: DVec3,
}

impl EntryFacet {
    /// Coordinates on a facet for light from `direction` (unit, towards the facet).
    pub fn new(facet: usize, plane: Plane, direction: DVec3) -> EntryFacet {
        let n = plane.normal;
        // at normal incidence any direction is across
        let u = n.cross(direction).try_normalize().filter(|u| u.dot(n).abs() < 1e-12);
        let u = u.unwrap_or_else(|| n.any_orthonormal_vector());
        EntryFacet { facet, plane, u, v: n.cross(u) }
    }

    /// The point (u, v) of the facet's plane, trace frame.
    pub fn point(&self, uv: DVec2) -> DVec3 {
        self.plane.normal * self.plane.distance + self.u * uv.x + self.v * uv.y
    }

    /// Coordinates of a point of the facet's plane.
    pub fn coordinates(&self, p: DVec3) -> DVec2 {
        DVec2::new(self.u.dot(p), self.v.dot(p))
    }

    /// Coordinates of the beam that goes on in `direction` (unit) behind the facet.
    pub fn coords(&self, direction: DVec3) -> BeamCoords {
        let n = self.plane.normal;
        let slant = DVec2::new(self.u.dot(direction), self.v.dot(direction)) / n.dot(direction);
        BeamCoords {
            across: self.u - n * slant.x,
            along: self.v - n * slant.y,
            offset: slant * -self.plane.distance,
            direction,
        }
    }
}

impl BeamCoords {
    /// The ray through `p`.
    #[inline]
    pub fn project(&self, p: DVec3) -> DVec2 {
        DVec2::new(self.across.dot(p), self.along.dot(p)) - self.offset
    }

    /// Reflects the beam at a facet.
    #[inline(always)]
    pub fn mirror(&mut self, plane: &Plane) {
        let n = plane.normal;
        let (a, b) = (2.0 * n.dot(self.across), 2.0 * n.dot(self.along));
        self.across -= n * a;
        self.along -= n * b;
        self.offset -= DVec2::new(a, b) * plane.distance;
        self.direction -= n * (2.0 * n.dot(self.direction));
    }

    /// The point of the ray (u, v) that lies nearest to the origin.
    #[inline]
    pub fn point(&self, uv: DVec2) -> DVec3 {
        let at = uv + self.offset;
        let (of_u, of_v) = (self.along.cross(self.direction), self.direction.cross(self.across));
        (of_u * at.x + of_v * at.y) / self.across.dot(of_u)
    }

    /// Where the ray (u, v) passes a plane that the beam is not parallel to.
    pub fn point_on(&self, uv: DVec2, plane: &Plane) -> DVec3 {
        let p = self.point(uv);
        p - self.direction * (plane.signed_distance(p) / plane.normal.dot(self.direction))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_of_the_beam_keeps_its_coordinates_through_a_mirror() {
        let plane = Plane::new(DVec3::new(0.2, -0.3, 0.9), 0.4);
        let entrance = EntryFacet::new(0, plane, DVec3::new(0.1, 0.2, -1.0).normalize());
        let uv = DVec2::new(0.21, -0.17);
        assert!((entrance.coordinates(entrance.point(uv)) - uv).length() < 1e-15);
        let inside = DVec3::new(0.05, 0.13, -1.0).normalize();
        let frame = entrance.coords(inside);
        assert!(frame.across.dot(inside).abs().max(frame.along.dot(inside).abs()) < 1e-15);
        assert!((frame.project(entrance.point(uv)) - uv).length() < 1e-15);
        assert!((frame.point_on(uv, &plane) - entrance.point(uv)).length() < 1e-15);
        let mirror = Plane::new(DVec3::new(0.3, 0.1, -0.8), 0.5);
        let met = frame.point_on(uv, &mirror);
        let mut next = frame;
        next.mirror(&mirror);
        assert!((next.project(met) - uv).length() < 1e-15);
        assert!((next.project(met + next.direction * 0.7) - uv).length() < 1e-15);
    }
}
