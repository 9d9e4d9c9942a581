//! Scattering of photons by a stone: each goes in with its whole power and comes out by one exit.

use crate::scene::PlacedStone;
use crate::scene::intersection::StoneHit;
use crate::trace::lane_scheduler::{self, RayClient};
use crate::trace::{Interaction, LANES, Packet};
use glam::Vec3;

/// A photon that is about to enter.
#[derive(Debug, Clone, Copy)]
pub struct IncidentPhoton {
    /// How it arrives.
    pub hit: StoneHit,
    /// Its wavelength, nm.
    pub nm: f32,
    /// One uniform number, by which the exit is chosen.
    pub choice: f64,
}

/// How a photon leaves, in the trace frame.
#[derive(Debug, Clone, Copy)]
pub struct ScatteredPhoton {
    /// Point of exit.
    pub point: Vec3,
    /// Unit direction outside.
    pub direction: Vec3,
    /// Share of its power that it keeps: all that is not absorbed and leaves the stone by any way.
    pub share: f32,
}

/// A photon inside is followed until this share of its power is left; the rest, under a tenth of a
/// percent, is lost.
const STOP_SHARE: f32 = 1e-3;

/// Scatters photons by the stone; returns them in the order of `arrivals`.
///
/// Every way out, the reflection at entry among them, is chosen with a probability proportional to
/// its power, so each photon goes on alone and the mean over photons is right. One uniform number
/// serves all choices: it is stretched back to (0, 1) after each.
///
/// - `max_bounces`: facets met inside after which a photon that is still there is lost
pub fn scatter(placed: &PlacedStone, max_bounces: u32, arrivals: &[IncidentPhoton]) -> Vec<ScatteredPhoton> {
    let mut crossing = ScatteringClient {
        placed,
        max_bounces,
        photons: arrivals.iter(),
        scattered: Vec::with_capacity(arrivals.len()),
        photon: [0; LANES],
        choice: [0.0; LANES],
        total: [0.0; LANES],
    };
    lane_scheduler::trace_all(&placed.stone, STOP_SHARE, &mut crossing);
    for (departure, arrival) in crossing.scattered.iter_mut().zip(arrivals) {
        departure.direction = departure.direction.normalize_or(arrival.hit.direction);
    }
    crossing.scattered
}

struct ScatteringClient<'a> {
    placed: &'a PlacedStone,
    max_bounces: u32,
    photons: std::slice::Iter<'a, IncidentPhoton>,
    scattered: Vec<ScatteredPhoton>,
    /// For each lane: which photon it carries, the number that chooses, the power that has left.
    photon: [usize; LANES],
    choice: [f64; LANES],
    total: [f64; LANES],
}

impl RayClient for ScatteringClient<'_> {
    const WIDTH: usize = 1;

    fn polarised(&self) -> bool {
        self.placed.polarised
    }

    fn absorbing(&self) -> bool {
        !self.placed.material.is_clear()
    }

    fn max_bounces(&self) -> u32 {
        self.max_bounces
    }

    fn load(&mut self, packet: &mut Packet, lane: usize) -> bool {
        let Some(IncidentPhoton { hit: arrival, nm, choice }) = self.photons.next() else { return false };
        let stone = &self.placed.stone;
        let index = self.placed.index(*nm);
        let entry = stone.refract_into(arrival.facet, arrival.direction, index);
        packet.load_refracted(lane, arrival.point, &entry, index);
        packet.absorption[lane] = self.placed.absorption(*nm);
        self.photon[lane] = self.scattered.len();
        self.choice[lane] = *choice;
        self.total[lane] = entry.reflectance.into();
        let direction = stone.reflect(arrival.facet, arrival.direction);
        self.scattered.push(ScatteredPhoton { point: arrival.point, direction, share: entry.reflectance });
        true
    }

    fn interact(&mut self, interaction: &Interaction, packet: &Packet) {
        for lane in 0..LANES {
            let Some(exit) = interaction.exit(packet, lane) else { continue };
            let departure = &mut self.scattered[self.photon[lane]];
            let power = f64::from(exit.power);
            self.total[lane] += power;
            departure.share = self.total[lane] as f32;
            let take = power / self.total[lane];
            let choice = &mut self.choice[lane];
            if *choice < take {
                *choice /= take;
                (departure.point, departure.direction) = (exit.point, exit.direction);
            } else {
                *choice = (*choice - take) / (1.0 - take);
            }
        }
    }
}
