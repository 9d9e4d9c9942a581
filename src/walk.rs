//! The walk: light inside a convex stone, and inside others ([`mesh`]).
//!
//! A ray inside never branches. At every facet it leaves the transmitted part of its power outside,
//! in one direction, and goes on with the rest. Photons that build a map, rays that are counted for
//! a score and camera rays that look into the stone are all consumers of [`Stone::walk`].

pub mod beams;
mod belt;
mod dispatch;
pub mod feed;
mod kernel;
pub mod mesh;
mod packet;
pub mod scalar;
mod search;
mod stone;

pub use dispatch::Isa;
pub use packet::{Exit, LANES, Lanes, Meeting, NO_FACET, NextFacets, Packet};
pub use stone::{Entry, Hit, Stone};

/// After so many meetings whatever power a lane still holds is given up as lost. A guard against
/// rays that total reflection keeps for ever, not a quality setting: power is what stops a walk.
pub const MEETINGS_LIMIT: u32 = 20_000;

impl Stone {
    /// Walks a packet until no lane holds more than `stop_power`.
    ///
    /// - `packet`: lanes with positions inside or on the stone, unit directions, index of
    ///   refraction and power; lanes without power stand still
    /// - `stop_power`: a lane with less is stopped, its power added to the returned loss
    /// - `visit`: called after each meeting with what left the stone there and what the stone
    ///   absorbed on the way there
    ///
    /// Returns the power given up, summed over the lanes. What entered = Σ exits + Σ absorbed +
    /// lost to rounding. Checked in `tests/walk.rs` against the `f64` twin and by energy balance.
    pub fn walk(
        &self,
        packet: &mut Packet,
        stop_power: f32,
        mut visit: impl FnMut(&Meeting, &mut Packet),
    ) -> f32 {
        let mut lost = 0.0;
        let mut meeting = Meeting::default();
        for _ in 0..MEETINGS_LIMIT {
            lost += packet.stop_below(stop_power);
            if packet.is_spent() {
                return lost;
            }
            dispatch::meet(self, packet, &mut meeting);
            lost += meeting.lost;
            visit(&meeting, packet);
        }
        lost + packet.stop_below(f32::INFINITY)
    }
}
