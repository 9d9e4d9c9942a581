//! Exact beams: tracing of polygons instead of rays.
//!
//! A parallel beam that enters through one facet stays parallel along each sequence of facets, and
//! its footprint is a convex polygon clipped facet by facet: the "virtual facets" of J. Sasián et
//! al. (*Optical Engineering* 46 (2007) 093604). Adding up the polygons gives light return, ASET
//! shares and leakage without noise. What is too weak to be followed is handed to the caller, who
//! may finish it by photons ([`residual`]). Checked in `tests/library/beams.rs` against an independent
//! tracer's figures, and against photons for every cut of the library.

mod beam_coords;
mod beam_light;
mod beam_tracer;
mod beam_visitor;
mod clip;
mod energy_budget;
mod facets;
mod queue;
pub mod residual;
mod sector;

pub use beam_coords::{BeamCoords, EntryFacet};
pub use beam_light::{BeamLight, Interface, UnpolarisedLight};
pub use beam_visitor::{BeamExit, BeamVisitor, IncidentBeam, ResidualBeam};
pub use energy_budget::{EnergyBudget, MAX_FACETS, StopCriteria};
pub use facets::{WELD_DISTANCE, WeldedFacets};

use super::ConvexStone;
use beam_tracer::BeamTracer;
use sector::StoneSymmetry;

/// A stone made ready for beams.
#[derive(Debug, Clone)]
pub struct Beams<'a> {
    stone: &'a ConvexStone,
    facets: WeldedFacets,
    /// By which one sector may stand for the whole stone.
    symmetry: Option<StoneSymmetry>,
}

impl<'a> Beams<'a> {
    /// Welds the corners of a stone.
    pub fn new(stone: &'a ConvexStone) -> Self {
        Beams { stone, facets: WeldedFacets::new(stone), symmetry: None }
    }

    /// The same for sums that stay as they are when a symmetric stone is turned or mirrored into itself: of
    /// light along its axis, or along a mirror plane, one sector is followed for the whole. Sums are those of
    /// [`Beams::new`] to a part in a million. Checked in `tests/library/objective.rs`.
    pub fn by_symmetry(stone: &'a ConvexStone) -> Self {
        Beams { symmetry: Some(StoneSymmetry::of_stone(stone)), ..Beams::new(stone) }
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
        let sector = self.symmetry.and_then(|symmetry| symmetry.sector(lit.direction));
        self.stone.isa.run(BeamTracer::new(self.stone, (&self.facets, sector), lit, light, until, watch))
    }
}
