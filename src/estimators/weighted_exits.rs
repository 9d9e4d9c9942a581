//! Weighted exits: what leaves a stone lit from one direction, by beams, their residual finished by
//! photons; every exit weighted by the caller. The exact scores are sums of this kind.

use super::same_path::SamePath;
use super::{BATCHES, EstimatorError, check_index};
use crate::geometry::Plane;
use crate::optics::stokes::Stokes;
use crate::parallel;
use crate::sampling::stats::{self, Estimate};
use crate::trace::Interaction;
use crate::trace::beams::residual::{ResidualClient, ResidualPhotons};
use crate::trace::beams::{
    BeamExit, BeamLight, BeamVisitor, Beams, EntryFacet, IncidentBeam, ResidualBeam, StopCriteria,
    UnpolarisedLight,
};
use glam::DVec3;

/// The scores follow no more beams of one direction than this: a second's work, ten times what a
/// diamond needs. At an index of 10, which keeps nearly all light inside, there would be tens of
/// millions; what is left is then finished by photons.
pub const MAX_BEAMS: u64 = 4_000_000;

/// Effort of an integration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeamEffort {
    /// When beams are left to photons.
    pub stop: StopCriteria,
    /// Photons that finish them, all batches together (half to all of them are drawn); without any,
    /// the sums fall short by what is left over.
    pub photons: usize,
    /// Seed of the photons.
    pub seed: u64,
    /// Share of the light that sums without photons (the faceters' view) may leave untraced: half of it is
    /// taken to count, and half is their error. At 0 they follow all that is more than rounding.
    pub untraced: f64,
}

impl Default for BeamEffort {
    /// Of a brilliant's light about 2.3 % is left to photons face-up, 6 % at a tilt of 45°.
    fn default() -> Self {
        let until = StopCriteria { beams: MAX_BEAMS, ..StopCriteria::at_power(1e-5) };
        BeamEffort { stop: until, photons: 16_384, seed: 1, untraced: 0.0 }
    }
}

/// Light that leaves, in `K` lines that have met the same facets; the argument of a weight.
#[derive(Debug, Clone, Copy)]
pub struct ExitSample<const K: usize> {
    /// Facet through which it leaves, or at which it is reflected from outside.
    pub facet: usize,
    /// Unit direction outside of each line, stone's frame.
    pub directions: [DVec3; K],
    /// Cosine between the leading line and the axis on which the eye (or the lamp) lies: above 0 on
    /// its side of the horizon.
    pub up: f64,
}

/// Σ power × weight, for `N` weights, as shares of the light on the outline.
#[derive(Debug, Clone)]
pub struct WeightedSums<const N: usize> {
    /// What beams give.
    pub beam_sums: [f64; N],
    /// Reflection at entry, weighted likewise (the facet is the one lit); not part of the other sums.
    pub glare: [f64; N],
    /// All that is reflected at entry.
    pub reflected: f64,
    /// What is left to photons.
    pub residual: f64,
    /// Number of beams.
    pub beams: u64,
    /// Beams and photons together, one a batch, and what its photons have given up.
    batches: Vec<([f64; N], f64)>,
}

impl<const N: usize> WeightedSums<N> {
    /// The sum with weight `k`.
    pub fn sum(&self, k: usize) -> Estimate {
        self.estimate(self.beam_sums[k], |sums| (sums[k], 1.0))
    }

    /// The sum over several weights.
    pub fn sum_of(&self, weights: impl Iterator<Item = usize> + Clone) -> Estimate {
        let add = |sums: &[f64; N]| weights.clone().map(|k| sums[k]).sum();
        self.estimate(add(&self.beam_sums), |sums| (add(sums), 1.0))
    }

    /// The sum with weight `k` over the one with weight `by`; 0 if that is 0.
    pub fn ratio(&self, k: usize, by: usize) -> Estimate {
        let exact = if self.beam_sums[by] == 0.0 { 0.0 } else { self.beam_sums[k] / self.beam_sums[by] };
        self.estimate(exact, |sums| (sums[k], sums[by]))
    }

    /// The sums of each batch, and what its photons have given up; without photons the one of beams
    /// and what is left over.
    pub fn batches(&self) -> Vec<([f64; N], f64)> {
        if self.batches.is_empty() { vec![(self.beam_sums, self.residual)] } else { self.batches.clone() }
    }

    /// Given up by photons: light that total reflection keeps.
    pub fn untraced(&self) -> Estimate {
        match self.batches.len() {
            0 => Estimate::exact(0.0),
            _ => stats::ratio(self.batches.iter().map(|(_, lost)| (*lost, 1.0))),
        }
    }

    fn estimate(&self, exact: f64, of: impl Fn(&[f64; N]) -> (f64, f64)) -> Estimate {
        match self.batches.len() {
            0 => Estimate::exact(exact),
            _ => stats::ratio(self.batches.iter().map(|(sums, _)| of(sums))),
        }
    }
}

/// Adds up what leaves a stone.
///
/// - `lit`: a parallel beam of `K` lines; the first leads
/// - `polarised`: whether light keeps its polarisation from facet to facet (unpolarised outside); if
///   not it counts as unpolarised at each
/// - `weights`: of light that leaves; with several lines only where all have met the same facets, and
///   leave
///
/// Checked in `tests/library/beams.rs` against photons alone, and against an independent tracer.
pub fn integrate_exits<const K: usize, const N: usize>(
    beams: &Beams,
    lit: &IncidentBeam<K>,
    polarised: bool,
    effort: &BeamEffort,
    weights: impl Fn(&ExitSample<K>) -> [f64; N] + Sync,
) -> Result<WeightedSums<N>, EstimatorError> {
    for n in lit.indices {
        check_index(n)?;
    }
    if polarised {
        let light = Stokes::unpolarised(1.0, lit.direction.any_orthonormal_vector());
        Ok(integrate_exits_of(beams, lit, light, effort, weights))
    } else {
        Ok(integrate_exits_of(beams, lit, UnpolarisedLight(1.0), effort, weights))
    }
}

fn integrate_exits_of<L: BeamLight, const K: usize, const N: usize>(
    beams: &Beams,
    lit: &IncidentBeam<K>,
    light: L,
    effort: &BeamEffort,
    weights: impl Fn(&ExitSample<K>) -> [f64; N] + Sync,
) -> WeightedSums<N> {
    let axis = -lit.direction;
    let scales = WeightAccumulator { weights: &weights, axis, sums: [0.0; N] };
    let residual = ResidualPhotons::new(effort.seed, BATCHES, effort.photons / BATCHES);
    let mut sorted = ExitVisitor { scales, glare: [0.0; N], residual, finish: effort.photons > 0 };
    let totals = beams.trace(lit, light, effort.stop, &mut sorted);
    let ExitVisitor { scales: WeightAccumulator { sums, .. }, glare, residual, .. } = sorted;
    let finish = |batch: usize| {
        let scales = WeightAccumulator { weights: &weights, axis, sums: [0.0; N] };
        let mut finished = ResidualSums { scales, together: SamePath::NONE };
        let (photon, lost) = residual.trace(batch, beams.stone(), lit.indices, &mut finished);
        let photons = finished.scales.sums;
        (std::array::from_fn(|k| sums[k] + photon * photons[k]), photon * lost / K as f64)
    };
    let batches = if effort.photons == 0 { Vec::new() } else { parallel::map(BATCHES, finish) };
    let (left, reflected) = (totals.not_followed, totals.reflected);
    WeightedSums { beam_sums: sums, glare, reflected, residual: left, beams: totals.beams, batches }
}

/// Weights and their sums.
struct WeightAccumulator<'a, F, const N: usize> {
    weights: &'a F,
    axis: DVec3,
    sums: [f64; N],
}

impl<F, const N: usize> WeightAccumulator<'_, F, N> {
    #[inline]
    fn weights<const K: usize>(&self, facet: usize, directions: [DVec3; K]) -> [f64; N]
    where
        F: Fn(&ExitSample<K>) -> [f64; N],
    {
        let up = directions.first().map_or(0.0, |d| d.dot(self.axis));
        (self.weights)(&ExitSample { facet, directions, up })
    }

    #[inline]
    fn add<const K: usize>(&mut self, facet: usize, directions: [DVec3; K], power: f64)
    where
        F: Fn(&ExitSample<K>) -> [f64; N],
    {
        let weights = self.weights(facet, directions);
        for (sum, weight) in self.sums.iter_mut().zip(weights) {
            *sum += power * weight;
        }
    }
}

/// Visitor that sums exits of beams; the rest goes to photons.
struct ExitVisitor<'a, F, const K: usize, const N: usize> {
    scales: WeightAccumulator<'a, F, N>,
    glare: [f64; N],
    residual: ResidualPhotons<K>,
    finish: bool,
}

impl<L: BeamLight, F: Fn(&ExitSample<K>) -> [f64; N], const K: usize, const N: usize> BeamVisitor<L, K>
    for ExitVisitor<'_, F, K, N>
{
    fn reflected(&mut self, entrance: &EntryFacet, direction: DVec3, power: f64) {
        let weights = self.scales.weights(entrance.facet, [direction; K]);
        for (sum, weight) in self.glare.iter_mut().zip(weights) {
            *sum += power * weight;
        }
    }

    #[inline]
    fn exit(&mut self, exit: &BeamExit<L, K>) {
        let mut directions = [exit.direction; K];
        for (k, direction) in directions.iter_mut().enumerate().skip(1) {
            let Some(leaves) = exit.direction_of(k) else { return };
            *direction = leaves;
        }
        self.scales.add(exit.facet, directions, exit.power);
    }

    fn residual(&mut self, rest: &ResidualBeam<L, K>) {
        if self.finish {
            self.residual.add(rest);
        }
    }
}

/// Client that sums exits of photons.
struct ResidualSums<'a, F, const K: usize, const N: usize> {
    scales: WeightAccumulator<'a, F, N>,
    together: SamePath<K>,
}

impl<F: Fn(&ExitSample<K>) -> [f64; N], const K: usize, const N: usize> ResidualClient
    for ResidualSums<'_, F, K, N>
{
    fn begin(&mut self, lane: usize, _: &Plane) {
        self.together.begin(lane);
    }

    fn interact(&mut self, m: &Interaction) {
        for lane in SamePath::<K>::lanes() {
            if self.together.leave(m, lane) {
                let directions = std::array::from_fn(|k| m.direction(lane + k).as_dvec3());
                self.scales.add(m.facet[lane] as usize, directions, m.power[lane].into());
            }
        }
    }
}
