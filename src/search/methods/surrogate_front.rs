//! Several objectives by a surrogate model: in each batch the points of the model's front that promise most
//! hypervolume, others near the front so far, and others far from everything that is known.
//!
//! NSGA-II searches the model, which costs nothing, from the front so far (T. Akhtar and C. Shoemaker, J. Glob.
//! Optim. 64 (2016) 17). Scores of stones have cliffs, where light begins to leave through a facet: a smooth model
//! does not know what lies behind one that it has not seen, and half of each batch is not its choice.

use super::evolution::{nsga2, scores};
use super::hypervolume_gain::most_gaining;
use super::proposer::{Proposer, distance, spread};
use super::random;
use super::surrogate_model::{Sample, SurrogateModel};
use crate::sampling::random::{Purpose, Stream};
use crate::search::method::{SearchError, SearchSettings};
use crate::search::problem::Outcome;
use genoxide::multi::MultiObjectiveAlgorithm;

/// Points of a batch.
const BATCH: usize = 12;

/// How far points near the front lie from one of it at most, in shares of the ranges: one point of a batch each.
const NEAR: [f64; 4] = [0.2, 0.06, 0.02, 0.006];

/// Points of a batch that are far from all others.
const FAR: u64 = 2;

/// Random points of which the one is taken that is farthest from all others.
const POOL: u64 = 30;

const NEAR_FRONT: Purpose = Purpose::named("near a front");
const FAR_FROM_ALL: Purpose = Purpose::named("far from all points");

/// Individuals of the search of the model, of which half are of the front so far.
const POPULATION: usize = 100;

/// Generations of the search of the model.
const GENERATIONS: usize = 40;

/// No point of a batch is nearer than this to what is known, in shares of the ranges.
const APART: f64 = 1e-3;

/// The search for a front of `M` objectives.
struct SurrogateFront<const M: usize> {
    seed: u64,
    round: u64,
    first: Vec<Vec<f64>>,
    samples: Vec<Sample>,
    asked: Vec<Vec<f64>>,
}

/// A search by a model for a front of 2 to [`MOST_OBJECTIVES`](crate::search::MOST_OBJECTIVES) objectives.
pub fn surrogate_front(
    objectives: usize,
    start: Vec<f64>,
    settings: &SearchSettings,
) -> Result<Box<dyn Proposer>, SearchError> {
    let variables = start.len();
    let first = (8 * variables + 8).min(settings.evaluations / 4).max(variables + 2);
    let first = spread(start, first, settings.seed)?;
    let seed = settings.seed;
    Ok(match objectives {
        2 => Box::new(SurrogateFront::<2>::new(first, seed)),
        3 => Box::new(SurrogateFront::<3>::new(first, seed)),
        4 => Box::new(SurrogateFront::<4>::new(first, seed)),
        _ => Box::new(SurrogateFront::<5>::new(first, seed)),
    })
}

impl<const M: usize> SurrogateFront<M> {
    fn new(first: Vec<Vec<f64>>, seed: u64) -> Self {
        Self { seed, round: 0, first, samples: Vec::new(), asked: Vec::new() }
    }

    /// The numbers of the feasible samples that none dominates.
    fn front(&self) -> Vec<usize> {
        let dominated =
            |i: usize| self.samples.iter().any(|other| other.outcome.dominates(&self.samples[i].outcome));
        (0..self.samples.len()).filter(|&i| self.samples[i].outcome.is_feasible() && !dominated(i)).collect()
    }

    fn by_model(&self) -> Result<Vec<Vec<f64>>, SearchError> {
        let front = self.front();
        // for the model the front matters most, then what was found last
        let others = (0..self.samples.len()).rev().filter(|number| !front.contains(number));
        let order: Vec<usize> = front.iter().copied().chain(others).collect();
        let mut points = self.near(&front);
        for number in 0..FAR {
            points.push(self.far(&points, self.round * FAR + number));
        }
        if let Some(model) = SurrogateModel::fit(&self.samples, &order) {
            points.extend(self.promising(&model, &front, BATCH - points.len())?);
        }
        // where the model promises too little, points from anywhere
        let first = self.round * BATCH as u64;
        let missing = BATCH - points.len();
        let random = (first..).take(missing).map(|i| random::point(self.first[0].len(), self.seed, i));
        points.extend(random);
        Ok(points)
    }

    /// Points near random ones of the front.
    fn near(&self, front: &[usize]) -> Vec<Vec<f64>> {
        let of_width = |(i, width): (u64, &f64)| {
            let mut stream = Stream::new(self.seed, NEAR_FRONT, self.round * NEAR.len() as u64 + i);
            let from = front[((stream.unit64() * front.len() as f64) as usize).min(front.len() - 1)];
            let moved = |x: &f64| (x + width * (2.0 * stream.unit64() - 1.0)).clamp(0.0, 1.0);
            self.samples[from].point.iter().map(moved).collect()
        };
        if front.is_empty() { Vec::new() } else { (0..).zip(&NEAR).map(of_width).collect() }
    }

    /// Of random points the one that is farthest from all samples and from others of the batch.
    fn far(&self, chosen: &[Vec<f64>], number: u64) -> Vec<f64> {
        let variables = self.first[0].len();
        let random = |index: u64| -> Vec<f64> {
            let mut stream = Stream::new(self.seed, FAR_FROM_ALL, index);
            (0..variables).map(|_| stream.unit64()).collect()
        };
        let gap = |point: &[f64]| {
            let known = self.samples.iter().map(|sample| &sample.point).chain(chosen);
            known.map(|other| distance(other, point)).fold(1.0, f64::min)
        };
        let pool = (number * POOL..(number + 1) * POOL).map(random).map(|point| (gap(&point), point));
        pool.max_by(|a, b| a.0.total_cmp(&b.0)).map_or_else(Vec::new, |(_, point)| point)
    }

    /// The points of the model's front that add most to the front so far.
    fn promising(
        &self,
        model: &SurrogateModel,
        front: &[usize],
        count: usize,
    ) -> Result<Vec<Vec<f64>>, SearchError> {
        // of a large front every so many, others in each round
        let step = front.len().div_ceil(POPULATION / 2).max(1);
        let parents = front.iter().skip(self.round as usize % step).step_by(step);
        let parents = parents.map(|&i| self.samples[i].point.clone()).collect();
        let variables = self.first[0].len();
        let mut search = nsga2::<M>(variables, parents, POPULATION, self.seed.wrapping_add(self.round))?;
        for _ in 0..GENERATIONS {
            let asked: Vec<Vec<f64>> = search.ask().iter().map(|genome| genome.to_vec()).collect();
            let expected: Vec<_> = asked.iter().map(|point| scores(&model.predict(point))).collect();
            search.tell(&expected)?;
        }
        let points = search.population().iter().map(|individual| individual.genome().to_vec());
        let is_new = |point: &Vec<f64>| self.samples.iter().all(|s| distance(&s.point, point) >= APART);
        let expected = points.filter(is_new).map(|point| (model.predict(&point), point));
        let (expected, points): (Vec<Outcome>, Vec<Vec<f64>>) =
            expected.filter(|(outcome, _)| outcome.is_feasible()).unzip();
        let values: Vec<Vec<f64>> = expected.into_iter().map(|outcome| outcome.objectives).collect();
        let known: Vec<Vec<f64>> =
            front.iter().map(|&i| self.samples[i].outcome.objectives.clone()).collect();
        Ok(most_gaining(&known, &values, count).into_iter().map(|i| points[i].clone()).collect())
    }
}

impl<const M: usize> Proposer for SurrogateFront<M> {
    fn ask(&mut self) -> Result<Vec<Vec<f64>>, SearchError> {
        self.asked = if self.round == 0 { self.first.clone() } else { self.by_model()? };
        self.round += 1;
        Ok(self.asked.clone())
    }

    fn tell(&mut self, outcomes: &[Outcome]) -> Result<(), SearchError> {
        let told = self.asked.drain(..).zip(outcomes);
        self.samples.extend(told.map(|(point, outcome)| Sample { point, outcome: outcome.clone() }));
        Ok(())
    }
}
