//! Exact: the view by beams, its remainder finished by photons. Scores of one direction without
//! noise, or all but.

use super::view::{Band, band};
use super::weigh::{Effort, Leaving, Weighed, weigh};
use super::{ExperimentError, check_index};
use crate::math::stats::Estimate;
use crate::walk::beams::{Beams, Exit, Interface, Light, Lit, Rest, Scalar, Until, Watch};
use glam::DVec3;

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

/// Traces a parallel beam through a stone to its end.
///
/// - `direction`: unit, in which the light goes; −z for a face-up stone
/// - `index`: of the stone; `polarised`: see [`weigh`]
///
/// Without photons nothing is finished, and the sums fall short of 1 by `by_photons`. Checked in
/// `tests/beams.rs`.
pub fn gaze(
    beams: &Beams,
    direction: DVec3,
    index: f64,
    polarised: bool,
    effort: &Effort,
) -> Result<Gaze, ExperimentError> {
    let below = Band::Below as usize;
    let cos2 = below + 1;
    let weighed: Weighed<5> = weigh(beams, &Lit { direction, indices: [index] }, polarised, effort, |l| {
        let mut weights = [0.0; 5];
        weights[band(l.up as f32) as usize] = 1.0;
        weights[cos2] = l.up.max(0.0).powi(2);
        weights
    })?;
    Ok(Gaze {
        reflected: Estimate::exact(weighed.reflected),
        up: weighed.sum_of(0..below),
        down: weighed.sum(below),
        up_cos2: weighed.sum(cos2),
        bands: std::array::from_fn(|b| weighed.sum(b)),
        lost: weighed.lost(),
        by_photons: weighed.left,
        beams: weighed.beams,
    })
}

/// Weights that sort light by the elevation at which it leaves, for [`weigh`]: the one numbered `i`
/// is 1 from limit `i` up to the next, the last up to the axis.
///
/// - `limits_deg`: rising, in degrees above the horizon of the eye's axis; from −90 on, all light has
///   a place
pub fn between<const N: usize>(limits_deg: [f64; N]) -> impl Fn(&Leaving<1>) -> [f64; N] {
    let sines = limits_deg.map(|limit| limit.to_radians().sin());
    move |l| {
        let mut weights = [0.0; N];
        if let Some(last) = sines.iter().rposition(|s| l.up >= *s) {
            weights[last] = 1.0;
        }
        weights
    }
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
        let leaves = at.leaves && out > self.best;
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
    beams.follow(&lit, Strongest::FRESH, Until::power(stop_power), &mut areas);
    Ok(areas.shares)
}
