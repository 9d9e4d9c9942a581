//! A facet between a crystal and an isotropic medium: boundary conditions, and shares of power.
//!
//! Fields along the facet are continuous. Of a wave that meets it from inside two go on inside and light leaves; of
//! light from outside some is reflected and two waves enter. Outside, fields along the facet are tied to each other
//! ([`Outside::mismatch`]), so that two equations are left for the two waves inside.
//! Source: P. Yeh, *Optical Waves in Layered Media*, ch. 9. Checked in `tests/library/crystal.rs`.

use super::biaxial::Biaxial;
use super::field::C;
use super::uniaxial::Uniaxial;
use super::wave::{Outside, Side, Wave};
use glam::{DMat3, DVec3};

/// A crystal at one wavelength, in the frame of the stone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Crystal {
    /// With one optic axis: modes are the ordinary and the extraordinary wave.
    Uniaxial(Uniaxial),
    /// With two optic axes: modes are the fast and the slow wave.
    Biaxial(Biaxial),
}

/// Principal indices nearer to each other than this are one: what is left of biaxiality is below rounding.
const ONE_INDEX: f64 = 1e-9;

/// A crystal whose indices all lie within this is taken as uniaxial, about the axis of the one that differs most.
const NEARLY_ISOTROPIC: f64 = 1e-6;

impl Crystal {
    /// A crystal by its principal indices, from the smallest, and their axes.
    ///
    /// - `axes`: unit, across each other; columns in the order of the indices
    pub fn new(indices: [f64; 3], axes: DMat3) -> Crystal {
        let [alpha, beta, gamma] = indices;
        let uniaxial =
            |ordinary, extraordinary, axis| Crystal::Uniaxial(Uniaxial { ordinary, extraordinary, axis });
        let limit = if gamma - alpha < NEARLY_ISOTROPIC { NEARLY_ISOTROPIC } else { ONE_INDEX };
        let (below, above) = (beta - alpha, gamma - beta);
        if below < limit && below <= above {
            uniaxial(beta, gamma, axes.z_axis)
        } else if above < limit {
            uniaxial(beta, alpha, axes.x_axis)
        } else {
            Crystal::Biaxial(Biaxial::new(indices, axes))
        }
    }

    /// The waves that go to one side of a facet, one of each mode.
    pub fn waves(&self, along: DVec3, normal: DVec3, side: Side) -> [Wave; 2] {
        match self {
            Crystal::Uniaxial(crystal) => crystal.waves(along, normal, side),
            Crystal::Biaxial(crystal) => crystal.waves(along, normal, side),
        }
    }
}

/// A wave reflected inside or entering, and its amplitude for an incident power of 1.
#[derive(Debug, Clone, Copy)]
pub struct Channel {
    /// The wave.
    pub wave: Wave,
    /// Its complex amplitude, for waves scaled as in [`Wave`].
    pub amplitude: C,
}

impl Channel {
    /// Its share of the incident power; 0 of a wave that dies away.
    pub fn power(&self) -> f64 {
        if self.wave.travels() { self.amplitude.norm_sqr() } else { 0.0 }
    }
}

/// What becomes of a wave that meets a facet from inside.
#[derive(Debug, Clone, Copy)]
pub struct InternalMeeting {
    /// What is reflected, one of each mode.
    pub reflected: [Channel; 2],
    /// Light outside.
    pub outside: Outside,
    /// Amplitudes of the electric field across and in the plane of incidence of what leaves, scaled to power through the facet.
    pub leaves: [C; 2],
}

impl InternalMeeting {
    /// A wave from inside that meets a facet.
    ///
    /// - `incident`: scaled to a power of 1 through the facet
    /// - `normal`: unit, out of the crystal; `index`: of what is outside
    pub fn new(crystal: &Crystal, incident: &Wave, normal: DVec3, index: f64) -> InternalMeeting {
        let k = incident.k.re;
        let along = k - k.dot(normal) * normal;
        let outside = Outside::new(along, normal, index);
        let waves = crystal.waves(along, normal, Side::Inward);
        let amplitudes =
            solved(waves.map(|wave| outside.mismatch(&wave)), outside.mismatch(incident).map(|x| -x));
        let reflected = [0, 1].map(|i| Channel { wave: waves[i], amplitude: amplitudes[i] });
        let field = incident.e + amplitudes[0] * waves[0].e + amplitudes[1] * waves[1].e;
        let magnetic = incident.h + amplitudes[0] * waves[0].h + amplitudes[1] * waves[1].h;
        let w = outside.w.re;
        let (s, p) = ((0.5 * w).sqrt(), (0.5 * w).sqrt() / index);
        let leaves = [s * field.along(outside.across), p * magnetic.along(outside.across)];
        InternalMeeting { reflected, outside, leaves }
    }

    /// The share of the power that leaves.
    pub fn transmitted(&self) -> f64 {
        self.leaves[0].norm_sqr() + self.leaves[1].norm_sqr()
    }
}

/// What becomes of light that meets a facet from outside.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// The waves that enter, one of each mode.
    pub waves: [Wave; 2],
    /// Their amplitudes, of incident light that is polarised across and in the plane of incidence.
    pub amplitudes: [[C; 2]; 2],
    /// Amplitudes of what is reflected, across and in the plane, of each of them.
    pub reflected: [[C; 2]; 2],
    /// Light outside, as it leaves.
    pub outside: Outside,
}

impl Entry {
    /// Light from outside.
    ///
    /// - `direction`: unit, into the crystal; `normal`: unit, out of it; `index`: of what is outside
    pub fn new(crystal: &Crystal, direction: DVec3, normal: DVec3, index: f64) -> Entry {
        let k = index * direction;
        let along = k - k.dot(normal) * normal;
        let outside = Outside::new(along, normal, index);
        let waves = crystal.waves(along, normal, Side::Inward);
        let w = outside.w.re;
        // of incident light of power 1: E across, or H across
        let (s, p) = ((2.0 / w).sqrt(), index * (2.0 / w).sqrt());
        let mismatches = waves.map(|wave| outside.mismatch(&wave));
        let zero = C::new(0.0, 0.0);
        // light that comes in has H·q̂ = −w E·ŝ and w H·ŝ = n² E·q̂
        let across = solved(mismatches, [C::new(-2.0 * w * s, 0.0), zero]);
        let within = solved(mismatches, [zero, C::new(2.0 * w * p, 0.0)]);
        let amplitudes = [across, within];
        let reflected = [0, 1].map(|i| {
            let field = |along: DVec3| {
                amplitudes[i][0] * waves[0].e.along(along) + amplitudes[i][1] * waves[1].e.along(along)
            };
            let magnetic = |along: DVec3| {
                amplitudes[i][0] * waves[0].h.along(along) + amplitudes[i][1] * waves[1].h.along(along)
            };
            let (came_s, came_p) = if i == 0 { (s, 0.0) } else { (0.0, p) };
            [(field(outside.across) - came_s) / s, (magnetic(outside.across) - came_p) / p]
        });
        Entry { waves, amplitudes, reflected, outside }
    }

    /// The share of unpolarised light that enters as each mode.
    pub fn unpolarised(&self) -> [f64; 2] {
        [0, 1].map(|mode| {
            let power = self.amplitudes[0][mode].norm_sqr() + self.amplitudes[1][mode].norm_sqr();
            if self.waves[mode].travels() { 0.5 * power } else { 0.0 }
        })
    }
}

/// The amplitudes x of two columns that sum to a right side.
fn solved(columns: [[C; 2]; 2], right: [C; 2]) -> [C; 2] {
    let [[a, c], [b, d]] = columns;
    let determinant = a * d - b * c;
    [(right[0] * d - b * right[1]) / determinant, (a * right[1] - c * right[0]) / determinant]
}
