//! Lane scheduler: a ray that is spent makes room for the next, so that all lanes of a packet stay busy.
//!
//! Rays of a brilliant live for 34 bounces on average, the longest of sixteen for 116; a packet
//! that waited for its longest ray would idle two thirds of its lanes.

use super::branches::Branches;
use super::crystal_lanes::CrystalLanes;
use super::{ConvexStone, Interaction, LANES, Packet};
use glam::DVec3;

/// Rays that are loaded into one packet before it drains: far fewer bounces than
/// [`super::MAX_BOUNCES`], so that a ray which total reflection keeps for ever ends there.
const RAYS_PER_PACKET: usize = 2048;

/// Where light enters a stone that refracts doubly, both waves are followed if each holds more than this share of it.
const BOTH_ENTER: f32 = 0.02;

/// A client of the tracer: gives rays to the lanes and sees what becomes of them.
pub trait RayClient {
    /// Lanes that one ray takes (its wavelengths), next to each other.
    const WIDTH: usize;

    /// Whether polarisation is followed.
    fn polarised(&self) -> bool {
        false
    }

    /// Whether the stone absorbs: [`Packet::absorption`] then counts.
    fn absorbing(&self) -> bool {
        false
    }

    /// The optic axis of a stone that refracts doubly, unit, in its frame: waves are followed then
    /// ([`Packet::waves`]), and no Stokes vector.
    fn optic_axis(&self) -> Option<DVec3> {
        None
    }

    /// Both waves of a facet are followed where each holds more than this share of a ray's light; else one of them by
    /// chance, with the power of both. For what is no sum of power.
    fn branches_above(&self) -> Option<f32> {
        None
    }

    /// What is known of the path in a lane, to go on with when another branch of it has ended.
    fn path_state(&self, _lane: usize) -> f32 {
        0.0
    }

    /// Another branch of the ray goes on in a lane.
    fn resume(&mut self, _lane: usize, _state: f32) {}

    /// Whether the stop power is relative to what a ray has emitted so far, instead of to its initial power
    /// of 1: a dark stone emits so little that what is given up would exceed it.
    fn stops_by_emitted_power(&self) -> bool {
        false
    }

    /// Most bounces of a ray; power that it still holds then counts as given up.
    fn max_bounces(&self) -> u32 {
        u32::MAX
    }

    /// Puts the next ray into the lanes from `lane` on; false if there is none left.
    fn load(&mut self, packet: &mut Packet, lane: usize) -> bool;

    /// Whether the ray in the lanes from `lane` on need not be followed further, whatever its power.
    fn is_done(&self, _lane: usize) -> bool {
        false
    }

    /// Sees what all lanes leave at an interaction.
    fn interact(&mut self, interaction: &Interaction, packet: &Packet);

    /// The ray in the lanes from `lane` on is at its end.
    fn finish(&mut self, _lane: usize) {}
}

/// Least power of a ray whose stop power is relative to what it has emitted.
const MIN_POWER: f32 = 1e-9;

/// Traces all rays until each holds less than `stop_power` in every lane; returns the power given
/// up.
pub fn trace_all<R: RayClient>(stone: &ConvexStone, stop_power: f32, rays: &mut R) -> f64 {
    let mut lost = 0.0;
    let mut more = true;
    let by_what_came_out = rays.stops_by_emitted_power();
    let floor = if by_what_came_out { MIN_POWER.min(stop_power) } else { stop_power };
    while more {
        let waves = rays.optic_axis().map(|axis| Box::new(CrystalLanes::new(axis)));
        let polarised = rays.polarised() && waves.is_none();
        let mut packet = Packet { absorbing: rays.absorbing(), waves, ..Packet::new(polarised) };
        let doubles = packet.waves.is_some();
        let above = rays.branches_above().filter(|_| doubles);
        let mut branches = Branches::default();
        let mut fed = 0;
        let lanes = || (0..LANES / R::WIDTH).map(|i| i * R::WIDTH);
        let mut alive = [false; LANES];
        let mut bounces = [0; LANES];
        let mut came_out = [0.0f32; LANES];
        let most = rays.max_bounces();
        for lane in lanes() {
            more = more && rays.load(&mut packet, lane);
            if doubles && more {
                branches.take(&mut packet, lane..lane + R::WIDTH, BOTH_ENTER, |lane| rays.path_state(lane));
            }
            alive[lane] = more;
            fed += 1;
        }
        let rest = stone.trace(&mut packet, floor, |interaction, packet| {
            rays.interact(interaction, packet);
            for lane in lanes() {
                if let Some(above) = above {
                    branches.take(packet, lane..lane + R::WIDTH, above, |lane| rays.path_state(lane));
                }
                let powers = &mut packet.power[lane..lane + R::WIDTH];
                bounces[lane] += 1;
                let lit = if by_what_came_out {
                    came_out[lane] += interaction.power[lane..lane + R::WIDTH].iter().sum::<f32>();
                    powers.iter().sum::<f32>() > stop_power * came_out[lane]
                } else {
                    powers.iter().any(|p| *p >= stop_power)
                };
                let goes_on = lit && bounces[lane] < most && !rays.is_done(lane);
                if !alive[lane] || goes_on {
                    continue;
                }
                (bounces[lane], came_out[lane]) = (0, 0.0);
                lost += powers.iter().map(|p| f64::from(*p)).sum::<f64>();
                powers.fill(0.0);
                if doubles
                    && branches.resume(packet, lane..lane + R::WIDTH, |lane, state| rays.resume(lane, state))
                {
                    continue;
                }
                rays.finish(lane);
                more = more && (fed >= RAYS_PER_PACKET || rays.load(packet, lane));
                if doubles && more && fed < RAYS_PER_PACKET {
                    branches.take(packet, lane..lane + R::WIDTH, BOTH_ENTER, |lane| rays.path_state(lane));
                }
                alive[lane] = more && fed < RAYS_PER_PACKET;
                fed += 1;
            }
        });
        lost += f64::from(rest);
        // rays that the tracer gave up, and what waited of them
        lost += branches.power();
        for lane in lanes().filter(|l| alive[*l]) {
            rays.finish(lane);
        }
    }
    lost
}
