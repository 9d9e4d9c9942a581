//! Branches: waves of a doubly refracting stone that wait while the other wave of their facet is followed.

use super::lanes::LANES;
use super::packet::Packet;
use glam::Vec3;
use std::ops::Range;

/// Branches of one lane at most; of more the strongest are followed and the others go on by chance.
const MOST: usize = 64;

/// A wave that waits.
#[derive(Debug, Clone, Copy)]
struct Branch {
    point: Vec3,
    wave_vector: Vec3,
    is_extraordinary: bool,
    power: f32,
    path: f32,
    /// What the client knows of the path so far.
    state: f32,
}

/// The branches of all lanes of a packet.
#[derive(Debug, Default)]
pub(super) struct Branches {
    of: [Vec<Branch>; LANES],
}

impl Branches {
    /// Takes the waves of some lanes that were not chosen at their last facets and hold more than a share of the light: a
    /// lane then goes on with its own wave alone.
    ///
    /// - `state`: what the client knows of the path of a lane
    pub(super) fn take(
        &mut self,
        packet: &mut Packet,
        lanes: Range<usize>,
        above: f32,
        state: impl Fn(usize) -> f32,
    ) {
        for lane in lanes {
            let Some(waves) = &packet.waves else { return };
            let (power, waiting) = (waves.other[lane], &mut self.of[lane]);
            if power <= above || waiting.len() >= MOST || packet.power[lane] <= 0.0 {
                continue;
            }
            waiting.push(Branch {
                point: packet.point(lane),
                wave_vector: Vec3::new(waves.other_kx[lane], waves.other_ky[lane], waves.other_kz[lane]),
                is_extraordinary: waves.mode[lane] < 0.5,
                power,
                path: packet.path[lane],
                state: state(lane),
            });
            packet.power[lane] = (packet.power[lane] - power).max(0.0);
        }
    }

    /// The power of all waves that wait.
    pub(super) fn power(&self) -> f64 {
        self.of.iter().flatten().map(|branch| f64::from(branch.power)).sum()
    }

    /// Puts the next waiting wave of some lanes into each; false if none of them has one.
    ///
    /// - `resume`: tells the client what it knew of the path of a lane
    pub(super) fn resume(
        &mut self,
        packet: &mut Packet,
        lanes: Range<usize>,
        mut resume: impl FnMut(usize, f32),
    ) -> bool {
        if self.of[lanes.clone()].iter().all(Vec::is_empty) {
            return false;
        }
        for lane in lanes {
            let Some(branch) = self.of[lane].pop() else {
                packet.power[lane] = 0.0;
                continue;
            };
            packet.resume(lane, branch.point, branch.wave_vector, branch.is_extraordinary);
            (packet.power[lane], packet.path[lane]) = (branch.power, branch.path);
            resume(lane, branch.state);
        }
        true
    }
}
