//! Kernel: one interaction of a packet with facets, the split of its power and its refraction and reflection.
//!
//! Plain Rust over arrays as wide as a register, as in `intersect.rs`.

// loops over the lanes of a dozen arrays in lockstep: with an index they vectorise
#![allow(clippy::needless_range_loop)]

use super::dispatch::Vectorised;
use super::intersect::{self, mul_add};
use super::packet::{Interaction, LANES, Lanes, NextFacets, Packet};
use super::stone::ConvexStone;
use super::uniaxial_kernel;
use crate::optics::snell::Snell;

/// One interaction of a packet, with the stone's instruction set: advances every lane to its next facet,
/// splits its power there and reflects it.
pub(super) fn interact(stone: &ConvexStone, packet: &mut Packet, out: &mut Interaction) {
    stone.isa.run(Interact { stone, packet, out });
}

struct Interact<'a> {
    stone: &'a ConvexStone,
    packet: &'a mut Packet,
    out: &'a mut Interaction,
}

impl Vectorised for Interact<'_> {
    type Output = ();

    #[inline(always)]
    fn run<const FUSED: bool, const W: usize, const B: usize>(self) {
        let Interact { stone, packet, out } = self;
        if packet.waves.is_some() {
            return uniaxial_kernel::interact_lanes::<FUSED, W, B>(stone, packet, out);
        }
        match (packet.polarised, packet.absorbing) {
            (false, false) => interact_lanes::<FUSED, W, B, false, false>(stone, packet, out),
            (false, true) => interact_lanes::<FUSED, W, B, false, true>(stone, packet, out),
            (true, false) => interact_lanes::<FUSED, W, B, true, false>(stone, packet, out),
            (true, true) => interact_lanes::<FUSED, W, B, true, true>(stone, packet, out),
        }
    }
}

/// The facets that the lanes of a packet meet next.
pub(super) struct MetFacets {
    nx: Lanes,
    ny: Lanes,
    nz: Lanes,
    /// Distances of the planes from the frame's origin.
    offset: Lanes,
    /// Distances along the rays.
    pub(super) distance: Lanes,
}

impl MetFacets {
    /// Finds them; lanes that meet none lose their power.
    #[inline(always)]
    pub(super) fn of<const FUSED: bool, const W: usize, const B: usize>(
        stone: &ConvexStone,
        p: &mut Packet,
        out: &mut Interaction,
    ) -> MetFacets {
        let mut next = NextFacets::default();
        intersect::next_facets::<FUSED, W, B>(stone, p, &mut next);
        let zero = [0.0; LANES];
        let mut met = MetFacets { nx: zero, ny: zero, nz: zero, offset: zero, distance: next.distance };
        out.lost = 0.0;
        for l in 0..LANES {
            if let Some(plane) = stone.plane_coefficients.get(next.facet[l] as usize) {
                [met.nx[l], met.ny[l], met.nz[l], met.offset[l]] = *plane;
                out.facet[l] = next.facet[l];
            } else {
                out.lost += p.power[l];
                p.power[l] = 0.0;
                met.distance[l] = 0.0;
                out.facet[l] = 0;
            }
        }
        met
    }

    /// The unit normal of a lane's facet.
    #[inline(always)]
    pub(super) fn normal(&self, l: usize) -> [f32; 3] {
        [self.nx[l], self.ny[l], self.nz[l]]
    }

    /// Where a lane's ray meets it.
    #[inline(always)]
    pub(super) fn point(&self, p: &Packet, l: usize) -> [f32; 3] {
        let ([nx, ny, nz], distance) = (self.normal(l), self.distance[l]);
        let (x, y, z) =
            (p.x[l] + distance * p.dx[l], p.y[l] + distance * p.dy[l], p.z[l] + distance * p.dz[l]);
        // back onto the facet plane, so that rounding does not add up over fifty bounces
        let off = self.offset[l] - (nx * x + ny * y + nz * z);
        [x + off * nx, y + off * ny, z + off * nz]
    }
}

/// [`interact`] for one kind of light.
///
/// - `FUSED`, `W`, `B`: as [`Vectorised::run`] has them; `POLARISED`: whether the Stokes vector is
///   followed; `ABSORBING`: whether the stone absorbs
#[inline(always)]
fn interact_lanes<
    const FUSED: bool,
    const W: usize,
    const B: usize,
    const POLARISED: bool,
    const ABSORBING: bool,
>(
    stone: &ConvexStone,
    p: &mut Packet,
    out: &mut Interaction,
) {
    let met = MetFacets::of::<FUSED, W, B>(stone, p, out);
    for l in 0..LANES {
        let [nx, ny, nz] = met.normal(l);
        let distance = met.distance[l];
        if ABSORBING {
            let left = exp_minus::<FUSED>(p.absorption[l] * distance);
            out.absorbed[l] = p.power[l] - left * p.power[l];
            p.power[l] *= left;
            if POLARISED {
                (p.q[l], p.u[l], p.v[l]) = (left * p.q[l], left * p.u[l], left * p.v[l]);
            }
        }
        let (dx, dy, dz) = (p.dx[l], p.dy[l], p.dz[l]);
        let [x, y, z] = met.point(p, l);
        let cos_i = (nx * dx + ny * dy + nz * dz).clamp(0.0, 1.0);
        let law = Snell::new(cos_i, p.index[l]);
        let passes = law.passes();
        let (s, q) = law.amplitudes();
        let (r_s, r_p) = if passes { (s * s, q * q) } else { (1.0, 1.0) };
        let mean = 0.5 * (r_s + r_p);
        [out.dx[l], out.dy[l], out.dz[l]] = law.refracted([dx, dy, dz], [nx, ny, nz]);
        out.cos_inside[l] = cos_i;
        out.cos_outside[l] = law.cos_t;
        let mut kept = p.power[l] * mean;
        if POLARISED {
            let half = 0.5 * (r_s - r_p);
            let turned = about_incidence(p, l, [nx, ny, nz]);
            // within its bounds also where an idle lane still has its last q
            kept = (kept + half * turned.q).max(0.0).min(p.power[l]);
            p.q[l] = half * p.power[l] + mean * turned.q;
            // r_s r_p*: real where light passes, of size 1 at total reflection
            let (re, im) = if passes { (s * q, 0.0) } else { law.total_reflection() };
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
/// branch and no table, so that it vectorises. Checked in this file's tests.
#[inline(always)]
pub(super) fn exp_minus<const FUSED: bool>(x: f32) -> f32 {
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
struct RotatedStokes {
    q: f32,
    u: f32,
    axis: [f32; 3],
}

/// [`crate::optics::stokes::Stokes::about_incidence`] for one lane, in `f32`.
#[inline(always)]
fn about_incidence(p: &Packet, l: usize, [nx, ny, nz]: [f32; 3]) -> RotatedStokes {
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
    RotatedStokes { q: cos2 * p.q[l] + sin2 * p.u[l], u: cos2 * p.u[l] - sin2 * p.q[l], axis: [sx, sy, sz] }
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
