//! Exact beams: tracing of polygons instead of rays.
//!
//! A parallel beam that enters through one facet stays parallel along each sequence of facets, and
//! its footprint is a convex polygon clipped facet by facet: the "virtual facets" of J. Sasián et
//! al. (*Optical Engineering* 46 (2007) 093604). Adding up the polygons gives light return, ASET
//! shares and leakage without noise. What is too weak to be followed is handed to the caller, who
//! may finish it by photons ([`residual`]). Checked in `tests/beams.rs` against an independent
//! tracer's figures, and against photons for every cut of the library.

mod beam_coords;
mod beam_light;
pub(super) mod beam_tracer;
mod clip;
mod facets;
mod queue;
pub mod residual;

pub use beam_coords::{BeamCoords, EntryFacet};
pub use beam_light::{BeamLight, Interface, UnpolarisedLight};
pub use facets::{WELD_DISTANCE, WeldedFacets};

use super::{ConvexStone, dispatch};
use crate::geometry::Plane;
use glam::{DVec2, DVec3};

/// A facet faces along a beam if the cosine is above this; one that is seen edge-on has no area.
const MIN_FACING_COS: f64 = 1e-13;

/// After so many facets a beam is not followed further. Only light that total reflection keeps (a
/// cube's) comes so far: what is partly let out at every other facet holds 1e-80 of its power.
pub const MAX_FACETS: u32 = 256;

/// A parallel beam as wide as the stone.
#[derive(Debug, Clone, Copy)]
pub struct IncidentBeam<const K: usize> {
    /// Unit direction in which the light goes, stone's frame.
    pub direction: DVec3,
    /// Refractive index of the stone for each line that goes along; the first one leads.
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
    indices: [f64; K],
}

impl<L, const K: usize> BeamExit<'_, L, K> {
    /// Unit direction outside of line `k`; none if that line is reflected totally.
    pub fn direction_of(&self, k: usize) -> Option<DVec3> {
        let at = Interface::new(self.coords[k].direction, self.normal, 1.0 / self.indices[k], true);
        (at.fresnel.cos_t > 0.0).then_some(at.transmitted)
    }
}

/// A beam that is not followed, about to leave a facet inside.
#[derive(Debug)]
pub struct ResidualBeam<'a, L, const K: usize> {
    /// Where it entered.
    pub entry: &'a EntryFacet,
    /// The facet that it leaves: thrown back by it, or entering there.
    pub facet: usize,
    /// The facet's plane, trace frame.
    pub plane: Plane,
    /// Its footprint in the plane of the entry facet, counter-clockwise.
    pub footprint: &'a [DVec2],
    /// Its power, as a share of the light on the outline.
    pub power: f64,
    /// The footprint's share of the outline.
    pub share: f64,
    /// Its light, as a share of the light that fell on the footprint.
    pub light: L,
    /// The beam, line by line.
    pub coords: &'a [BeamCoords; K],
}

/// Stop criteria: when beams are left to the caller.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StopCriteria {
    /// A beam is not followed when its power is below this share of the light on the outline.
    pub power: f64,
    /// Tracing stops once the beams not yet traced hold less than this share of the incident power
    /// together. The strongest go first, so that this is reached with about the fewest.
    pub residual: f64,
    /// A beam is not followed after so many facets inside, [`MAX_FACETS`] at most.
    pub facets: u32,
    /// No beam is followed further once there have been so many.
    pub beams: u64,
}

impl StopCriteria {
    /// Follows beams down to a power.
    pub fn at_power(power: f64) -> StopCriteria {
        StopCriteria { power, residual: 0.0, facets: MAX_FACETS, beams: u64::MAX }
    }

    /// Follows beams until this share of the light is left.
    pub fn at_residual(left: f64) -> StopCriteria {
        /// Far below what adds up to any share that matters, and far above the memory of a machine.
        const LEAST: f64 = 1e-9;
        StopCriteria { power: LEAST, residual: left, facets: MAX_FACETS, beams: u64::MAX }
    }
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

/// Energy budget: where the light has gone, as shares of the light on the outline.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct EnergyBudget {
    /// Area of the outline seen along the light, in the stone's (trace) unit squared.
    pub outline: f64,
    /// Reflected at entry.
    pub reflected: f64,
    /// Left the stone again.
    pub exited: f64,
    /// In beams that were not followed.
    pub not_followed: f64,
    /// Beams: one for each facet that faces the light, and one for each reflection followed.
    pub beams: u64,
}

impl EnergyBudget {
    /// All light accounted for: 1 to rounding, if the leading line goes alone. With several lines
    /// the rest has met another facet than its company.
    pub fn sum(&self) -> f64 {
        self.reflected + self.exited + self.not_followed
    }
}

/// A stone made ready for beams.
#[derive(Debug, Clone)]
pub struct Beams<'a> {
    stone: &'a ConvexStone,
    facets: WeldedFacets,
}

impl<'a> Beams<'a> {
    /// Welds the corners of a stone.
    pub fn new(stone: &'a ConvexStone) -> Self {
        Beams { stone, facets: WeldedFacets::new(stone) }
    }

    /// The stone.
    pub fn stone(&self) -> &'a ConvexStone {
        self.stone
    }

    /// The welded facets.
    pub fn facets(&self) -> &WeldedFacets {
        &self.facets
    }

    /// Follows a parallel beam along every facet sequence.
    ///
    /// - `light`: what falls on the stone, power 1
    /// - `until`: when beams are left to the caller
    ///
    /// A stone without light on it (a direction that is not a number) gives totals of 0.
    pub fn trace<L: BeamLight, const K: usize>(
        &self,
        lit: &IncidentBeam<K>,
        light: L,
        until: StopCriteria,
        watch: &mut impl BeamVisitor<L, K>,
    ) -> EnergyBudget {
        dispatch::trace_beams(self.stone, beam_tracer::BeamTracer::new(self, lit, until, watch), light)
    }
}
