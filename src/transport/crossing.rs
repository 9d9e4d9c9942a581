//! Photons through the stone: each goes in with its whole power and comes out by one exit.

use crate::scene::PlacedStone;
use crate::walk::{LANES, Packet};
use glam::Vec3;

/// A photon that is about to enter, in the walking frame.
#[derive(Debug, Clone, Copy)]
pub struct Arrival {
    /// Facet it meets.
    pub facet: usize,
    /// Where.
    pub point: Vec3,
    /// Unit direction.
    pub direction: Vec3,
    /// Index of the stone at the photon's wavelength.
    pub index: f32,
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
    /// Share of its power that it keeps: all that leaves the stone by any way.
    pub share: f32,
}

/// A photon inside is followed until this share of its power is left; the rest, under a tenth of a
/// percent, is lost.
const STOP_SHARE: f32 = 1e-3;

/// Takes up to [`LANES`] photons through the stone together.
///
/// Every way out, the reflection at entry among them, is chosen with a probability proportional to
/// its power, so each photon goes on alone and the mean over photons is right. One uniform number
/// serves all choices: it is stretched back to (0, 1) after each.
pub fn cross(placed: &PlacedStone, arrivals: &[Arrival], departures: &mut [Option<Departure>]) {
    debug_assert!(arrivals.len() <= LANES && departures.len() == arrivals.len());
    let stone = &placed.stone;
    let mut packet = Packet::default();
    let mut total = [0f64; LANES];
    let mut choice = [0f64; LANES];
    let mut chosen = [None; LANES];
    for (lane, a) in arrivals.iter().enumerate() {
        let entry = stone.enter(a.facet, a.direction, a.index);
        let normal = stone.normals[a.facet];
        let reflected = a.direction - 2.0 * a.direction.dot(normal) * normal;
        chosen[lane] = Some((a.point, reflected));
        total[lane] = entry.reflectance.into();
        choice[lane] = a.choice;
        packet.set(lane, a.point, entry.direction, 1.0 - entry.reflectance, a.index);
    }
    stone.walk(&mut packet, STOP_SHARE, |meeting, packet| {
        for lane in 0..arrivals.len() {
            let Some(exit) = meeting.exit(packet, lane) else { continue };
            let power = f64::from(exit.power);
            total[lane] += power;
            let take = power / total[lane];
            if choice[lane] < take {
                choice[lane] /= take;
                chosen[lane] = Some((exit.point, exit.direction));
            } else {
                choice[lane] = (choice[lane] - take) / (1.0 - take);
            }
        }
    });
    for (lane, departure) in departures.iter_mut().enumerate() {
        *departure = chosen[lane].map(|(point, direction)| Departure {
            point,
            direction: direction.normalize(),
            share: total[lane] as f32,
        });
    }
}
