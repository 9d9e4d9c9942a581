//! Several objectives by a surrogate model: of the model's front, in each batch, the points that promise most
//! hypervolume.
//!
//! NSGA-II searches the model, which costs nothing, from the front so far (T. Akhtar and C. Shoemaker, J. Glob.
//! Optim. 64 (2016) 17).

use super::evolution::{nsga2, scores};
use super::hypervolume_gain::most_gaining;
use super::proposer::{Proposer, distance, spread};
use super::random;
use super::surrogate_model::{Sample, SurrogateModel};
use crate::search::method::{SearchError, SearchSettings};
use crate::search::problem::Outcome;
use genoxide::multi::MultiObjectiveAlgorithm;

/// Points of a batch.
const BATCH: usize = 12;

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
        let mut points = match SurrogateModel::fit(&self.samples, &order) {
            Some(model) => self.promising(&model, &front)?,
            None => Vec::new(),
        };
        // where the model promises too little, points from anywhere
        let first = self.round * BATCH as u64;
        let missing = BATCH - points.len();
        let random = (first..).take(missing).map(|i| random::point(self.first[0].len(), self.seed, i));
        points.extend(random);
        Ok(points)
    }

    /// The points of the model's front that add most to the front so far.
    fn promising(&self, model: &SurrogateModel, front: &[usize]) -> Result<Vec<Vec<f64>>, SearchError> {
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
        Ok(most_gaining(&known, &values, BATCH).into_iter().map(|i| points[i].clone()).collect())
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
