//! Which facet comes next: the search that the walk waits for, and the first facet of a ray from
//! outside.
//!
//! Plain Rust over arrays as wide as a register; the compiler turns each inner loop into one vector
//! instruction once `dispatch.rs` has named the instruction set. `FUSED` says whether a fused
//! multiply-add is an instruction (a library call otherwise).

// the lanes of a dozen arrays in lockstep: an index is what says so, and what vectorises
#![allow(clippy::needless_range_loop)]

use super::belt::{Belt, Planes};
use super::packet::{LANES, Lanes, NO_FACET, NextFacets, Packet};
use super::stone::{Hit, Row, Stone};
use glam::Vec3;

/// Least height above a plane that a point inside is given: a point that rounding put outside
/// meets that plane at once, if it heads for it.
const LEAST_HEIGHT: f32 = 1e-9;

#[inline(always)]
pub(super) fn mul_add<const FUSED: bool>(a: f32, b: f32, c: f32) -> f32 {
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}

/// `W` rays of a packet.
struct Rays<const W: usize> {
    /// Positions with their signs turned: heights are then three multiply-adds.
    back: [[f32; W]; 3],
    d: [[f32; W]; 3],
}

impl<const W: usize> Rays<W> {
    /// The rays of the lanes from `lane` on.
    #[inline(always)]
    fn of(p: &Packet, lane: usize) -> Self {
        let mut rays = Rays { back: [[0.0; W]; 3], d: [[0.0; W]; 3] };
        for (axis, (x, d)) in [(&p.x, &p.dx), (&p.y, &p.dy), (&p.z, &p.dz)].into_iter().enumerate() {
            for l in 0..W {
                rays.back[axis][l] = -x[lane + l];
                rays.d[axis][l] = d[lane + l];
            }
        }
        rays
    }
}

/// The facet met first among those tried, as a fraction toward / height, `W` times.
///
/// Passed and returned by value: the optimiser then keeps it in registers, where a conditional
/// store into an array costs a round trip through memory at every plane (three times the time).
#[derive(Clone, Copy)]
struct Best<const W: usize> {
    toward: [f32; W],
    height: [f32; W],
    facet: [u32; W],
}

impl<const W: usize> Best<W> {
    const NONE: Best<W> = Best { toward: [0.0; W], height: [1.0; W], facet: [NO_FACET; W] };

    /// The better of `self` and one more plane for every ray; a tie leaves the earlier one.
    #[inline(always)]
    fn or<const FUSED: bool>(self, rays: &Rays<W>, row: &Row) -> Best<W> {
        let [nx, ny, nz, d] = row.plane;
        let (mut toward, mut height) = ([0.0; W], [0.0; W]);
        for l in 0..W {
            let [dx, dy, dz] = [rays.d[0][l], rays.d[1][l], rays.d[2][l]];
            let [x, y, z] = [rays.back[0][l], rays.back[1][l], rays.back[2][l]];
            toward[l] = mul_add::<FUSED>(nx, dx, mul_add::<FUSED>(ny, dy, nz * dz));
            let above = mul_add::<FUSED>(nx, x, mul_add::<FUSED>(ny, y, mul_add::<FUSED>(nz, z, d)));
            height[l] = above.max(LEAST_HEIGHT);
        }
        self.against(Best { toward, height, facet: [row.facet; W] })
    }

    /// The better of two; a tie leaves `self`.
    #[inline(always)]
    fn against(self, other: Best<W>) -> Best<W> {
        let mut wins = [false; W];
        for l in 0..W {
            wins[l] = other.toward[l] * self.height[l] > self.toward[l] * other.height[l];
        }
        let mut best = Best::NONE;
        for l in 0..W {
            best.toward[l] = if wins[l] { other.toward[l] } else { self.toward[l] };
            best.height[l] = if wins[l] { other.height[l] } else { self.height[l] };
            best.facet[l] = if wins[l] { other.facet[l] } else { self.facet[l] };
        }
        best
    }

    /// The best of all rows, for every ray.
    ///
    /// `B` running bests take turns: each comparison waits for the one before it, and the machine
    /// has work for several such chains at once.
    #[inline(always)]
    fn of_all<const FUSED: bool, const B: usize>(rays: &Rays<W>, rows: &[Row]) -> Best<W> {
        let mut best = [Best::NONE; B];
        let rounds = rows.chunks_exact(B);
        let rest = rounds.remainder();
        for rows in rounds {
            for b in 0..B {
                best[b] = best[b].or::<FUSED>(rays, &rows[b]);
            }
        }
        let mut all = best[0];
        for other in &best[1..] {
            all = all.against(*other);
        }
        for row in rest {
            all = all.or::<FUSED>(rays, row);
        }
        all
    }
}

/// The facet that each lane meets next.
///
/// It is the argmax over i of (nᵢ·d)/(dᵢ − nᵢ·x), compared crosswise so that the loop has no
/// division and no mask: a facet that the ray leaves has a negative numerator and never wins. All
/// rays together try the sloping facets; a ray that would pass the cylinder inside the girdle's
/// flats tries those at its azimuth, on its own: one in forty in a round brilliant.
///
/// - `W`: lanes that fill a register; `B`: running bests that fit into the registers
#[inline(always)]
pub(super) fn next_facets<const FUSED: bool, const W: usize, const B: usize>(
    stone: &Stone,
    p: &Packet,
    out: &mut NextFacets,
) {
    for lane in (0..LANES).step_by(W) {
        let rays = Rays::<W>::of(p, lane);
        let best = Best::of_all::<FUSED, B>(&rays, &stone.rows);
        let (mut ends, mut end2) = ([[0.0; 2]; W], [0.0; W]);
        for l in 0..W {
            // a ray that has met nothing has no end: the quotient is infinite, or no number
            let t = best.height[l] / best.toward[l];
            let (x, y) = (t * rays.d[0][l] - rays.back[0][l], t * rays.d[1][l] - rays.back[1][l]);
            out.distance[lane + l] = t;
            out.facet[lane + l] = best.facet[l];
            ends[l] = [x, y];
            end2[l] = x * x + y * y;
        }
        let Some(belt) = &stone.belt else { continue };
        let mut within = [false; W];
        for l in 0..W {
            within[l] = end2[l] < belt.radius2;
        }
        if within == [true; W] {
            continue;
        }
        for l in 0..W {
            if within[l] {
                continue;
            }
            let (distance, flat) = nearest_flat::<FUSED>(belt, p, lane + l, ends[l]);
            if distance < out.distance[lane + l] || best.facet[l] == NO_FACET {
                (out.distance[lane + l], out.facet[lane + l]) = (distance, flat);
            }
        }
    }
}

/// The flat that one ray meets first and its distance, sought from the azimuth of its end outward.
///
/// The flats are the sides of a convex polygon, so that (nᵢ·d)/(dᵢ − nᵢ·x) has one hill as i goes
/// around: a flat that is met before both its neighbours is met before all.
#[inline(always)]
fn nearest_flat<const FUSED: bool>(belt: &Belt, p: &Packet, lane: usize, end: [f32; 2]) -> (f32, u32) {
    let count = belt.flats.len();
    let mut at = belt.facing(end[0], end[1]);
    let (mut distance, mut which) = nearest_of::<FUSED>(&belt.flats[at], p, lane);
    for step in 1..count {
        let beside = match which {
            _ if distance == f32::INFINITY => at + step,
            0 => at + count - 1,
            last if last == belt.flats[at].last => at + 1,
            _ => break,
        };
        let (other, flat) = nearest_of::<FUSED>(&belt.flats[beside % count], p, lane);
        if other < distance {
            (distance, which, at) = (other, flat, beside % count);
        } else if distance < f32::INFINITY {
            break;
        }
    }
    let met = distance < f32::INFINITY;
    (distance, if met { belt.flats[at].facet[which as usize % LANES] } else { NO_FACET })
}

/// The distance to the nearest of sixteen flats, and which it is; infinite if the ray turns away from
/// all.
#[inline(always)]
fn nearest_of<const FUSED: bool>(flats: &Planes, p: &Packet, lane: usize) -> (f32, u32) {
    let (x, y, dx, dy) = (-p.x[lane], -p.y[lane], p.dx[lane], p.dy[lane]);
    let mut keys = [0; LANES];
    for l in 0..LANES {
        let toward = mul_add::<FUSED>(flats.nx[l], dx, flats.ny[l] * dy);
        let height = mul_add::<FUSED>(flats.nx[l], x, mul_add::<FUSED>(flats.ny[l], y, flats.d[l]));
        keys[l] = (height.max(LEAST_HEIGHT) / toward).to_bits();
    }
    let (key, which) = least(&keys, &std::array::from_fn(|l| l as u32));
    // less than 0 or no number: it turns away
    let distance = f32::from_bits(key);
    (if distance >= 0.0 { distance } else { f32::INFINITY }, which)
}

/// The least key and what stands beside it; of equal keys the least of that.
///
/// Numbers that are not negative sort as their bits do, and the least of whole numbers is found in
/// any order: the compiler may halve.
#[inline(always)]
fn least(keys: &[u32; LANES], beside: &[u32; LANES]) -> (u32, u32) {
    let mut least = u64::MAX;
    for l in 0..LANES {
        least = least.min((u64::from(keys[l]) << 32) | u64::from(beside[l]));
    }
    ((least >> 32) as u32, least as u32)
}

/// Ways into half-spaces and out of them, sixteen planes side by side.
struct Crossing {
    /// The latest way in, and its facet.
    enter: Lanes,
    facet: [u32; LANES],
    /// The earliest way out.
    leave: Lanes,
}

impl Crossing {
    #[inline(always)]
    fn through<const FUSED: bool>(mut self, planes: &[Planes], o: Vec3, dir: Vec3) -> Crossing {
        for planes in planes {
            for l in 0..LANES {
                let [nx, ny, nz] = [planes.nx[l], planes.ny[l], planes.nz[l]];
                // 0.0 + 0 × -1 is 0.0: a ray along a plane never has -0.0 here
                let toward = mul_add::<FUSED>(nz, dir.z, 0.0);
                let toward = mul_add::<FUSED>(nx, dir.x, mul_add::<FUSED>(ny, dir.y, toward));
                let height = mul_add::<FUSED>(nz, -o.z, planes.d[l]);
                let height = mul_add::<FUSED>(nx, -o.x, mul_add::<FUSED>(ny, -o.y, height));
                // along a plane and outside it: left since ever
                let t = height / toward;
                let leaves = toward >= 0.0;
                let later = !leaves && t > self.enter[l];
                let sooner = leaves && t < self.leave[l];
                self.enter[l] = if later { t } else { self.enter[l] };
                self.facet[l] = if later { planes.facet[l] } else { self.facet[l] };
                self.leave[l] = if sooner { t } else { self.leave[l] };
            }
        }
        self
    }

    /// The latest way in, if it is ahead and before every way out.
    #[inline(always)]
    fn hit(&self) -> Option<Hit> {
        let mut keys = [0; LANES];
        for l in 0..LANES {
            keys[l] = !self.enter[l].to_bits();
        }
        let (key, facet) = least(&keys, &self.facet);
        let distance = f32::from_bits(!key);
        let mut inside = distance > 0.0;
        for l in 0..LANES {
            inside &= distance < self.leave[l];
        }
        inside.then_some(Hit { facet: facet as usize, distance })
    }
}

/// First facet that a ray from outside meets: the latest entry into a half-space, if it comes
/// before the earliest way out of one. Where that entry lies within the belt, the flats have nothing
/// to say.
#[inline(always)]
pub(super) fn first_hit<const FUSED: bool>(stone: &Stone, o: Vec3, dir: Vec3) -> Option<Hit> {
    let none = Crossing { enter: [0.0; LANES], facet: [NO_FACET; LANES], leave: [f32::INFINITY; LANES] };
    let slopes = none.through::<FUSED>(&stone.slopes, o, dir);
    let hit = slopes.hit();
    let Some(belt) = &stone.belt else { return hit };
    match hit {
        Some(hit) if belt.surrounds(o + hit.distance * dir) => Some(hit),
        _ => slopes.through::<FUSED>(&belt.flats, o, dir).hit(),
    }
}
