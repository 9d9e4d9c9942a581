//! The network: parts of a design, and the corners in which their facets meet.

use super::corners::{self, Corner, Outline};
use super::holds::Holds;
use super::parts::{self, FacetOfPart, Frame, Part};
use crate::design::tiers::Design;
use crate::geometry::{Plane, Polyhedron};
use glam::DVec3;

/// The parts of a design and the corners in which their facets meet. Lengths are in the design's unit.
#[derive(Debug, Clone)]
pub struct MeetNetwork {
    /// What moves as one.
    pub parts: Vec<Part>,
    /// Every corner of the stone.
    pub corners: Vec<Corner>,
    /// Girdle width.
    pub width: f64,
    /// The facets, in the order of [`Design::facets`].
    pub(super) facets: Vec<FacetOfPart>,
    /// Origin of the solver: on the axis.
    pub(super) frame: Frame,
    /// Of corners that are each other's images the first: what the equations are of.
    pub(super) representatives: Vec<usize>,
    pub(super) holds: Holds,
    /// Which facets bound the stone.
    pub(super) stands: Vec<bool>,
    /// Facets by their corners.
    pub(super) outlines: Vec<Outline>,
}

impl MeetNetwork {
    /// Recovers the network of a design.
    ///
    /// - `solid`: of the design
    pub fn recover(design: &Design, solid: &Polyhedron) -> MeetNetwork {
        let width = solid.width();
        let frame = Frame::of(design, solid);
        let (parts, facets) = parts::of_design(design, solid, &frame);
        let planes: Vec<Plane> = design.planes().iter().map(|p| frame.to(p)).collect();
        let (corners, outlines) = corners::recover(solid, &planes, &frame, width);
        let representatives = corners::representatives(&corners, &facets, width);
        let holds = Holds::new(&parts, &facets, &corners);
        let mut stands = vec![false; facets.len()];
        solid.faces.iter().for_each(|f| stands[f.plane] = true);
        MeetNetwork { parts, corners, width, facets, frame, representatives, holds, stands, outlines }
    }

    /// The part that a facet is of.
    ///
    /// - `facet`: its number in [`Design::facets`]
    pub fn part_of(&self, facet: usize) -> usize {
        self.facets[facet].part
    }

    /// Corners in which more facets meet than make a corner, of each set of images one.
    pub fn meets(&self) -> impl Iterator<Item = &Corner> {
        self.representatives.iter().map(|c| &self.corners[*c])
    }

    /// Where a corner is, in the design's frame.
    pub fn position(&self, corner: &Corner) -> DVec3 {
        corner.position + self.frame.origin
    }

    /// The middle of the stone, in the design's frame: on the axis, halfway up the girdle. The axis goes through the
    /// origin of a design that was cut by angle and index, through the centre of mass of another.
    pub fn middle(&self) -> DVec3 {
        let height = |corner: &Corner| self.position(corner).z;
        let z = match (self.girdle_corners(), self.outline_corner()) {
            (Some([top, bottom]), _) => 0.5 * (height(top) + height(bottom)),
            (None, Some(outline)) => height(outline),
            (None, None) => self.frame.origin.z,
        };
        self.frame.origin.with_z(z)
    }

    /// Distance of a plane of the design from the middle ([`MeetNetwork::middle`]).
    pub fn distance_from_middle(&self, plane: &Plane) -> f64 {
        -plane.signed_distance(self.middle())
    }

    /// The corners by which the girdle is held: the highest that it has in common with the crown and the lowest
    /// with the pavilion. None of a stone whose crown and pavilion have no girdle facets between them.
    pub fn girdle_corners(&self) -> Option<[&Corner; 2]> {
        self.holds.girdle.map(|corners| corners.map(|c| &self.corners[c]))
    }

    /// The corner by which the outline of a stone without girdle facets is held: the farthest from the axis.
    pub fn outline_corner(&self) -> Option<&Corner> {
        self.holds.outline.map(|c| &self.corners[c])
    }
}
