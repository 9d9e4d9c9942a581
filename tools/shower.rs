//! The light of the benchmarks: vertical and slanting rays on a stone, counted.

use cutlab::math::{
    random::{Purpose, Stream},
    sample,
};
use cutlab::walk::feed::Rays;
use cutlab::walk::{Meeting, Packet, Stone};

/// Diamond at the D line.
pub const INDEX: f32 = 2.417;

/// A ray with less power is given up.
pub const STOP_POWER: f32 = 1e-4;

/// Rays from a cone of 60° about the vertical, onto a disc a little smaller than the stone.
pub struct Shower<'a> {
    stone: &'a Stone,
    stream: Stream,
    left: u64,
    polarised: bool,
    /// What the stone takes, per walking unit.
    pub absorption: f32,
    /// Meetings of whole packets so far.
    pub meetings: u64,
    /// Packets as they leave their facets, while there is room.
    pub kept: Vec<Packet>,
}

impl<'a> Shower<'a> {
    /// - `rays`: how many are aimed; some miss
    pub fn new(stone: &'a Stone, rays: u64, polarised: bool) -> Self {
        let stream = Stream::new(1, Purpose::Test, 0);
        Shower { stone, stream, left: rays, polarised, absorption: 0.0, meetings: 0, kept: Vec::new() }
    }
}

impl Rays for Shower<'_> {
    const WIDTH: usize = 1;

    fn polarised(&self) -> bool {
        self.polarised
    }

    fn absorbing(&self) -> bool {
        self.absorption > 0.0
    }

    fn next(&mut self, packet: &mut Packet, lane: usize) -> bool {
        while self.left > 0 {
            self.left -= 1;
            let toward = -sample::cone(self.stream.pair(), 0.5);
            let target = sample::disc(self.stream.pair()).extend(0.0) * 0.9;
            if let Some(hit) = self.stone.hit(target - 3.0 * toward, toward) {
                let entry = self.stone.enter(hit.facet, toward, INDEX);
                packet.enter(lane, target + (hit.distance - 3.0) * toward, &entry, INDEX);
                packet.absorption[lane] = self.absorption;
                return true;
            }
        }
        false
    }

    fn meet(&mut self, _: &Meeting, packet: &Packet) {
        self.meetings += 1;
        let full = packet.power.iter().all(|p| *p > 0.0);
        // some meetings apart, so that the packets kept are of many rays
        if full && self.kept.len() < self.kept.capacity() && self.meetings.is_multiple_of(7) {
            self.kept.push(packet.clone());
        }
    }
}
