//! Keeps the lanes of a packet busy: a ray that is spent makes room for the next.
//!
//! Rays of a brilliant live for 34 meetings on average, the longest of sixteen for 116; a packet
//! that waited for its longest ray would idle two thirds of its lanes.

use super::{LANES, Meeting, Packet, Stone};

/// So many rays are fed into one walk before it drains: far fewer meetings than
/// [`super::MEETINGS_LIMIT`], so that a ray which total reflection keeps for ever ends there.
const RAYS_A_WALK: usize = 2048;

/// Rays for the lanes, and what becomes of them.
pub trait Rays {
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

    /// Whether a ray is at its end when it holds less than the stop power times what it has let out so
    /// far, instead of what it began with: of a dark stone so little comes out that what is given up
    /// would exceed it. For rays of power 1.
    fn ends_by_what_came_out(&self) -> bool {
        false
    }

    /// After so many meetings a ray is at its end whatever power it holds, which counts as given up.
    fn most_meetings(&self) -> u32 {
        u32::MAX
    }

    /// Puts the next ray into the lanes from `lane` on; false if there is none left.
    fn next(&mut self, packet: &mut Packet, lane: usize) -> bool;

    /// Whether the ray in the lanes from `lane` on need not be followed further, whatever its power.
    fn is_done(&self, _lane: usize) -> bool {
        false
    }

    /// Sees what all lanes leave at a meeting.
    fn meet(&mut self, meeting: &Meeting, packet: &Packet);

    /// The ray in the lanes from `lane` on is at its end.
    fn ended(&mut self, _lane: usize) {}
}

/// A ray that ends by what came out is given up below this all the same.
const FAINTEST: f32 = 1e-9;

/// Walks all rays until each holds less than `stop_power` in every lane; returns the power given
/// up.
pub fn walk_all<R: Rays>(stone: &Stone, stop_power: f32, rays: &mut R) -> f64 {
    let mut lost = 0.0;
    let mut more = true;
    let by_what_came_out = rays.ends_by_what_came_out();
    let floor = if by_what_came_out { FAINTEST.min(stop_power) } else { stop_power };
    while more {
        let mut packet = Packet { absorbing: rays.absorbing(), ..Packet::new(rays.polarised()) };
        let mut fed = 0;
        let lanes = || (0..LANES / R::WIDTH).map(|i| i * R::WIDTH);
        let mut alive = [false; LANES];
        let mut meetings = [0; LANES];
        let mut came_out = [0.0f32; LANES];
        let most = rays.most_meetings();
        for lane in lanes() {
            more = more && rays.next(&mut packet, lane);
            alive[lane] = more;
            fed += 1;
        }
        let rest = stone.walk(&mut packet, floor, |meeting, packet| {
            rays.meet(meeting, packet);
            for lane in lanes() {
                let powers = &mut packet.power[lane..lane + R::WIDTH];
                meetings[lane] += 1;
                let lit = if by_what_came_out {
                    came_out[lane] += meeting.power[lane..lane + R::WIDTH].iter().sum::<f32>();
                    powers.iter().sum::<f32>() > stop_power * came_out[lane]
                } else {
                    powers.iter().any(|p| *p >= stop_power)
                };
                let goes_on = lit && meetings[lane] < most && !rays.is_done(lane);
                if !alive[lane] || goes_on {
                    continue;
                }
                (meetings[lane], came_out[lane]) = (0, 0.0);
                lost += powers.iter().map(|p| f64::from(*p)).sum::<f64>();
                powers.fill(0.0);
                rays.ended(lane);
                more = more && (fed >= RAYS_A_WALK || rays.next(packet, lane));
                alive[lane] = more && fed < RAYS_A_WALK;
                fed += 1;
            }
        });
        lost += f64::from(rest);
        // rays that the walk gave up
        for lane in lanes().filter(|l| alive[*l]) {
            rays.ended(lane);
        }
    }
    lost
}
