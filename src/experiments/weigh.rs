//! Weigh: what leaves a stone lit from one direction, by beams, their remainder finished by photons;
//! every exit weighted as the caller likes. The exact scores are sums of this kind.

use super::together::Together;
use super::{BATCHES, ExperimentError, check_index};
use crate::math::stats::{self, Estimate};
use crate::optics::stokes::Stokes;
use crate::solid::Plane;
use crate::walk::Meeting;
use crate::walk::beams::remainder::{Photons, Remainder};
use crate::walk::beams::{Beams, Entrance, Exit, Light, Lit, Rest, Scalar, Until, Watch};
use glam::DVec3;
use rayon::prelude::*;

/// The scores follow no more beams of one direction than this: a second's work, ten times what a
/// diamond needs. At an index of 10, which keeps nearly all light inside, there would be tens of
/// millions; what is left is then finished by photons.
pub const MOST_BEAMS: u64 = 4_000_000;

/// How hard to work.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// When beams are left to photons.
    pub until: Until,
    /// Photons that finish them, all batches together (half to all of them are drawn); without any,
    /// the sums fall short by what is left over.
    pub photons: usize,
    /// Seed of the photons.
    pub seed: u64,
}

impl Default for Effort {
    /// Of a brilliant's light about 2.3 % is left to photons face-up, 6 % at a tilt of 45°.
    fn default() -> Self {
        let until = Until { beams: MOST_BEAMS, ..Until::power(1e-5) };
        Effort { until, photons: 16_384, seed: 1 }
    }
}

/// Light that leaves, in `K` lines that have come the same way; what a weight depends on.
#[derive(Debug, Clone, Copy)]
pub struct Leaving<const K: usize> {
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
pub struct Weighed<const N: usize> {
    /// What beams give.
    pub by_beams: [f64; N],
    /// Reflection at entry, weighted likewise (the facet is the one lit); no part of the rest.
    pub glare: [f64; N],
    /// All that is reflected at entry.
    pub reflected: f64,
    /// What is left to photons.
    pub left: f64,
    /// Number of beams.
    pub beams: u64,
    /// Beams and photons together, one a batch, and what its photons have given up.
    batches: Vec<([f64; N], f64)>,
}

impl<const N: usize> Weighed<N> {
    /// The sum with weight `k`.
    pub fn sum(&self, k: usize) -> Estimate {
        self.estimate(self.by_beams[k], |sums| (sums[k], 1.0))
    }

    /// The sum over several weights.
    pub fn sum_of(&self, weights: impl Iterator<Item = usize> + Clone) -> Estimate {
        let add = |sums: &[f64; N]| weights.clone().map(|k| sums[k]).sum();
        self.estimate(add(&self.by_beams), |sums| (add(sums), 1.0))
    }

    /// The sum with weight `k` over the one with weight `by`; 0 if that is 0.
    pub fn ratio(&self, k: usize, by: usize) -> Estimate {
        let exact = if self.by_beams[by] == 0.0 { 0.0 } else { self.by_beams[k] / self.by_beams[by] };
        self.estimate(exact, |sums| (sums[k], sums[by]))
    }

    /// The sums of each batch, and what its photons have given up; without photons the one of beams
    /// and what is left over.
    pub fn batches(&self) -> Vec<([f64; N], f64)> {
        if self.batches.is_empty() { vec![(self.by_beams, self.left)] } else { self.batches.clone() }
    }

    /// Given up by photons: light that total reflection keeps.
    pub fn lost(&self) -> Estimate {
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
/// Checked in `tests/beams.rs` against photons alone, and against an independent tracer.
pub fn weigh<const K: usize, const N: usize>(
    beams: &Beams,
    lit: &Lit<K>,
    polarised: bool,
    effort: &Effort,
    weights: impl Fn(&Leaving<K>) -> [f64; N] + Sync,
) -> Result<Weighed<N>, ExperimentError> {
    for n in lit.indices {
        check_index(n)?;
    }
    if polarised {
        let light = Stokes::unpolarised(1.0, lit.direction.any_orthonormal_vector());
        Ok(weigh_light(beams, lit, light, effort, weights))
    } else {
        Ok(weigh_light(beams, lit, Scalar(1.0), effort, weights))
    }
}

fn weigh_light<L: Light, const K: usize, const N: usize>(
    beams: &Beams,
    lit: &Lit<K>,
    light: L,
    effort: &Effort,
    weights: impl Fn(&Leaving<K>) -> [f64; N] + Sync,
) -> Weighed<N> {
    let axis = -lit.direction;
    let scales = Scales { weights: &weights, axis, sums: [0.0; N] };
    let remainder = Remainder::new(effort.seed, BATCHES, effort.photons / BATCHES);
    let mut sorted = Sorted { scales, glare: [0.0; N], remainder, finish: effort.photons > 0 };
    let totals = beams.follow(lit, light, effort.until, &mut sorted);
    let Sorted { scales: Scales { sums, .. }, glare, remainder, .. } = sorted;
    let finish = |batch: usize| {
        let scales = Scales { weights: &weights, axis, sums: [0.0; N] };
        let mut finished = Finished { scales, together: Together::NONE };
        let (photon, lost) = remainder.walk(batch, beams.stone(), lit.indices, &mut finished);
        let photons = finished.scales.sums;
        (std::array::from_fn(|k| sums[k] + photon * photons[k]), photon * lost / K as f64)
    };
    let batches =
        if effort.photons == 0 { Vec::new() } else { (0..BATCHES).into_par_iter().map(finish).collect() };
    let (left, reflected) = (totals.not_followed, totals.reflected);
    Weighed { by_beams: sums, glare, reflected, left, beams: totals.beams, batches }
}

/// Weights and what they add up to.
struct Scales<'a, F, const N: usize> {
    weights: &'a F,
    axis: DVec3,
    sums: [f64; N],
}

impl<F, const N: usize> Scales<'_, F, N> {
    #[inline]
    fn weights<const K: usize>(&self, facet: usize, directions: [DVec3; K]) -> [f64; N]
    where
        F: Fn(&Leaving<K>) -> [f64; N],
    {
        let up = directions.first().map_or(0.0, |d| d.dot(self.axis));
        (self.weights)(&Leaving { facet, directions, up })
    }

    #[inline]
    fn add<const K: usize>(&mut self, facet: usize, directions: [DVec3; K], power: f64)
    where
        F: Fn(&Leaving<K>) -> [f64; N],
    {
        let weights = self.weights(facet, directions);
        for (sum, weight) in self.sums.iter_mut().zip(weights) {
            *sum += power * weight;
        }
    }
}

/// Exits into sums, the rest into photons.
struct Sorted<'a, F, const K: usize, const N: usize> {
    scales: Scales<'a, F, N>,
    glare: [f64; N],
    remainder: Remainder<K>,
    finish: bool,
}

impl<L: Light, F: Fn(&Leaving<K>) -> [f64; N], const K: usize, const N: usize> Watch<L, K>
    for Sorted<'_, F, K, N>
{
    fn reflected(&mut self, entrance: &Entrance, direction: DVec3, power: f64) {
        let weights = self.scales.weights(entrance.facet, [direction; K]);
        for (sum, weight) in self.glare.iter_mut().zip(weights) {
            *sum += power * weight;
        }
    }

    #[inline]
    fn exit(&mut self, exit: &Exit<L, K>) {
        let mut directions = [exit.direction; K];
        for (k, direction) in directions.iter_mut().enumerate().skip(1) {
            let Some(leaves) = exit.direction_of(k) else { return };
            *direction = leaves;
        }
        self.scales.add(exit.facet, directions, exit.power);
    }

    fn rest(&mut self, rest: &Rest<L, K>) {
        if self.finish {
            self.remainder.add(rest);
        }
    }
}

/// Photons into sums.
struct Finished<'a, F, const K: usize, const N: usize> {
    scales: Scales<'a, F, N>,
    together: Together<K>,
}

impl<F: Fn(&Leaving<K>) -> [f64; N], const K: usize, const N: usize> Photons for Finished<'_, F, K, N> {
    fn begins(&mut self, lane: usize, _: &Plane) {
        self.together.begin(lane);
    }

    fn meet(&mut self, m: &Meeting) {
        for lane in Together::<K>::lanes() {
            if self.together.leave(m, lane) {
                let directions = std::array::from_fn(|k| m.direction(lane + k).as_dvec3());
                self.scales.add(m.facet[lane] as usize, directions, m.power[lane].into());
            }
        }
    }
}
