//! Intersection: the facet that a ray inside meets next, and the first facet of a ray from
//! outside.
//!
//! Plain Rust over arrays as wide as a register; the compiler turns each inner loop into one vector
//! instruction once `dispatch.rs` has named the instruction set. `FUSED`, `W` and `B` are as
//! [`Vectorised::run`] has them.

// loops over the lanes of a dozen arrays in lockstep: with an index they vectorise
#![allow(clippy::needless_range_loop)]

use super::dispatch::Vectorised;
use super::girdle::{GirdleFacets, PlaneBlock16};
use super::lanes::{LANES, Lanes};
use super::packet::{FacetHit, NO_FACET, NextFacets, Packet};
use super::stone::{ConvexStone, InclinedFacet};
use glam::Vec3;

/// Least slack (distance inside a plane) of a point: one that rounding put outside meets that plane at once
/// if it moves towards it.
const MIN_SLACK: f32 = 1e-9;

#[inline(always)]
pub(super) fn mul_add<const FUSED: bool>(a: f32, b: f32, c: f32) -> f32 {
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}

/// `W` rays of a packet.
struct RayLanes<const W: usize> {
    /// Negated positions, so that a slack is three multiply-adds.
    neg_origin: [[f32; W]; 3],
    d: [[f32; W]; 3],
}

impl<const W: usize> RayLanes<W> {
    /// The rays of the lanes from `lane` on.
    #[inline(always)]
    fn new(p: &Packet, lane: usize) -> Self {
        let mut rays = RayLanes { neg_origin: [[0.0; W]; 3], d: [[0.0; W]; 3] };
        for (axis, (x, d)) in [(&p.x, &p.dx), (&p.y, &p.dy), (&p.z, &p.dz)].into_iter().enumerate() {
            for l in 0..W {
                rays.neg_origin[axis][l] = -x[lane + l];
                rays.d[axis][l] = d[lane + l];
            }
        }
        rays
    }
}

/// The nearest facet among those tried, its distance as a fraction slack / cos_num, `W` times.
///
/// Passed and returned by value: the optimiser then keeps it in registers, where a conditional
/// store into an array costs a round trip through memory at every plane (three times the time).
#[derive(Clone, Copy)]
struct NearestFacet<const W: usize> {
    cos_num: [f32; W],
    slack: [f32; W],
    facet: [u32; W],
}

impl<const W: usize> NearestFacet<W> {
    const NONE: NearestFacet<W> = NearestFacet { cos_num: [0.0; W], slack: [1.0; W], facet: [NO_FACET; W] };

    /// The nearer of `self` and one more plane, ray by ray; the earlier one in a tie.
    #[inline(always)]
    fn or_plane<const FUSED: bool>(self, rays: &RayLanes<W>, row: &InclinedFacet) -> NearestFacet<W> {
        let [nx, ny, nz, d] = row.plane;
        let (mut cos_num, mut slack) = ([0.0; W], [0.0; W]);
        for l in 0..W {
            let [dx, dy, dz] = [rays.d[0][l], rays.d[1][l], rays.d[2][l]];
            let [x, y, z] = [rays.neg_origin[0][l], rays.neg_origin[1][l], rays.neg_origin[2][l]];
            cos_num[l] = mul_add::<FUSED>(nx, dx, mul_add::<FUSED>(ny, dy, nz * dz));
            let above = mul_add::<FUSED>(nx, x, mul_add::<FUSED>(ny, y, mul_add::<FUSED>(nz, z, d)));
            slack[l] = above.max(MIN_SLACK);
        }
        self.nearer(NearestFacet { cos_num, slack, facet: [row.facet; W] })
    }

    /// The nearer of two, ray by ray; `self` in a tie.
    #[inline(always)]
    fn nearer(self, other: NearestFacet<W>) -> NearestFacet<W> {
        let mut wins = [false; W];
        for l in 0..W {
            wins[l] = other.cos_num[l] * self.slack[l] > self.cos_num[l] * other.slack[l];
        }
        let mut best = NearestFacet::NONE;
        for l in 0..W {
            best.cos_num[l] = if wins[l] { other.cos_num[l] } else { self.cos_num[l] };
            best.slack[l] = if wins[l] { other.slack[l] } else { self.slack[l] };
            best.facet[l] = if wins[l] { other.facet[l] } else { self.facet[l] };
        }
        best
    }

    /// The nearest of all rows, ray by ray.
    ///
    /// `B` independent accumulators hide the latency of the comparison: each waits for the one before it,
    /// and the processor works on several such chains at once.
    #[inline(always)]
    fn among<const FUSED: bool, const B: usize>(
        rays: &RayLanes<W>,
        rows: &[InclinedFacet],
    ) -> NearestFacet<W> {
        let mut best = [NearestFacet::NONE; B];
        let rounds = rows.chunks_exact(B);
        let rest = rounds.remainder();
        for rows in rounds {
            for b in 0..B {
                best[b] = best[b].or_plane::<FUSED>(rays, &rows[b]);
            }
        }
        let mut all = best[0];
        for other in &best[1..] {
            all = all.nearer(*other);
        }
        for row in rest {
            all = all.or_plane::<FUSED>(rays, row);
        }
        all
    }
}

/// The facet that each lane meets next.
///
/// It is the argmax over i of (nᵢ·d)/(dᵢ − nᵢ·x), compared crosswise so that the loop has no division and
/// no mask: a facet that the ray leaves has a negative numerator and never wins. All rays together are
/// tested against the inclined facets; a ray that ends outside the cylinder inscribed in the girdle (one in
/// forty in a round brilliant) is tested, on its own, against the girdle facets at its azimuth.
#[inline(always)]
pub(super) fn next_facets<const FUSED: bool, const W: usize, const B: usize>(
    stone: &ConvexStone,
    p: &Packet,
    out: &mut NextFacets,
) {
    for lane in (0..LANES).step_by(W) {
        let rays = RayLanes::<W>::new(p, lane);
        let best = NearestFacet::among::<FUSED, B>(&rays, &stone.inclined_facets);
        let (mut ends, mut end2) = ([[0.0; 2]; W], [0.0; W]);
        for l in 0..W {
            // without a facet the quotient is infinite or NaN
            let t = best.slack[l] / best.cos_num[l];
            let (x, y) = (t * rays.d[0][l] - rays.neg_origin[0][l], t * rays.d[1][l] - rays.neg_origin[1][l]);
            out.distance[lane + l] = t;
            out.facet[lane + l] = best.facet[l];
            ends[l] = [x, y];
            end2[l] = x * x + y * y;
        }
        let Some(girdle) = &stone.girdle else { continue };
        let mut within = [false; W];
        for l in 0..W {
            within[l] = end2[l] < girdle.radius2;
        }
        if within == [true; W] {
            continue;
        }
        for l in 0..W {
            if within[l] {
                continue;
            }
            let (distance, flat) = nearest_girdle_facet::<FUSED>(girdle, p, lane + l, ends[l]);
            if distance < out.distance[lane + l] || best.facet[l] == NO_FACET {
                (out.distance[lane + l], out.facet[lane + l]) = (distance, flat);
            }
        }
    }
}

/// The nearest girdle facet of one ray and its distance, searched for from the azimuth of the ray's end.
///
/// The girdle facets are the sides of a convex polygon, so that (nᵢ·d)/(dᵢ − nᵢ·x) is unimodal in i: a girdle
/// facet that is met before both its neighbours is met before all.
#[inline(always)]
fn nearest_girdle_facet<const FUSED: bool>(
    girdle: &GirdleFacets,
    p: &Packet,
    lane: usize,
    end: [f32; 2],
) -> (f32, u32) {
    let count = girdle.blocks.len();
    let mut at = girdle.facing(end[0], end[1]);
    let (mut distance, mut which) = nearest_in_block::<FUSED>(&girdle.blocks[at], p, lane);
    for step in 1..count {
        let beside = match which {
            _ if distance == f32::INFINITY => at + step,
            0 => at + count - 1,
            last if last == girdle.blocks[at].last => at + 1,
            _ => break,
        };
        let (other, flat) = nearest_in_block::<FUSED>(&girdle.blocks[beside % count], p, lane);
        if other < distance {
            (distance, which, at) = (other, flat, beside % count);
        } else if distance < f32::INFINITY {
            break;
        }
    }
    let met = distance < f32::INFINITY;
    (distance, if met { girdle.blocks[at].facet[which as usize % LANES] } else { NO_FACET })
}

/// The distance to the nearest of sixteen girdle facets, and which it is; infinite if the ray turns away from
/// all.
#[inline(always)]
fn nearest_in_block<const FUSED: bool>(flats: &PlaneBlock16, p: &Packet, lane: usize) -> (f32, u32) {
    let (x, y, dx, dy) = (-p.x[lane], -p.y[lane], p.dx[lane], p.dy[lane]);
    let mut keys = [0; LANES];
    for l in 0..LANES {
        let cos_num = mul_add::<FUSED>(flats.nx[l], dx, flats.ny[l] * dy);
        let slack = mul_add::<FUSED>(flats.nx[l], x, mul_add::<FUSED>(flats.ny[l], y, flats.d[l]));
        keys[l] = (slack.max(MIN_SLACK) / cos_num).to_bits();
    }
    let (key, which) = least(&keys, &std::array::from_fn(|l| l as u32));
    // negative or NaN: it turns away
    let distance = f32::from_bits(key);
    (if distance >= 0.0 { distance } else { f32::INFINITY }, which)
}

/// The least key with the value paired with it; of equal keys the one with the least such value.
///
/// Non-negative floats sort as their bits do, and a minimum of integers can be taken in any order, so that
/// it vectorises.
#[inline(always)]
fn least(keys: &[u32; LANES], beside: &[u32; LANES]) -> (u32, u32) {
    let mut least = u64::MAX;
    for l in 0..LANES {
        least = least.min((u64::from(keys[l]) << 32) | u64::from(beside[l]));
    }
    ((least >> 32) as u32, least as u32)
}

/// Interval of a ray within half-spaces, for sixteen planes side by side.
struct RayInterval {
    /// The latest entry, and its facet.
    enter: Lanes,
    facet: [u32; LANES],
    /// The earliest exit.
    leave: Lanes,
}

impl RayInterval {
    #[inline(always)]
    fn clip<const FUSED: bool>(mut self, planes: &[PlaneBlock16], o: Vec3, dir: Vec3) -> RayInterval {
        for planes in planes {
            for l in 0..LANES {
                let [nx, ny, nz] = [planes.nx[l], planes.ny[l], planes.nz[l]];
                // 0.0 + 0 × -1 is 0.0: a ray along a plane never has -0.0 here
                let cos_num = mul_add::<FUSED>(nz, dir.z, 0.0);
                let cos_num = mul_add::<FUSED>(nx, dir.x, mul_add::<FUSED>(ny, dir.y, cos_num));
                let slack = mul_add::<FUSED>(nz, -o.z, planes.d[l]);
                let slack = mul_add::<FUSED>(nx, -o.x, mul_add::<FUSED>(ny, -o.y, slack));
                // parallel to a plane and outside it: the exit is at −∞
                let t = slack / cos_num;
                let leaves = cos_num >= 0.0;
                let later = !leaves && t > self.enter[l];
                let sooner = leaves && t < self.leave[l];
                self.enter[l] = if later { t } else { self.enter[l] };
                self.facet[l] = if later { planes.facet[l] } else { self.facet[l] };
                self.leave[l] = if sooner { t } else { self.leave[l] };
            }
        }
        self
    }

    /// The latest entry, if it lies ahead and before every exit.
    #[inline(always)]
    fn hit(&self) -> Option<FacetHit> {
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
        inside.then_some(FacetHit { facet: facet as usize, distance })
    }
}

/// First facet that a ray from outside meets: the latest entry into a half-space, if it comes before the
/// earliest exit from one. An entry within the girdle's cylinder needs no test of girdle facets.
#[inline(always)]
fn intersect_outside<const FUSED: bool>(stone: &ConvexStone, o: Vec3, dir: Vec3) -> Option<FacetHit> {
    let none = RayInterval { enter: [0.0; LANES], facet: [NO_FACET; LANES], leave: [f32::INFINITY; LANES] };
    let slopes = none.clip::<FUSED>(&stone.inclined_blocks, o, dir);
    let hit = slopes.hit();
    let Some(girdle) = &stone.girdle else { return hit };
    match hit {
        Some(hit) if girdle.encloses(o + hit.distance * dir) => Some(hit),
        _ => slopes.clip::<FUSED>(&girdle.blocks, o, dir).hit(),
    }
}

struct FindNextFacets<'a> {
    stone: &'a ConvexStone,
    packet: &'a Packet,
}

impl Vectorised for FindNextFacets<'_> {
    type Output = NextFacets;

    #[inline(always)]
    fn run<const FUSED: bool, const W: usize, const B: usize>(self) -> NextFacets {
        let mut next = NextFacets::default();
        next_facets::<FUSED, W, B>(self.stone, self.packet, &mut next);
        next
    }
}

struct IntersectOutside<'a> {
    stone: &'a ConvexStone,
    origin: Vec3,
    direction: Vec3,
}

impl Vectorised for IntersectOutside<'_> {
    type Output = Option<FacetHit>;

    #[inline(always)]
    fn run<const FUSED: bool, const W: usize, const B: usize>(self) -> Option<FacetHit> {
        intersect_outside::<FUSED>(self.stone, self.origin, self.direction)
    }
}

impl ConvexStone {
    /// First facet that a ray from outside meets.
    ///
    /// - `origin`, `direction` (unit): trace frame
    ///
    /// None if the ray misses the stone or starts behind or inside it.
    pub fn intersect(&self, origin: Vec3, direction: Vec3) -> Option<FacetHit> {
        // most rays of a scene miss the sphere around the stone
        let b = origin.dot(direction);
        let c = origin.length_squared() - 1.0;
        if c > 0.0 && (b > 0.0 || b * b < c) {
            return None;
        }
        self.isa.run(IntersectOutside { stone: self, origin, direction })
    }

    /// The facet that every lane of a packet meets next, and how far it is: the search that tracing
    /// does at every interaction.
    ///
    /// Checked in `tests/library/trace/intersect.rs` against brute force in `f64`.
    pub fn next_facets(&self, packet: &Packet) -> NextFacets {
        self.isa.run(FindNextFacets { stone: self, packet })
    }
}
