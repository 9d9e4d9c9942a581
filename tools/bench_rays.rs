//! The light of the benchmarks: vertical and slanting rays on a stone, counted.

use cutlab::advanced::sampling::{
    random::{Purpose, Stream},
    warps,
};
use cutlab::advanced::trace::lane_scheduler::RayClient;
use cutlab::advanced::trace::{ConvexStone, Interaction, Packet};

/// Diamond at the D line.
pub const INDEX: f32 = 2.417;

/// A ray with less power is given up.
pub const STOP_POWER: f32 = 1e-4;

/// Rays from a cone of 60° about the vertical, onto a disc a little smaller than the stone.
pub struct Shower<'a> {
    stone: &'a ConvexStone,
    stream: Stream,
    left: u64,
    polarised: bool,
    /// What the stone takes, per trace unit.
    pub absorption: f32,
    /// Interactions of whole packets so far.
    pub bounces: u64,
    /// Packets as they leave their facets, while there is room.
    pub kept: Vec<Packet>,
}

impl<'a> Shower<'a> {
    /// - `rays`: how many are aimed; some miss
    pub fn new(stone: &'a ConvexStone, rays: u64, polarised: bool) -> Self {
        let stream = Stream::new(1, Purpose::TEST, 0);
        Shower { stone, stream, left: rays, polarised, absorption: 0.0, bounces: 0, kept: Vec::new() }
    }
}

impl RayClient for Shower<'_> {
    const WIDTH: usize = 1;

    fn polarised(&self) -> bool {
        self.polarised
    }

    fn absorbing(&self) -> bool {
        self.absorption > 0.0
    }

    fn load(&mut self, packet: &mut Packet, lane: usize) -> bool {
        while self.left > 0 {
            self.left -= 1;
            let toward = -warps::uniform_cone(self.stream.pair(), 0.5);
            let target = warps::uniform_disc(self.stream.pair()).extend(0.0) * 0.9;
            if let Some(hit) = self.stone.intersect(target - 3.0 * toward, toward) {
                let entry = self.stone.refract_into(hit.facet, toward, INDEX);
                packet.load_refracted(lane, target + (hit.distance - 3.0) * toward, &entry, INDEX);
                packet.absorption[lane] = self.absorption;
                return true;
            }
        }
        false
    }

    fn interact(&mut self, _: &Interaction, packet: &Packet) {
        self.bounces += 1;
        let full = packet.power.iter().all(|p| *p > 0.0);
        // some interactions apart, so that the packets kept are of many rays
        if full && self.kept.len() < self.kept.capacity() && self.bounces.is_multiple_of(7) {
            self.kept.push(packet.clone());
        }
    }
}
