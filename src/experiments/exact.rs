//! Exact: the view by beams, its remainder finished by photons. Scores of one direction without
//! noise, or all but.

use super::view::{Band, band};
use super::{BATCHES, ExperimentError, check_index};
use crate::math::stats::{self, Estimate};
use crate::walk::beams::remainder::{Photons, Remainder};
use crate::walk::beams::{Beams, Exit, Interface, Light, Lit, Rest, Scalar, Watch};
use crate::walk::{LANES, Meeting, Stone};
use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// How hard to work.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// Beams below this share of the light on the outline are left to photons.
    pub stop_power: f64,
    /// Photons that finish them, all batches together (half to all of them are drawn).
    pub photons: usize,
    /// Seed of the photons.
    pub seed: u64,
}

impl Default for Effort {
    /// About 2.3 % of a brilliant's light is left to photons.
    fn default() -> Self {
        Effort { stop_power: 1e-5, photons: 16_384, seed: 1 }
    }
}

/// Where the light of one direction goes, as shares of the light on the outline. Backward it is
/// what a parallel eye sees: bands count from the axis on which the eye lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gaze {
    /// Reflected at entry.
    pub reflected: Estimate,
    /// Leaves towards the eye's side of the horizon.
    pub up: Estimate,
    /// Leaves to the other side: leakage.
    pub down: Estimate,
    /// Leaves upward, weighted by cos² from the axis.
    pub up_cos2: Estimate,
    /// Leaves, by [`Band`].
    pub bands: [Estimate; 4],
    /// Given up: light that total reflection keeps.
    pub lost: Estimate,
    /// The part that photons have finished.
    pub by_photons: f64,
    /// Number of beams.
    pub beams: u64,
}

/// Sums of exits.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    bands: [f64; 4],
    up_cos2: f64,
}

impl Sums {
    #[inline]
    fn add(&mut self, z: f64, power: f64) {
        self.bands[band(z as f32) as usize] += power;
        self.up_cos2 += power * z.max(0.0).powi(2);
    }
}

/// Exits into sums, the rest into photons.
struct Sorted {
    axis: DVec3,
    sums: Sums,
    remainder: Remainder<1>,
}

impl Watch<Scalar, 1> for Sorted {
    #[inline]
    fn exit(&mut self, exit: &Exit<Scalar, 1>) {
        self.sums.add(exit.direction.dot(self.axis), exit.power);
    }

    fn rest(&mut self, rest: &Rest<Scalar, 1>) {
        self.remainder.add(rest);
    }
}

/// Photons into sums.
struct Counted {
    axis: Vec3,
    sums: Sums,
}

impl Photons for Counted {
    fn meet(&mut self, m: &Meeting) {
        for l in 0..LANES {
            if m.power[l] > 0.0 {
                let z = m.direction(l).dot(self.axis);
                self.sums.add(z.into(), m.power[l].into());
            }
        }
    }
}

/// Traces a parallel beam through a stone to its end.
///
/// - `beams`: of `stone`
/// - `direction`: unit, in which the light goes; −z for a face-up stone
/// - `index`: of the stone
///
/// Unpolarised, scalar Fresnel. Without photons nothing is finished, and the sums fall short of 1
/// by `by_photons`. Checked in `tests/beams.rs`.
pub fn gaze(
    stone: &Stone,
    beams: &Beams,
    direction: DVec3,
    index: f64,
    effort: &Effort,
) -> Result<Gaze, ExperimentError> {
    check_index(index)?;
    let remainder = Remainder::new(effort.seed, BATCHES, effort.photons / BATCHES);
    let mut sorted = Sorted { axis: -direction, sums: Sums::default(), remainder };
    let lit = Lit { direction, indices: [index] };
    let totals = beams.follow(&lit, Scalar(1.0), effort.stop_power, &mut sorted);
    let Sorted { axis, sums, remainder } = sorted;
    let finish = |batch: usize| {
        let mut counted = Counted { axis: axis.as_vec3(), sums: Sums::default() };
        let (photon, lost) = remainder.walk(batch, stone, lit.indices, &mut counted);
        (photon, counted.sums, lost)
    };
    let finished: Vec<(f64, Sums, f64)> =
        if effort.photons == 0 { Vec::new() } else { (0..BATCHES).into_par_iter().map(finish).collect() };
    let total = |exact: f64, of: &dyn Fn(&Sums, f64) -> f64| {
        if finished.is_empty() {
            return Estimate::exact(exact);
        }
        stats::ratio(finished.iter().map(|(photon, s, lost)| (exact + photon * of(s, *lost), 1.0)))
    };
    let up = |s: &Sums| s.bands[..Band::Below as usize].iter().sum::<f64>();
    let down = Band::Below as usize;
    Ok(Gaze {
        reflected: Estimate::exact(totals.reflected),
        up: total(up(&sums), &|s, _| up(s)),
        down: total(sums.bands[down], &|s, _| s.bands[down]),
        up_cos2: total(sums.up_cos2, &|s, _| s.up_cos2),
        bands: std::array::from_fn(|b| total(sums.bands[b], &|s, _| s.bands[b])),
        lost: total(0.0, &|_, lost| lost),
        by_photons: totals.not_followed,
        beams: totals.beams,
    })
}

/// Light that remembers where its strongest path so far has left.
#[derive(Debug, Clone, Copy)]
pub struct Strongest {
    /// Power still inside.
    pub power: f64,
    /// The strongest exit so far, as a share of the light on the footprint.
    pub best: f64,
    /// Its direction; zero before the first.
    pub towards: DVec3,
}

impl Strongest {
    /// Light before its first facet.
    pub const FRESH: Strongest = Strongest { power: 1.0, best: 0.0, towards: DVec3::ZERO };

    /// Whether no later path can be stronger than the best so far.
    pub fn is_decided(&self) -> bool {
        self.power <= self.best
    }
}

impl Light for Strongest {
    fn power(&self) -> f64 {
        self.power
    }

    fn split(&self, at: &Interface) -> (Self, Self) {
        let (Scalar(out), Scalar(kept)) = Scalar(self.power).split(at);
        // at entry what passes goes on inside: it is no exit
        let leaves = at.eta < 1.0 && out > self.best;
        let (best, towards) = if leaves { (out, at.passed) } else { (self.best, self.towards) };
        (Strongest { power: out, ..*self }, Strongest { power: kept, best, towards })
    }

    fn goes_on(&self) -> bool {
        !self.is_decided()
    }
}

/// Shares of the outline by the [`Band`] of the strongest path of each point.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StrongestShares {
    /// By [`Band`].
    pub bands: [f64; 4],
    /// Share of the outline, within `bands`, where a beam that was not followed might have brought
    /// a stronger path: a bound on the error.
    pub undecided: f64,
    /// Share of the outline that belongs to no band: no light has left yet.
    pub dark: f64,
}

struct Areas {
    axis: DVec3,
    shares: StrongestShares,
}

impl Watch<Strongest, 1> for Areas {
    fn exit(&mut self, _: &Exit<Strongest, 1>) {}

    fn rest(&mut self, rest: &Rest<Strongest, 1>) {
        if rest.light.best > 0.0 {
            let z = rest.light.towards.dot(self.axis);
            self.shares.bands[band(z as f32) as usize] += rest.share;
            self.shares.undecided += if rest.light.is_decided() { 0.0 } else { rest.share };
        } else {
            self.shares.dark += rest.share;
        }
    }
}

/// ASET areas: where the strongest path of each point of the outline goes (reflection at entry
/// aside), by exact areas.
///
/// - `direction`, `index`: as for [`gaze`]; `stop_power`: beams weaker than this are left undecided
pub fn strongest(
    beams: &Beams,
    direction: DVec3,
    index: f64,
    stop_power: f64,
) -> Result<StrongestShares, ExperimentError> {
    check_index(index)?;
    let mut areas = Areas { axis: -direction, shares: StrongestShares::default() };
    let lit = Lit { direction, indices: [index] };
    beams.follow(&lit, Strongest::FRESH, stop_power, &mut areas);
    Ok(areas.shares)
}
