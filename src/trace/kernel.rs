//! Kernel: one interaction of a packet with facets, the split of its power and its refraction and reflection.
//!
//! Plain Rust over arrays as wide as a register, as in `intersect.rs`.

// loops over the lanes of a dozen arrays in lockstep: with an index they vectorise
#![allow(clippy::needless_range_loop)]

use super::dispatch::Vectorised;
use super::exponential::exp_minus;
use super::lanes::LANES;
use super::met_facets::MetFacets;
use super::packet::{Interaction, Packet};
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
