//! The view by exact beams, its residual finished by photons. Scores of one direction with little noise or
//! none.

use super::horizon::is_above;
use super::strongest_path::{StrongestExit, first_below};
use super::viewer_lighting::{AsetBand, band};
use super::weighted_exits::{BeamEffort, ExitSample, MAX_BEAMS, WeightedSums, integrate_exits};
use super::{EstimatorError, check_index, entry_sampling};
use crate::optics::stokes::Stokes;
use crate::sampling::stats::Estimate;
use crate::trace::beams::{
    BeamExit, BeamLight, BeamVisitor, Beams, IncidentBeam, Interface, ResidualBeam, StopCriteria,
    UnpolarisedLight,
};
use glam::DVec3;

/// Where the light of one direction goes, as shares of the light on the outline. Backward it is
/// what a parallel eye sees: bands count from the axis on which the eye lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeamView {
    /// Reflected at entry.
    pub reflected: Estimate,
    /// Leaves towards the eye's side of the horizon.
    pub up: Estimate,
    /// Leaves to the other side: leakage.
    pub down: Estimate,
    /// Leaves upward, weighted by cos² from the axis.
    pub up_cos2: Estimate,
    /// Leaves, by [`AsetBand`].
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
/// - `index`: of the stone; `polarised`: see [`integrate_exits`]
///
/// Without photons nothing is finished, and the sums fall short of 1 by `by_photons`. Checked in
/// `tests/library/beams.rs`.
pub fn beam_view(
    beams: &Beams,
    direction: DVec3,
    index: f64,
    polarised: bool,
    effort: &BeamEffort,
) -> Result<BeamView, EstimatorError> {
    let below = AsetBand::Below as usize;
    let cos2 = below + 1;
    let weighed: WeightedSums<5> =
        integrate_exits(beams, &IncidentBeam { direction, indices: [index] }, polarised, effort, |l| {
            let mut weights = [0.0; 5];
            weights[band(l.up as f32) as usize] = 1.0;
            weights[cos2] = l.up.max(0.0).powi(2);
            weights
        })?;
    Ok(BeamView {
        reflected: Estimate::exact(weighed.reflected),
        up: weighed.sum_of(0..below),
        down: weighed.sum(below),
        up_cos2: weighed.sum(cos2),
        bands: std::array::from_fn(|b| weighed.sum(b)),
        lost: weighed.untraced(),
        by_photons: weighed.residual,
        beams: weighed.beams,
    })
}

/// Weights that sort light by the elevation at which it leaves, for [`integrate_exits`]: the one numbered `i`
/// is 1 from limit `i` up to the next, the last up to the axis.
///
/// - `limits_deg`: rising, in degrees above the horizon of the eye's axis; from −90 on, all light has
///   a place
pub fn between<const N: usize>(limits_deg: [f64; N]) -> impl Fn(&ExitSample<1>) -> [f64; N] {
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

/// Light that records the exit of its strongest path so far.
#[derive(Debug, Clone, Copy)]
pub struct StrongestPath<L = UnpolarisedLight> {
    /// What is still inside.
    pub light: L,
    /// The strongest exit so far: its power as a share of the light on the footprint, and its direction.
    pub strongest: StrongestExit<f64, DVec3>,
    /// 1 once the light has met the pavilion.
    been_below: f64,
}

impl<L: BeamLight> StrongestPath<L> {
    /// Light before its first facet.
    pub fn new(light: L) -> Self {
        StrongestPath { light, strongest: StrongestExit::default(), been_below: 0.0 }
    }

    /// Whether no later path can be stronger than the best so far.
    pub fn is_decided(&self) -> bool {
        self.light.power() <= self.strongest.power
    }
}

impl<L: BeamLight> BeamLight for StrongestPath<L> {
    fn power(&self) -> f64 {
        self.light.power()
    }

    fn split(&self, at: &Interface) -> (Self, Self) {
        let (out, kept) = self.light.split(at);
        let mut stays = StrongestPath { light: kept, ..*self };
        // at entry what passes goes on inside: it is no exit
        if at.is_exit {
            let pavilion = if entry_sampling::is_pavilion(at.normal) { 1.0 } else { 0.0 };
            let windowed = first_below(&mut stays.been_below, pavilion);
            stays.strongest = self.strongest.or_stronger(out.power(), || (at.transmitted, windowed));
        }
        (StrongestPath { light: out, ..*self }, stays)
    }

    fn is_traced_further(&self) -> bool {
        !self.is_decided()
    }
}

/// Shares of the outline by the [`AsetBand`] of the strongest path of each point.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StrongestShares {
    /// By [`AsetBand`].
    pub bands: [f64; 4],
    /// Share of the outline, within `bands`, where a beam that was not followed might have brought
    /// a stronger path: a bound on the error.
    pub undecided: f64,
    /// Share of the outline that belongs to no band: no light has left yet.
    pub dark: f64,
    /// Share of the outline whose strongest path leaves through the first pavilion facet it meets.
    pub windowed: f64,
    /// Whether there were more than [`MAX_BEAMS`], and the rest was not followed: the shares are then no
    /// more than a guess.
    pub cut_short: bool,
}

struct StrongestAreas {
    axis: DVec3,
    shares: StrongestShares,
}

impl<L: BeamLight> BeamVisitor<StrongestPath<L>, 1> for StrongestAreas {
    fn exit(&mut self, _: &BeamExit<StrongestPath<L>, 1>) {}

    fn residual(&mut self, rest: &ResidualBeam<StrongestPath<L>, 1>) {
        let strongest = rest.light.strongest;
        self.shares.windowed += strongest.windowed * rest.share;
        if strongest.power > 0.0 {
            let z = strongest.towards.dot(self.axis);
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
/// - `direction`, `index`, `polarised`: as for [`beam_view`]; `stop_power`: beams weaker than this are left
///   undecided
pub fn strongest(
    beams: &Beams,
    direction: DVec3,
    index: f64,
    polarised: bool,
    stop_power: f64,
) -> Result<StrongestShares, EstimatorError> {
    check_index(index)?;
    let mut areas = StrongestAreas { axis: -direction, shares: StrongestShares::default() };
    let lit = IncidentBeam { direction, indices: [index] };
    let until = StopCriteria { beams: MAX_BEAMS, ..StopCriteria::at_power(stop_power) };
    let totals = if polarised {
        let light = Stokes::unpolarised(1.0, direction.any_orthonormal_vector());
        beams.trace(&lit, StrongestPath::new(light), until, &mut areas)
    } else {
        beams.trace(&lit, StrongestPath::new(UnpolarisedLight(1.0)), until, &mut areas)
    };
    if totals.is_short()
        && let Some(whole) = beams.whole()
    {
        return strongest(&whole, direction, index, polarised, stop_power);
    }
    Ok(StrongestShares { cut_short: totals.beams >= MAX_BEAMS, ..areas.shares })
}
