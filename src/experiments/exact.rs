//! Exact: the view by beams, its remainder finished by photons. Scores of one direction without
//! noise, or all but.

use super::horizon::is_above;
use super::view::{Band, band};
use super::weigh::{Effort, Leaving, MOST_BEAMS, Weighed, weigh};
use super::{ExperimentError, check_index, entrance};
use crate::math::stats::Estimate;
use crate::optics::stokes::Stokes;
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
        let above = |limit: &f64| is_above(l.up as f32, *limit as f32);
        let lowest = sines.first().is_some_and(|limit| l.up >= *limit).then_some(0);
        if let Some(last) = sines.iter().rposition(above).or(lowest) {
            weights[last] = 1.0;
        }
        weights
    }
}

/// Light that remembers where its strongest path so far has left.
#[derive(Debug, Clone, Copy)]
pub struct Strongest<L = Scalar> {
    /// What is still inside.
    pub light: L,
    /// The strongest exit so far, as a share of the light on the footprint.
    pub best: f64,
    /// Its direction; zero before the first.
    pub towards: DVec3,
    /// Whether it left through the first pavilion facet that the light met.
    pub windowed: bool,
    /// Whether the light has met the pavilion.
    been_below: bool,
}

impl<L: Light> Strongest<L> {
    /// Light before its first facet.
    pub fn fresh(light: L) -> Self {
        Strongest { light, best: 0.0, towards: DVec3::ZERO, windowed: false, been_below: false }
    }

    /// Whether no later path can be stronger than the best so far.
    pub fn is_decided(&self) -> bool {
        self.light.power() <= self.best
    }
}

impl<L: Light> Light for Strongest<L> {
    fn power(&self) -> f64 {
        self.light.power()
    }

    fn split(&self, at: &Interface) -> (Self, Self) {
        let (out, kept) = self.light.split(at);
        let mut stays = Strongest { light: kept, ..*self };
        // at entry what passes goes on inside: it is no exit
        if at.leaves {
            let first = !self.been_below && entrance::is_pavilion(at.normal);
            stays.been_below |= first;
            if out.power() > self.best {
                stays = Strongest { best: out.power(), towards: at.passed, windowed: first, ..stays };
            }
        }
        (Strongest { light: out, ..*self }, stays)
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
    /// Share of the outline whose strongest path leaves through the first pavilion facet it meets.
    pub windowed: f64,
    /// Whether there were more than [`MOST_BEAMS`], and the rest was not followed: the shares are then
    /// good for nothing but a guess.
    pub cut_short: bool,
}

struct Areas {
    axis: DVec3,
    shares: StrongestShares,
}

impl<L: Light> Watch<Strongest<L>, 1> for Areas {
    fn exit(&mut self, _: &Exit<Strongest<L>, 1>) {}

    fn rest(&mut self, rest: &Rest<Strongest<L>, 1>) {
        self.shares.windowed += if rest.light.windowed { rest.share } else { 0.0 };
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
/// - `direction`, `index`, `polarised`: as for [`gaze`]; `stop_power`: beams weaker than this are left
///   undecided
pub fn strongest(
    beams: &Beams,
    direction: DVec3,
    index: f64,
    polarised: bool,
    stop_power: f64,
) -> Result<StrongestShares, ExperimentError> {
    check_index(index)?;
    let mut areas = Areas { axis: -direction, shares: StrongestShares::default() };
    let lit = Lit { direction, indices: [index] };
    let until = Until { beams: MOST_BEAMS, ..Until::power(stop_power) };
    let totals = if polarised {
        let light = Stokes::unpolarised(1.0, direction.any_orthonormal_vector());
        beams.follow(&lit, Strongest::fresh(light), until, &mut areas)
    } else {
        beams.follow(&lit, Strongest::fresh(Scalar(1.0)), until, &mut areas)
    };
    Ok(StrongestShares { cut_short: totals.beams >= MOST_BEAMS, ..areas.shares })
}
