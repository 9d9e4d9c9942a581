//! Tracing: light inside a convex stone, and inside stones that are not convex ([`nonconvex`]).
//!
//! A ray inside never branches. At every facet it leaves the transmitted part of its power outside,
//! in one direction, and goes on with the rest. Photons that build a map, rays that are counted for
//! a score and camera rays that look into the stone are all consumers of [`ConvexStone::trace`].

pub mod beams;
mod branches;
pub mod crystal;
mod crystal_entry;
mod crystal_lanes;
mod dispatch;
mod exponential;
mod girdle;
mod intersect;
mod kernel;
pub mod lane_scheduler;
mod lanes;
mod met_facets;
pub mod nonconvex;
mod packet;
pub mod reference;
mod stone;
mod uniaxial_kernel;

pub use crystal_lanes::{CrystalLanes, LoadedWave};
pub use dispatch::Isa;
pub use lanes::{LANES, Lanes};
pub use packet::{FacetHit, Interaction, NO_FACET, NextFacets, Packet, RayExit, Refraction};
pub use stone::ConvexStone;

/// Most bounces of a trace; power that a lane still holds then is lost. A guard against rays that total
/// reflection keeps for ever: the quality is set by the stop power.
pub const MAX_BOUNCES: u32 = 20_000;

impl ConvexStone {
    /// Traces a packet until no lane holds more than `stop_power`.
    ///
    /// - `packet`: lanes with positions inside or on the stone, unit directions, index of refraction and
    ///   power; lanes without power are idle
    /// - `stop_power`: a lane with less is stopped, its power added to the returned loss
    /// - `visit`: called after each interaction with what left the stone there and what the stone
    ///   absorbed on the way there
    ///
    /// Returns the power given up, summed over the lanes. What entered = Σ exits + Σ absorbed + lost to
    /// rounding. Checked in `tests/library/trace/` against [`mod@reference`] and by energy balance.
    pub fn trace(
        &self,
        packet: &mut Packet,
        stop_power: f32,
        mut visit: impl FnMut(&Interaction, &mut Packet),
    ) -> f32 {
        let mut lost = 0.0;
        let mut interaction = Interaction::default();
        for _ in 0..MAX_BOUNCES {
            lost += packet.stop_below(stop_power);
            if packet.is_spent() {
                return lost;
            }
            kernel::interact(self, packet, &mut interaction);
            lost += interaction.lost;
            visit(&interaction, packet);
        }
        lost + packet.stop_below(f32::INFINITY)
    }
}
