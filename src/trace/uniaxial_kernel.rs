//! Kernel of uniaxial stones: one interaction of a packet of ordinary and extraordinary waves with facets.
//!
//! As [`super::crystal`] does it in `f64`, with what is only so of lanes: outside is air, so that a reflected wave that dies away leaves
//! all power to the other (its wave vector along the facet is longer than that of any light outside), and all fields are real. Only w, the part
//! of the wave vector outside along the normal, is imaginary at total reflection; it is kept apart: a condition is x + w y = 0.

// loops over the lanes of a dozen arrays in lockstep: with an index they vectorise
#![allow(clippy::needless_range_loop)]

use super::crystal_lanes::CrystalLanes;
use super::exponential::exp_minus;
use super::lanes::LANES;
use super::met_facets::MetFacets;
use super::packet::{Interaction, Packet};
use super::stone::ConvexStone;

/// Squared tangent of the angle between wave vector and axis below which the fields across the axis are any.
const ALONG_AXIS: f32 = 1e-7;

/// Squares of ξ, the part of a wave vector along the normal, below which a wave dies away.
const GRAZING: f32 = 1e-6;

/// One interaction of a packet whose waves are followed.
#[inline(always)]
pub(super) fn interact_lanes<const FUSED: bool, const W: usize, const B: usize>(
    stone: &ConvexStone,
    p: &mut Packet,
    out: &mut Interaction,
) {
    let Some(mut waves) = p.waves.take() else { return };
    let met = MetFacets::of::<FUSED, W, B>(stone, p, out);
    let axis = AxisFrame { axis: waves.axis.into(), across: waves.across.into() };
    for l in 0..LANES {
        let distance = met.distance[l];
        let left = exp_minus::<FUSED>(p.absorption[l] * distance);
        out.absorbed[l] = p.power[l] - left * p.power[l];
        p.power[l] *= left;
        let normal = met.normal(l);
        let [dx, dy, dz] = [p.dx[l], p.dy[l], p.dz[l]];
        out.cos_inside[l] = (normal[0] * dx + normal[1] * dy + normal[2] * dz).clamp(0.0, 1.0);
        [p.x[l], p.y[l], p.z[l]] = met.point(p, l);
        p.path[l] += distance;
        meet(p, &mut waves, l, &axis, normal, out);
    }
    p.waves = Some(waves);
}

/// The optic axis and any direction across it, unit.
struct AxisFrame {
    axis: [f32; 3],
    across: [f32; 3],
}

/// Fields of a wave, of any size, and the power that they carry through a facet.
struct WaveFields {
    e: [f32; 3],
    h: [f32; 3],
    flux: f32,
}

/// A facet's tangents and normal, and what all waves share there.
struct Meeting {
    normal: [f32; 3],
    tangents: [[f32; 3]; 2],
    /// The part of the wave vector along the facet, in the tangents.
    q: [f32; 2],
    /// The square of w; negative at total reflection.
    w2: f32,
    /// (n_o/n_e)².
    ratio2: f32,
}

/// A lane meets its facet.
#[inline(always)]
fn meet(
    p: &mut Packet,
    waves: &mut CrystalLanes,
    l: usize,
    frame: &AxisFrame,
    n: [f32; 3],
    out: &mut Interaction,
) {
    let c = frame.axis;
    let k = [waves.kx[l], waves.ky[l], waves.kz[l]];
    let (o2, e2) = (p.index[l] * p.index[l], waves.extraordinary[l] * waves.extraordinary[l]);
    let kn = dot(k, n);
    let q = plus(k, -kn, n);
    let q2 = dot(q, q);
    let tangents = tangents(n);
    let meeting = Meeting {
        normal: n,
        tangents,
        q: [dot(q, tangents[0]), dot(q, tangents[1])],
        w2: 1.0 - q2,
        ratio2: o2 / e2,
    };
    let passes = meeting.w2 > 0.0;
    let w = meeting.w2.max(0.0).sqrt();
    // ξ of the reflected waves: ξ² = n_o² − q², and a ξ² + 2 b ξ + d = 0 of the extraordinary one
    let (nc, qc, more) = (dot(n, c), dot(q, c), e2 - o2);
    let (a, b) = (o2 + more * nc * nc, more * qc * nc);
    let d = o2 * q2 + more * qc * qc - o2 * e2;
    let (ordinary, extraordinary) = (o2 - q2, b * b - a * d);
    let both = ordinary > GRAZING && extraordinary > GRAZING;
    let k_o = plus(q, -ordinary.max(0.0).sqrt(), n);
    let k_e = plus(q, (-extraordinary.max(0.0).sqrt() - b) / a, n);
    let is_e = waves.mode[l] > 0.5;
    let incident = meeting.fields(k, is_e, frame);
    let [o, e] = [meeting.fields(k_o, false, frame), meeting.fields(k_e, true, frame)];
    let [c_i, c_o, c_e] = [meeting.conditions(&incident), meeting.conditions(&o), meeting.conditions(&e)];
    let size2 = |[x, y]: [f32; 2]| {
        let through = x + w * y;
        if passes { through * through } else { x * x - meeting.w2 * y * y }
    };
    let scale = 1.0 / (size2(meeting.determinant(c_o, c_e)) * incident.flux).max(f32::MIN_POSITIVE);
    let r_o = size2(meeting.determinant(c_i, c_e)) * o.flux * scale;
    let r_e = size2(meeting.determinant(c_o, c_i)) * e.flux * scale;
    let own = if is_e { 0.0 } else { 1.0 };
    let share_o = if both { (r_o / (r_o + r_e).max(f32::MIN_POSITIVE)).min(1.0) } else { own };
    let kept = if passes && both { (r_o + r_e).min(1.0) } else { 1.0 };
    let goes_o = waves.choice[l] < share_o;
    waves.choice[l] = stretched(waves.choice[l], share_o, goes_o);
    out.power[l] = p.power[l] * (1.0 - kept);
    p.power[l] *= kept;
    [out.dx[l], out.dy[l], out.dz[l]] = plus(q, w, n);
    out.cos_outside[l] = w;
    let other = select(goes_o, k_e, k_o);
    [waves.other_kx[l], waves.other_ky[l], waves.other_kz[l]] = other;
    waves.other[l] = p.power[l] * if goes_o { 1.0 - share_o } else { share_o };
    let k = select(goes_o, k_o, k_e);
    [waves.kx[l], waves.ky[l], waves.kz[l]] = k;
    waves.mode[l] = if goes_o { 0.0 } else { 1.0 };
    // the ray of o along K, of e along n_o² K + (n_e² − n_o²)(K·c) c
    let kc = dot(k, c);
    let bend = if goes_o { 0.0 } else { more * kc / o2 };
    let ray = plus(k, bend, c);
    let per_size = 1.0 / dot(ray, ray).sqrt();
    [p.dx[l], p.dy[l], p.dz[l]] = ray.map(|x| per_size * x);
    p.absorption[l] = {
        let [of_o, of_e] = [waves.absorption[0][l], waves.absorption[1][l]];
        // n³ (α_o cos²θ/n_o³ + α_e sin²θ/n_e³) along the wave normal; shorter by cos ρ along the ray
        let n2 = dot(k, k);
        let cos2 = kc * kc / n2;
        let along_k =
            n2 * (of_o * cos2 / (o2 * p.index[l]) + of_e * (1.0 - cos2) / (e2 * waves.extraordinary[l]));
        if goes_o { of_o } else { along_k * dot(k, ray) * per_size }
    };
}

/// What a choice leaves of the number that made it: uniform again.
#[inline(always)]
fn stretched(choice: f32, share: f32, first: bool) -> f32 {
    let (above, width) = if first { (choice, share) } else { (choice - share, 1.0 - share) };
    (above / width.max(f32::MIN_POSITIVE)).clamp(0.0, 1.0)
}

impl Meeting {
    /// The fields of a wave: E_o ∝ K × c, E_e ∝ (n_o²/n_e²) K⊥² c − (K·c) K⊥ with K⊥ the part of K across c.
    #[inline(always)]
    fn fields(&self, k: [f32; 3], is_extraordinary: bool, frame: &AxisFrame) -> WaveFields {
        let c = frame.axis;
        let kc = dot(k, c);
        let across = plus(k, -kc, c);
        let size2 = dot(across, across);
        let is_along = size2 < ALONG_AXIS * kc * kc;
        let across = select(is_along, frame.across, across);
        let part = if is_along { 0.0 } else { self.ratio2 * size2 };
        let ordinary = cross(across, c);
        let extraordinary = plus(across.map(|x| -kc * x), part, c);
        let e = select(is_extraordinary, extraordinary, ordinary);
        let flux = dot(e, e) * dot(k, self.normal) - dot(e, k) * dot(e, self.normal);
        WaveFields { e, h: cross(k, e), flux: flux.abs() }
    }

    /// Both conditions that fields along the facet are those of light outside, w N × H + w² E + q (q·E) = 0 along each
    /// tangent, as [x, y] of x + w y = 0.
    #[inline(always)]
    fn conditions(&self, wave: &WaveFields) -> [[f32; 2]; 2] {
        let [t, s] = self.tangents;
        let (e_t, e_s) = (dot(wave.e, t), dot(wave.e, s));
        let qe = self.q[0] * e_t + self.q[1] * e_s;
        [[self.w2 * e_t + self.q[0] * qe, -dot(wave.h, s)], [self.w2 * e_s + self.q[1] * qe, dot(wave.h, t)]]
    }

    /// The determinant of two waves' conditions, as [x, y] of x + w y.
    #[inline(always)]
    fn determinant(&self, a: [[f32; 2]; 2], b: [[f32; 2]; 2]) -> [f32; 2] {
        let [[a0, a1], [a2, a3]] = a;
        let [[b0, b1], [b2, b3]] = b;
        [a0 * b2 - b0 * a2 + self.w2 * (a1 * b3 - b1 * a3), a0 * b3 + a1 * b2 - b0 * a3 - b1 * a2]
    }
}

/// Two unit vectors across a unit normal and each other, whose cross product is the normal.
///
/// Source: T. Duff et al., J. Computer Graphics Techniques 6 (2017) 1.
#[inline(always)]
fn tangents([x, y, z]: [f32; 3]) -> [[f32; 3]; 2] {
    let sign = 1f32.copysign(z);
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    [[1.0 + sign * x * x * a, sign * b, -sign * x], [b, sign + y * y * a, -y]]
}

#[inline(always)]
fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// a + s b.
#[inline(always)]
fn plus(a: [f32; 3], s: f32, b: [f32; 3]) -> [f32; 3] {
    [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]]
}

#[inline(always)]
fn select(first: bool, a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [0, 1, 2].map(|i| if first { a[i] } else { b[i] })
}
