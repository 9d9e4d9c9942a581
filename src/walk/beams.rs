//! Exact beams: the walk for polygons.
//!
//! A parallel beam that enters through one facet stays parallel along each sequence of facets, and
//! its footprint is a convex polygon clipped facet by facet: the "virtual facets" of J. Sasián et
//! al. (*Optical Engineering* 46 (2007) 093604). Adding up the polygons gives light return, ASET
//! shares and leakage without noise. What is too weak to be followed is handed to the caller, who
//! may finish it by photons ([`remainder`]). Checked in `tests/beams.rs` against an independent
//! tracer's figures, and against photons for every cut of the library.

mod clip;
mod facets;
mod frame;
mod light;
mod queue;
pub mod remainder;
pub(super) mod run;

pub use facets::{Facets, WELD};
pub use frame::{Entrance, Frame};
pub use light::{Interface, Light, Scalar};

use super::{Stone, dispatch};
use crate::solid::Plane;
use glam::{DVec2, DVec3};

/// A facet faces along a beam if the cosine is above this; one that is seen edge-on has no area.
const FACING: f64 = 1e-13;

/// After so many facets a beam is not followed further. Only light that total reflection keeps (a
/// cube's) comes so far: what is partly let out at every other facet holds 1e-80 of its power.
pub const FACETS_LIMIT: u32 = 256;

/// A parallel beam as wide as the stone.
#[derive(Debug, Clone, Copy)]
pub struct Lit<const K: usize> {
    /// Unit direction in which the light goes, stone's frame.
    pub direction: DVec3,
    /// Refractive index of the stone for each line that goes along; the first one leads.
    pub indices: [f64; K],
}

/// Light that leaves along one facet sequence.
#[derive(Debug)]
pub struct Exit<'a, L, const K: usize> {
    /// Where it entered.
    pub entrance: &'a Entrance,
    /// Facet through which it leaves.
    pub facet: usize,
    /// Unit direction outside, of the leading line.
    pub direction: DVec3,
    /// Facets met inside, this one included.
    pub meetings: u32,
    /// Its footprint in the plane of the entry facet, counter-clockwise.
    pub footprint: &'a [DVec2],
    /// Its power, as a share of the light on the outline of the stone.
    pub power: f64,
    /// The footprint's share of the outline.
    pub share: f64,
    /// What leaves, as a share of the light that fell on the footprint.
    pub light: L,
    /// The beam that arrives at the facet, line by line.
    pub frames: &'a [Frame; K],
    /// Outward unit normal of the facet.
    pub normal: DVec3,
    indices: [f64; K],
}

impl<L, const K: usize> Exit<'_, L, K> {
    /// Unit direction outside of line `k`; none if that line is reflected totally.
    pub fn direction_of(&self, k: usize) -> Option<DVec3> {
        let at = Interface::new(self.frames[k].direction, self.normal, 1.0 / self.indices[k], true);
        (at.facing.cos_t > 0.0).then_some(at.passed)
    }
}

/// A beam that is not followed, about to leave a facet inside.
#[derive(Debug)]
pub struct Rest<'a, L, const K: usize> {
    /// Where it entered.
    pub entrance: &'a Entrance,
    /// The facet that it leaves: thrown back by it, or entering there.
    pub facet: usize,
    /// The facet's plane, walking frame.
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
    pub frames: &'a [Frame; K],
}

/// When to leave beams to the caller.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Until {
    /// A beam is not followed when its power is below this share of the light on the outline.
    pub power: f64,
    /// None is when all beams still to be followed hold less than this share together. The strongest
    /// go first, so that this is reached with about the fewest.
    pub left: f64,
    /// A beam is not followed after so many facets inside, [`FACETS_LIMIT`] at most.
    pub facets: u32,
    /// No beam is followed further once there have been so many.
    pub beams: u64,
}

impl Until {
    /// Follows beams down to a power.
    pub fn power(power: f64) -> Until {
        Until { power, left: 0.0, facets: FACETS_LIMIT, beams: u64::MAX }
    }

    /// Follows beams until this share of the light is left.
    pub fn left(left: f64) -> Until {
        /// Far below what adds up to any share that matters, and far above the memory of a machine.
        const LEAST: f64 = 1e-9;
        Until { power: LEAST, left, facets: FACETS_LIMIT, beams: u64::MAX }
    }
}

/// What becomes of the beams.
pub trait Watch<L, const K: usize> {
    /// Light is reflected at entry, in a unit direction; its power is a share of the light on the
    /// outline.
    fn reflected(&mut self, _entrance: &Entrance, _direction: DVec3, _power: f64) {}

    /// Light leaves the stone.
    fn exit(&mut self, exit: &Exit<L, K>);

    /// A beam is not followed.
    fn rest(&mut self, _rest: &Rest<L, K>) {}
}

/// Where the light has gone, as shares of the light on the outline.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Totals {
    /// Area of the outline seen along the light, in the stone's (walking) unit squared.
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

impl Totals {
    /// All light accounted for: 1 to rounding, if the leading line goes alone. With several lines
    /// the rest has met another facet than its company.
    pub fn sum(&self) -> f64 {
        self.reflected + self.exited + self.not_followed
    }
}

/// A stone made ready for beams.
#[derive(Debug, Clone)]
pub struct Beams<'a> {
    stone: &'a Stone,
    facets: Facets,
}

impl<'a> Beams<'a> {
    /// Welds the corners of a stone.
    pub fn new(stone: &'a Stone) -> Self {
        Beams { stone, facets: Facets::new(stone) }
    }

    /// The stone.
    pub fn stone(&self) -> &'a Stone {
        self.stone
    }

    /// The welded facets.
    pub fn facets(&self) -> &Facets {
        &self.facets
    }

    /// Follows a parallel beam along every facet sequence.
    ///
    /// - `light`: what falls on the stone, power 1
    /// - `until`: when beams are left to the caller
    ///
    /// A stone without light on it (a direction that is not a number) gives totals of 0.
    pub fn follow<L: Light, const K: usize>(
        &self,
        lit: &Lit<K>,
        light: L,
        until: Until,
        watch: &mut impl Watch<L, K>,
    ) -> Totals {
        dispatch::follow(self.stone, run::Run::new(self, lit, until, watch), light)
    }
}
