//! Lane scheduler: a ray that is spent makes room for the next, so that all lanes of a packet stay busy.
//!
//! Rays of a brilliant live for 34 bounces on average, the longest of sixteen for 116; a packet
//! that waited for its longest ray would idle two thirds of its lanes.

use super::{ConvexStone, Interaction, LANES, Packet};

/// Rays that are loaded into one packet before it drains: far fewer bounces than
/// [`super::MAX_BOUNCES`], so that a ray which total reflection keeps for ever ends there.
const RAYS_PER_PACKET: usize = 2048;

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

    /// Whether the stop power is relative to what a ray has emitted so far, instead of to its initial power
    /// of 1: a dark stone emits so little that what is given up would exceed it.
    fn stops_by_emitted_power(&self) -> bool {
        false
    }

    /// After so many bounces a ray is at its end whatever power it holds, which counts as given up.
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
        let mut packet = Packet { absorbing: rays.absorbing(), ..Packet::new(rays.polarised()) };
        let mut fed = 0;
        let lanes = || (0..LANES / R::WIDTH).map(|i| i * R::WIDTH);
        let mut alive = [false; LANES];
        let mut bounces = [0; LANES];
        let mut came_out = [0.0f32; LANES];
        let most = rays.max_bounces();
        for lane in lanes() {
            more = more && rays.load(&mut packet, lane);
            alive[lane] = more;
            fed += 1;
        }
        let rest = stone.trace(&mut packet, floor, |interaction, packet| {
            rays.interact(interaction, packet);
            for lane in lanes() {
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
                rays.finish(lane);
                more = more && (fed >= RAYS_PER_PACKET || rays.load(packet, lane));
                alive[lane] = more && fed < RAYS_PER_PACKET;
                fed += 1;
            }
        });
        lost += f64::from(rest);
        // rays that the tracer gave up
        for lane in lanes().filter(|l| alive[*l]) {
            rays.finish(lane);
        }
    }
    lost
}
