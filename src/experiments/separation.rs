//! Separation: how far apart a stone sends the colours of one direction, by beams of three lines at
//! once, the remainder finished by photons.

use super::beam::angle_deg;
use super::exact::Effort;
use super::{BATCHES, ExperimentError, check_index, entrance};
use crate::math::stats::{self, Estimate};
use crate::optics::{Material, dispersion::lines};
use crate::walk::beams::remainder::{Photons, Remainder};
use crate::walk::beams::{Beams, Exit, Lit, Rest, Scalar, Watch};
use crate::walk::{LANES, Meeting, Stone};
use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// Lines that go together, D first.
const LINES: [f64; 3] = [lines::D, lines::B, lines::G];

/// Lanes of a photon.
const WIDTH: usize = LINES.len();

/// How far apart lines B and G leave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Separation {
    /// Mean angle between B and G in degrees, weighted by the power at D.
    pub angle_deg: Estimate,
    /// Power at D that the mean is taken over, as a share of the light on the outline.
    pub power: Estimate,
}

/// Σ power × angle in degrees, and Σ power.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    angle_deg: f64,
    power: f64,
}

/// What counts: exits through the crown towards the light's side.
struct Counted<'a> {
    axis: DVec3,
    crown: &'a [f32],
    sums: Sums,
    remainder: Remainder<WIDTH>,
}

impl Watch<Scalar, WIDTH> for Counted<'_> {
    fn exit(&mut self, exit: &Exit<Scalar, WIDTH>) {
        if exit.direction.dot(self.axis) <= 0.0 || self.crown[exit.facet] == 0.0 {
            return;
        }
        if let (Some(b), Some(g)) = (exit.direction_of(1), exit.direction_of(2)) {
            self.sums.angle_deg += exit.power * angle_deg(b, g);
            self.sums.power += exit.power;
        }
    }

    fn rest(&mut self, rest: &Rest<Scalar, WIDTH>) {
        self.remainder.add(rest);
    }
}

/// The same of photons; their lines part when they meet different facets.
struct Finished<'a> {
    axis: Vec3,
    crown: &'a [f32],
    together: [bool; LANES],
    sums: Sums,
}

impl Photons for Finished<'_> {
    fn begins(&mut self, lane: usize) {
        self.together[lane] = true;
    }

    fn meet(&mut self, m: &Meeting) {
        for d in (0..LANES / WIDTH).map(|photon| photon * WIDTH) {
            self.together[d] &= m.facet[d] == m.facet[d + 1] && m.facet[d] == m.facet[d + 2];
            let leaves = m.power[d..d + WIDTH].iter().all(|p| *p > 0.0);
            let up = m.direction(d).dot(self.axis) > 0.0 && self.crown[m.facet[d] as usize] > 0.0;
            if self.together[d] && leaves && up {
                let power = f64::from(m.power[d]);
                self.sums.angle_deg +=
                    power * angle_deg(m.direction(d + 1).as_dvec3(), m.direction(d + 2).as_dvec3());
                self.sums.power += power;
            }
        }
    }
}

/// B–G separation of one direction.
///
/// - `beams`: of `stone`; `direction`: unit, in which the light goes
///
/// Light counts that leaves through the crown on the side that it came from, at a point where B and
/// G, which fell on the same point of the stone, have met the same facets as D and leave too: the
/// beams of the three lines are clipped together. A material without dispersion gives 0. Checked in
/// `tests/beams.rs` against the photons of [`super::Beam`].
pub fn separation(
    stone: &Stone,
    beams: &Beams,
    direction: DVec3,
    material: &Material,
    effort: &Effort,
) -> Result<Separation, ExperimentError> {
    let indices = LINES.map(|um| material.index(um));
    for n in indices {
        check_index(n)?;
    }
    let crown = entrance::crown_flags(stone);
    let axis = -direction;
    let remainder = Remainder::new(effort.seed, BATCHES, effort.photons / BATCHES);
    let mut counted = Counted { axis, crown: &crown, sums: Sums::default(), remainder };
    beams.follow(&Lit { direction, indices }, Scalar(1.0), effort.stop_power, &mut counted);
    let exact = counted.sums;
    if effort.photons == 0 {
        let angle_deg = if exact.power > 0.0 { exact.angle_deg / exact.power } else { 0.0 };
        return Ok(Separation { angle_deg: Estimate::exact(angle_deg), power: Estimate::exact(exact.power) });
    }
    let finish = |batch: usize| {
        let (sums, together) = (Sums::default(), [false; LANES]);
        let mut finished = Finished { axis: axis.as_vec3(), crown: &crown, together, sums };
        let (photon, _) = counted.remainder.walk(batch, stone, indices, &mut finished);
        (exact.angle_deg + photon * finished.sums.angle_deg, exact.power + photon * finished.sums.power)
    };
    let batches: Vec<(f64, f64)> = (0..BATCHES).into_par_iter().map(finish).collect();
    Ok(Separation {
        angle_deg: stats::ratio(batches.iter().copied()),
        power: stats::ratio(batches.iter().map(|b| (b.1, 1.0))),
    })
}
