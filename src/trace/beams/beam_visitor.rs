//! Incident, exiting and residual beams, and the visitor that sees them.

use super::beam_coords::{BeamCoords, EntryFacet};
use super::beam_light::Interface;
use crate::geometry::Plane;
use glam::{DVec2, DVec3};

/// A parallel beam as wide as the stone.
#[derive(Debug, Clone, Copy)]
pub struct IncidentBeam<const K: usize> {
    /// Unit direction in which the light goes, stone's frame.
    pub direction: DVec3,
    /// Refractive index of the stone for each spectral line; the first line leads.
    pub indices: [f64; K],
}

/// Light that leaves along one facet sequence.
#[derive(Debug)]
pub struct BeamExit<'a, L, const K: usize> {
    /// Where it entered.
    pub entry: &'a EntryFacet,
    /// Facet through which it leaves.
    pub facet: usize,
    /// Unit direction outside, of the leading line.
    pub direction: DVec3,
    /// Facets met inside, this one included.
    pub bounces: u32,
    /// Its footprint in the plane of the entry facet, counter-clockwise.
    pub footprint: &'a [DVec2],
    /// Its power, as a share of the light on the outline of the stone.
    pub power: f64,
    /// The footprint's share of the outline.
    pub share: f64,
    /// What leaves, as a share of the light that fell on the footprint.
    pub light: L,
    /// The beam that arrives at the facet, line by line.
    pub coords: &'a [BeamCoords; K],
    /// Outward unit normal of the facet.
    pub normal: DVec3,
    pub(super) indices: [f64; K],
}

impl<L, const K: usize> BeamExit<'_, L, K> {
    /// Unit direction outside of line `k`; none if that line is reflected totally.
    pub fn direction_of(&self, k: usize) -> Option<DVec3> {
        let at = Interface::new(self.coords[k].direction, self.normal, self.indices[k], true);
        (at.fresnel.cos_t > 0.0).then_some(at.transmitted)
    }
}

/// A beam that is not followed, about to leave a facet inside.
#[derive(Debug)]
pub struct ResidualBeam<'a, L, const K: usize> {
    /// Where it entered.
    pub entry: &'a EntryFacet,
    /// The facet that it leaves: reflected by it, or entering there.
    pub facet: usize,
    /// The facet's plane, trace frame.
    pub plane: Plane,
    /// Its footprint in the plane of the entry facet, counter-clockwise.
    pub footprint: &'a [DVec2],
    /// Facets met inside.
    pub bounces: u32,
    /// Its power, as a share of the light on the outline.
    pub power: f64,
    /// The footprint's share of the outline.
    pub share: f64,
    /// Its light, as a share of the light that fell on the footprint.
    pub light: L,
    /// The beam, line by line.
    pub coords: &'a [BeamCoords; K],
}

/// A visitor of beams: sees reflections, exits and residual beams.
pub trait BeamVisitor<L, const K: usize> {
    /// Light is reflected at entry, in a unit direction; its power is a share of the light on the
    /// outline.
    fn reflected(&mut self, _entrance: &EntryFacet, _direction: DVec3, _power: f64) {}

    /// Light leaves the stone.
    fn exit(&mut self, exit: &BeamExit<L, K>);

    /// A beam is not followed.
    fn residual(&mut self, _rest: &ResidualBeam<L, K>) {}
}
