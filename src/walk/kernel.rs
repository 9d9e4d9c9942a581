//! The two loops that everything waits for: a packet's next facet, and a ray's first one.
//!
//! Plain Rust over arrays as wide as a register; the compiler turns each inner loop into one vector
//! instruction once `dispatch.rs` has named the instruction set. `FUSED` says whether a fused
//! multiply-add is an instruction (a library call otherwise).

// the lanes of a dozen arrays in lockstep: an index is what says so, and what vectorises
#![allow(clippy::needless_range_loop)]

use super::packet::{LANES, Lanes, Meeting, Packet};
use super::stone::{Hit, Stone};
use glam::Vec3;

/// Least height above a plane that a point inside is given: a point that rounding put outside
/// meets that plane at once, if it heads for it.
const LEAST_HEIGHT: f32 = 1e-9;

#[inline(always)]
fn mul_add<const FUSED: bool>(a: f32, b: f32, c: f32) -> f32 {
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}

/// `W` rays of a packet.
struct Rays<const W: usize> {
    x: [[f32; W]; 3],
    d: [[f32; W]; 3],
}

impl<const W: usize> Rays<W> {
    /// The rays of the lanes from `lane` on.
    #[inline(always)]
    fn of(p: &Packet, lane: usize) -> Self {
        let cut = |lanes: &Lanes| std::array::from_fn(|l| lanes[lane + l]);
        Rays { x: [cut(&p.x), cut(&p.y), cut(&p.z)], d: [cut(&p.dx), cut(&p.dy), cut(&p.dz)] }
    }
}

/// The facet that each ray meets first among those tried, as a fraction toward / height.
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
    const NONE: Best<W> = Best { toward: [0.0; W], height: [1.0; W], facet: [u32::MAX; W] };

    /// The better of `self` and plane number `i`; a tie leaves the earlier one.
    #[inline(always)]
    fn or<const FUSED: bool>(self, rays: &Rays<W>, [nx, ny, nz, d]: [f32; 4], i: usize) -> Best<W> {
        let (mut toward, mut height) = ([0.0; W], [0.0; W]);
        for l in 0..W {
            toward[l] =
                mul_add::<FUSED>(nx, rays.d[0][l], mul_add::<FUSED>(ny, rays.d[1][l], nz * rays.d[2][l]));
            let along =
                mul_add::<FUSED>(nx, rays.x[0][l], mul_add::<FUSED>(ny, rays.x[1][l], nz * rays.x[2][l]));
            height[l] = (d - along).max(LEAST_HEIGHT);
        }
        self.against(Best { toward, height, facet: [i as u32; W] })
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

    /// The better of `self` and the planes numbered from `first` on.
    ///
    /// `B` running bests take turns: each comparison waits for the one before it, and the machine
    /// has work for several such chains at once.
    #[inline(always)]
    fn or_all<const FUSED: bool, const B: usize>(
        self,
        rays: &Rays<W>,
        planes: &[[f32; 4]],
        first: usize,
    ) -> Best<W> {
        let mut best = [Best::NONE; B];
        best[0] = self;
        let rounds = planes.chunks_exact(B);
        let rest = rounds.remainder();
        for (round, planes) in rounds.enumerate() {
            for b in 0..B {
                best[b] = best[b].or::<FUSED>(rays, planes[b], first + round * B + b);
            }
        }
        for (i, plane) in rest.iter().enumerate() {
            best[i] = best[i].or::<FUSED>(rays, *plane, first + planes.len() - rest.len() + i);
        }
        let mut all = best[0];
        for other in &best[1..] {
            all = all.against(*other);
        }
        all
    }

    /// Whether some ray has not met its facet well inside the belt, and the belt must be tried.
    #[inline(always)]
    fn reaches(&self, rays: &Rays<W>, belt_radius2: f32) -> bool {
        let mut out = false;
        for l in 0..W {
            let t = self.height[l] / self.toward[l];
            let (x, y) = (rays.x[0][l] + t * rays.d[0][l], rays.x[1][l] + t * rays.d[1][l]);
            // a ray that has met nothing yet has no end, and is not inside
            let inside = x * x + y * y < belt_radius2;
            out |= !inside;
        }
        out
    }
}

/// Advances every lane to its next facet, splits its power there and reflects it.
///
/// The next facet is the argmax over i of (nᵢ·d)/(dᵢ − nᵢ·x), compared crosswise so that the loop
/// has no division and no mask: a facet that the ray leaves has a negative numerator and never
/// wins. The girdle's flats are tried only if some ray would pass the cylinder inside them: a third
/// of the packets in a round brilliant.
///
/// - `W`: lanes that fill a register; `B`: running bests that fit into the registers;
///   `POLARISED`: whether the Stokes vector is followed; `ABSORBING`: whether the stone takes power
///   on the way
#[inline(always)]
pub(super) fn meet<
    const FUSED: bool,
    const W: usize,
    const B: usize,
    const POLARISED: bool,
    const ABSORBING: bool,
>(
    stone: &Stone,
    p: &mut Packet,
    out: &mut Meeting,
) {
    let (mut best_toward, mut best_height, mut facet) = ([0.0; LANES], [0.0; LANES], [0; LANES]);
    let (slopes, belt) = stone.rows.split_at(stone.slopes);
    for lane in (0..LANES).step_by(W) {
        let rays = Rays::<W>::of(p, lane);
        let mut best = Best::NONE.or_all::<FUSED, B>(&rays, slopes, 0);
        if !belt.is_empty() && best.reaches(&rays, stone.belt_radius2) {
            best = best.or_all::<FUSED, B>(&rays, belt, slopes.len());
        }
        best_toward[lane..lane + W].copy_from_slice(&best.toward);
        best_height[lane..lane + W].copy_from_slice(&best.height);
        facet[lane..lane + W].copy_from_slice(&best.facet);
    }
    // planes of the lanes
    let (mut fx, mut fy, mut fz, mut fd) = ([0.0; LANES], [0.0; LANES], [0.0; LANES], [0.0; LANES]);
    out.lost = 0.0;
    for l in 0..LANES {
        let number = facet[l] as usize;
        if number < stone.rows.len() {
            [fx[l], fy[l], fz[l], fd[l]] = stone.rows[number];
            out.facet[l] = stone.facet_of[number];
        } else {
            out.lost += p.power[l];
            p.power[l] = 0.0;
            out.facet[l] = 0;
        }
    }
    for l in 0..LANES {
        let (nx, ny, nz) = (fx[l], fy[l], fz[l]);
        let distance = if best_toward[l] > 0.0 { best_height[l] / best_toward[l] } else { 0.0 };
        if ABSORBING {
            let left = exp_minus::<FUSED>(p.absorption[l] * distance);
            out.absorbed[l] = p.power[l] - left * p.power[l];
            p.power[l] *= left;
            if POLARISED {
                (p.q[l], p.u[l], p.v[l]) = (left * p.q[l], left * p.u[l], left * p.v[l]);
            }
        }
        let (dx, dy, dz) = (p.dx[l], p.dy[l], p.dz[l]);
        let (mut x, mut y, mut z) = (p.x[l] + distance * dx, p.y[l] + distance * dy, p.z[l] + distance * dz);
        // back onto the facet plane, so that rounding does not add up over fifty meetings
        let off = fd[l] - (nx * x + ny * y + nz * z);
        x += off * nx;
        y += off * ny;
        z += off * nz;
        let cos_i = (nx * dx + ny * dy + nz * dz).clamp(0.0, 1.0);
        let n = p.index[l];
        let sin2_t = n * n * (1.0 - cos_i * cos_i);
        let passes = sin2_t < 1.0;
        let cos_t = (1.0 - sin2_t).max(0.0).sqrt();
        // Fresnel from inside: eta = 1/n, multiplied through by n
        let s = (n * cos_i - cos_t) / (n * cos_i + cos_t);
        let q = (cos_i - n * cos_t) / (cos_i + n * cos_t);
        let (r_s, r_p) = if passes { (s * s, q * q) } else { (1.0, 1.0) };
        let mean = 0.5 * (r_s + r_p);
        let bend = cos_t - n * cos_i;
        out.dx[l] = n * dx + bend * nx;
        out.dy[l] = n * dy + bend * ny;
        out.dz[l] = n * dz + bend * nz;
        out.cos_inside[l] = cos_i;
        out.cos_outside[l] = if passes { cos_t } else { 0.0 };
        let mut kept = p.power[l] * mean;
        if POLARISED {
            let half = 0.5 * (r_s - r_p);
            let turned = about_incidence(p, l, [nx, ny, nz]);
            kept += half * turned.q;
            p.q[l] = half * p.power[l] + mean * turned.q;
            // r_s r_p*: real where light passes, of size 1 at total reflection
            let kappa = (sin2_t - 1.0).max(0.0).sqrt();
            let (a, b) = (n * (cos_i * cos_i + kappa * kappa), cos_i * kappa * (n * n - 1.0));
            let size = (a * a + b * b).max(f32::MIN_POSITIVE);
            let (re, im) = if passes { (s * q, 0.0) } else { ((a * a - b * b) / size, 2.0 * a * b / size) };
            p.u[l] = re * turned.u - im * p.v[l];
            p.v[l] = im * turned.u + re * p.v[l];
            [p.ax[l], p.ay[l], p.az[l]] = turned.axis;
        }
        out.power[l] = p.power[l] - kept;
        p.power[l] = kept;
        (p.x[l], p.y[l], p.z[l]) = (x, y, z);
        let (rx, ry, rz) = (dx - 2.0 * cos_i * nx, dy - 2.0 * cos_i * ny, dz - 2.0 * cos_i * nz);
        // one Newton step keeps the direction a unit vector
        let k = 1.5 - 0.5 * (rx * rx + ry * ry + rz * rz);
        (p.dx[l], p.dy[l], p.dz[l]) = (k * rx, k * ry, k * rz);
        p.path[l] += distance;
    }
}

/// exp(−x) for x ≥ 0, to 2e-7 of its value; 1e-38 from 87 on.
///
/// Cody–Waite: x = −k ln 2 − r with |r| ≤ ½ ln 2, a polynomial for exp(r), k into the exponent. No
/// branch and no table, so that it vectorises. Checked below.
#[inline(always)]
fn exp_minus<const FUSED: bool>(x: f32) -> f32 {
    /// 1.5 × 2²³: adding it rounds to a whole number, which its last bits hold.
    const ROUND: f32 = 12_582_912.0;
    /// ln 2 in two parts, the first of few digits: its multiples are exact.
    const LN_2: [f32; 2] = [0.693_359_4, -2.121_944_4e-4];
    const EXPONENT: u32 = 23;
    let y = -x.min(87.0);
    let shifted = mul_add::<FUSED>(y, std::f32::consts::LOG2_E, ROUND);
    let k = shifted - ROUND;
    let r = mul_add::<FUSED>(k, -LN_2[1], mul_add::<FUSED>(k, -LN_2[0], y));
    let mut sum = 1.0 / 720.0;
    for coefficient in [1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5, 1.0, 1.0] {
        sum = mul_add::<FUSED>(sum, r, coefficient);
    }
    sum * f32::from_bits((shifted.to_bits() << EXPONENT).wrapping_add(1f32.to_bits()))
}

/// Linear polarisation about the plane of incidence.
struct Turned {
    q: f32,
    u: f32,
    axis: [f32; 3],
}

/// The twin of [`crate::optics::stokes::Stokes::about_incidence`] for one lane.
#[inline(always)]
fn about_incidence(p: &Packet, l: usize, [nx, ny, nz]: [f32; 3]) -> Turned {
    let (dx, dy, dz) = (p.dx[l], p.dy[l], p.dz[l]);
    let (ax, ay, az) = (p.ax[l], p.ay[l], p.az[l]);
    let (sx, sy, sz) = (dy * nz - dz * ny, dz * nx - dx * nz, dx * ny - dy * nx);
    let size2 = sx * sx + sy * sy + sz * sz;
    let slanting = size2 > 1e-12;
    let k = 1.0 / size2.max(1e-12).sqrt();
    let (sx, sy, sz) = if slanting { (k * sx, k * sy, k * sz) } else { (ax, ay, az) };
    let cos = ax * sx + ay * sy + az * sz;
    let (px, py, pz) = (dy * az - dz * ay, dz * ax - dx * az, dx * ay - dy * ax);
    let sin = px * sx + py * sy + pz * sz;
    let (cos2, sin2) = (cos * cos - sin * sin, 2.0 * cos * sin);
    Turned { q: cos2 * p.q[l] + sin2 * p.u[l], u: cos2 * p.u[l] - sin2 * p.q[l], axis: [sx, sy, sz] }
}

/// First facet that a ray from outside meets: the latest entry into a half-space, if it comes
/// before the earliest way out of one. Sixteen planes at a time.
#[inline(always)]
pub(super) fn first_hit(stone: &Stone, o: Vec3, dir: Vec3) -> Option<Hit> {
    let mut enter: Lanes = [f32::NEG_INFINITY; LANES];
    let mut leave: Lanes = [f32::INFINITY; LANES];
    let mut facet = [0u32; LANES];
    let chunks = stone.nx.len() / LANES;
    for c in 0..chunks {
        let at = c * LANES;
        let (nx, ny, nz) = (&stone.nx[at..at + LANES], &stone.ny[at..at + LANES], &stone.nz[at..at + LANES]);
        let d = &stone.d[at..at + LANES];
        for l in 0..LANES {
            let toward = nx[l] * dir.x + ny[l] * dir.y + nz[l] * dir.z;
            let height = d[l] - (nx[l] * o.x + ny[l] * o.y + nz[l] * o.z);
            let t = height / toward;
            // a ray along a plane is inside its half-space for ever, or never
            let inward = toward < 0.0 || (toward == 0.0 && height < 0.0);
            let t =
                if toward == 0.0 { if height < 0.0 { f32::INFINITY } else { f32::NEG_INFINITY } } else { t };
            let later = inward && t > enter[l];
            enter[l] = if later { t } else { enter[l] };
            facet[l] = if later { (at + l) as u32 } else { facet[l] };
            leave[l] = if toward > 0.0 && t < leave[l] { t } else { leave[l] };
        }
    }
    let mut best = 0;
    let mut first_out = leave[0];
    for l in 1..LANES {
        if enter[l] > enter[best] {
            best = l;
        }
        first_out = first_out.min(leave[l]);
    }
    let distance = enter[best];
    (distance > 0.0 && distance < first_out).then_some(Hit { facet: facet[best] as usize, distance })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_kernels_exponential_is_the_exponential() {
        assert_eq!((exp_minus::<false>(0.0), exp_minus::<true>(0.0)), (1.0, 1.0));
        for i in 0..=870_000 {
            let x = i as f32 * 1e-4;
            let exact = (-f64::from(x)).exp();
            for found in [exp_minus::<false>(x), exp_minus::<true>(x)] {
                assert!((f64::from(found) / exact - 1.0).abs() < 3e-7, "{x}: {found} for {exact}");
            }
        }
        for x in [88.0, 1e4, f32::MAX, f32::INFINITY] {
            assert!((0.0..2e-38).contains(&exp_minus::<true>(x)));
        }
    }
}
