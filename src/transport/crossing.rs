//! Photons through a stone: each goes in with its whole power and comes out by one exit.

use super::Arrival;
use crate::scene::PlacedStone;
use crate::walk::feed::{self, Rays};
use crate::walk::{LANES, Meeting, Packet};
use glam::Vec3;

/// A photon that is about to enter.
#[derive(Debug, Clone, Copy)]
pub struct Entering {
    /// How it arrives.
    pub arrival: Arrival,
    /// Its wavelength, nm.
    pub nm: f32,
    /// One uniform number, by which the exit is chosen.
    pub choice: f64,
}

/// How a photon leaves, in the walking frame.
#[derive(Debug, Clone, Copy)]
pub struct Departure {
    /// Where.
    pub point: Vec3,
    /// Unit direction outside.
    pub direction: Vec3,
    /// Share of its power that it keeps: all that is not absorbed and leaves the stone by any way.
    pub share: f32,
}

/// A photon inside is followed until this share of its power is left; the rest, under a tenth of a
/// percent, is lost.
const STOP_SHARE: f32 = 1e-3;

/// Takes photons through the stone, each to the departure of its number.
///
/// Every way out, the reflection at entry among them, is chosen with a probability proportional to
/// its power, so each photon goes on alone and the mean over photons is right. One uniform number
/// serves all choices: it is stretched back to (0, 1) after each.
///
/// - `most_meetings`: with facets inside, after which a photon that is still there is lost
pub fn cross(placed: &PlacedStone, most_meetings: u32, arrivals: &[Entering]) -> Vec<Departure> {
    let mut crossing = Crossing {
        placed,
        most_meetings,
        arrivals: arrivals.iter(),
        departures: Vec::with_capacity(arrivals.len()),
        photon: [0; LANES],
        choice: [0.0; LANES],
        total: [0.0; LANES],
    };
    feed::walk_all(&placed.stone, STOP_SHARE, &mut crossing);
    for (departure, arrival) in crossing.departures.iter_mut().zip(arrivals) {
        departure.direction = departure.direction.normalize_or(arrival.arrival.direction);
    }
    crossing.departures
}

struct Crossing<'a> {
    placed: &'a PlacedStone,
    most_meetings: u32,
    arrivals: std::slice::Iter<'a, Entering>,
    departures: Vec<Departure>,
    /// For each lane: which photon it carries, the number that chooses, the power that has left.
    photon: [usize; LANES],
    choice: [f64; LANES],
    total: [f64; LANES],
}

impl Rays for Crossing<'_> {
    const WIDTH: usize = 1;

    fn polarised(&self) -> bool {
        self.placed.polarised
    }

    fn absorbing(&self) -> bool {
        !self.placed.material.is_clear()
    }

    fn most_meetings(&self) -> u32 {
        self.most_meetings
    }

    fn next(&mut self, packet: &mut Packet, lane: usize) -> bool {
        let Some(Entering { arrival, nm, choice }) = self.arrivals.next() else { return false };
        let stone = &self.placed.stone;
        let index = self.placed.index(*nm);
        let entry = stone.enter(arrival.facet, arrival.direction, index);
        packet.enter(lane, arrival.point, &entry, index);
        packet.absorption[lane] = self.placed.absorption(*nm);
        self.photon[lane] = self.departures.len();
        self.choice[lane] = *choice;
        self.total[lane] = entry.reflectance.into();
        let direction = stone.reflect(arrival.facet, arrival.direction);
        self.departures.push(Departure { point: arrival.point, direction, share: entry.reflectance });
        true
    }

    fn meet(&mut self, meeting: &Meeting, packet: &Packet) {
        for lane in 0..LANES {
            let Some(exit) = meeting.exit(packet, lane) else { continue };
            let departure = &mut self.departures[self.photon[lane]];
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
