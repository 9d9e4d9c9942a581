//! One objective by a surrogate model: the peaks of the model, and simplexes from the best that it finds.
//!
//! For half of the budget each batch has the model's highest points and others that are new and promising
//! (R. Regis and C. Shoemaker, INFORMS J. Comput. 19 (2007) 497); for the rest simplexes go to the top, which
//! they reach where a model has no longer enough samples, and at kinks and constraints.

use super::proposer::{Proposer, distance, fitness, spread, unit_cube};
use super::random;
use super::side_by_side::{Climber, SideBySide};
use super::surrogate_model::{Sample, SurrogateModel};
use crate::search::method::{SearchError, SearchSettings};
use crate::search::problem::Outcome;
use genoxide::Objective;
use genoxide::algorithm::{Algorithm, Cmaes, NelderMead};
use genoxide::genome::Reals;

/// The first standard deviations of the searches for the model's peak, in shares of the ranges: everywhere,
/// and around the best.
const PEAKS: [f64; 2] = [0.3, 0.03];

/// The boxes around the best in which a point is chosen that is new and promising.
const LOOKS: [Look; 4] = [
    Look { width: 2.0, novelty: 0.7 },
    Look { width: 0.3, novelty: 0.4 },
    Look { width: 0.1, novelty: 0.2 },
    Look { width: 0.02, novelty: 0.05 },
];

/// A box around the best, and what counts in it.
struct Look {
    /// In shares of the ranges; 2 and more is everything.
    width: f64,
    /// How much the distance to what is known counts, against the expected value: 0 to 1.
    novelty: f64,
}

/// Random points among which a look chooses.
const POOL: u64 = 200;

/// Generations of a search for the model's peak.
const GENERATIONS: usize = 40;

/// No peak is nearer than this to what is known, in shares of the ranges.
const APART: f64 = 1e-4;

/// The share of the values below which the model takes them all for the same.
const LEVELLED: f64 = 0.2;

/// Edges of the first simplexes, in shares of the ranges, and of those that begin when one has converged.
const EDGES: [f64; 2] = [0.05, 0.15];

/// A simplex has converged when it is this much smaller than at first.
const CONVERGED: f64 = 2e-3;

/// Points within this of where a simplex has begun are not begun from, in shares of the ranges.
const SAME_PEAK: f64 = 0.1;

/// The search for the best point.
struct SurrogatePeak {
    seed: u64,
    round: u64,
    first: Vec<Vec<f64>>,
    /// Evaluations after which simplexes begin.
    modelled: usize,
    /// How many simplexes there are at a time.
    starts: usize,
    samples: Vec<Sample>,
    asked: Vec<Vec<f64>>,
    simplexes: SideBySide,
    /// Points from which simplexes have begun.
    begun: Vec<Vec<f64>>,
}

/// A search by a model for the best point.
pub fn surrogate_peak(start: Vec<f64>, settings: &SearchSettings) -> Result<Box<dyn Proposer>, SearchError> {
    let variables = start.len();
    let first = (3 * variables + 3).min(settings.evaluations / 3).max(variables + 2);
    Ok(Box::new(SurrogatePeak {
        seed: settings.seed,
        round: 0,
        first: spread(start, first, settings.seed)?,
        modelled: settings.evaluations / 2,
        starts: settings.starts.max(1),
        samples: Vec::new(),
        asked: Vec::new(),
        simplexes: SideBySide::default(),
        begun: Vec::new(),
    }))
}

impl SurrogatePeak {
    /// The numbers of the samples from the best.
    fn ranked(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.samples.len()).collect();
        let found: Vec<_> = self.samples.iter().map(|sample| fitness(&sample.outcome)).collect();
        order.sort_by(|&i, &j| Objective::Maximize.compare(found[j], found[i]));
        order
    }

    /// Whether a point is apart from all samples and from others of the batch.
    fn gap(&self, chosen: &[Vec<f64>], point: &[f64]) -> f64 {
        let known = self.samples.iter().map(|sample| &sample.point).chain(chosen);
        known.map(|other| distance(other, point)).fold(1.0, f64::min)
    }

    fn by_model(&self) -> Result<Vec<Vec<f64>>, SearchError> {
        let ranked = self.ranked();
        let best = &self.samples[ranked[0]].point;
        let Some(model) = SurrogateModel::fit(&self.samples, &ranked, LEVELLED) else {
            let first = self.round * LOOKS.len() as u64;
            return Ok((first..)
                .take(LOOKS.len())
                .map(|i| random::point(best.len(), self.seed, i))
                .collect());
        };
        let mut chosen: Vec<Vec<f64>> = Vec::new();
        for deviation in PEAKS {
            let peak = self.peak(&model, best, deviation)?;
            if self.gap(&chosen, &peak) >= APART {
                chosen.push(peak);
            }
        }
        for (look, number) in LOOKS.iter().zip(0..) {
            let point = self.new_and_promising(&model, best, &chosen, look, number);
            chosen.extend(point);
        }
        Ok(chosen)
    }

    /// The highest point of the model that CMA-ES finds from the best sample.
    fn peak(&self, model: &SurrogateModel, best: &[f64], deviation: f64) -> Result<Vec<f64>, SearchError> {
        let builder =
            Cmaes::builder(unit_cube(best.len())?).maximize().seed(self.seed.wrapping_add(self.round));
        let mut cma_es = builder.initial_mean(Reals::from(best.to_vec())).initial_step(deviation).build()?;
        for _ in 0..GENERATIONS {
            let expected: Vec<_> = cma_es.ask().iter().map(|x| fitness(&model.predict(x))).collect();
            cma_es.tell(&expected)?;
        }
        Ok(cma_es.best().map_or_else(|| best.to_vec(), |individual| individual.genome().to_vec()))
    }

    /// Of random points in a box the one with the best sum of expected value and distance to what is known.
    fn new_and_promising(
        &self,
        model: &SurrogateModel,
        best: &[f64],
        chosen: &[Vec<f64>],
        look: &Look,
        number: u64,
    ) -> Option<Vec<f64>> {
        let first = (self.round * LOOKS.len() as u64 + number) * POOL;
        let within = |index: u64| -> Vec<f64> {
            let ends = |b: f64| ((b - look.width / 2.0).max(0.0), (b + look.width / 2.0).min(1.0));
            let random = random::point(best.len(), self.seed, first + index);
            let placed = random.iter().zip(best).map(|(u, &b)| (u, ends(b)));
            placed.map(|(u, (low, high))| low + u * (high - low)).collect()
        };
        let pool: Vec<Vec<f64>> = (0..POOL).map(within).collect();
        let gaps: Vec<f64> = pool.iter().map(|point| self.gap(chosen, point)).collect();
        let expected: Vec<Outcome> = pool.iter().map(|point| model.predict(point)).collect();
        let values: Vec<f64> =
            expected.iter().map(|outcome| outcome.objectives.first().copied().unwrap_or(0.0)).collect();
        let shares = scaled(&values).into_iter().zip(scaled(&gaps)).zip(&expected);
        let merits: Vec<f64> = shares
            .map(|((value, gap), outcome)| {
                (1.0 - look.novelty) * value + look.novelty * gap - 2.0 * outcome.violation
            })
            .collect();
        let chosen = (0..pool.len()).max_by(|&i, &j| merits[i].total_cmp(&merits[j]))?;
        pool.into_iter().nth(chosen)
    }

    /// Simplexes from the best samples in place of those that have converged.
    fn renew_simplexes(&mut self) -> Result<(), SearchError> {
        self.simplexes.climbers.retain(|simplex| !simplex.is_finished());
        while self.simplexes.climbers.len() < self.starts {
            let ranked = self.ranked();
            let is_new = |number: &&usize| {
                self.begun.iter().all(|begun| distance(begun, &self.samples[**number].point) > SAME_PEAK)
            };
            // where everything has been begun from: from the best, with another size
            let number = *ranked.iter().find(is_new).unwrap_or(&ranked[0]);
            let point = self.samples[number].point.clone();
            let edge = EDGES[usize::from(self.begun.len() >= self.starts)];
            self.begun.push(point.clone());
            self.simplexes.climbers.push(simplex(point, edge)?);
        }
        Ok(())
    }
}

/// A simplex that ends when it has converged.
fn simplex(point: Vec<f64>, edge: f64) -> Result<Climber, SearchError> {
    let builder = NelderMead::builder(unit_cube(point.len())?).maximize().seed(0).tolerance(CONVERGED);
    Ok(Box::new(builder.initial_genome(Reals::from(point)).initial_step(edge).build()?))
}

/// Values as shares of the way from the least to the largest.
fn scaled(values: &[f64]) -> Vec<f64> {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    values.iter().map(|value| if high > low { (value - low) / (high - low) } else { 0.0 }).collect()
}

impl Proposer for SurrogatePeak {
    fn ask(&mut self) -> Result<Vec<Vec<f64>>, SearchError> {
        self.asked = if self.round == 0 {
            self.first.clone()
        } else if self.samples.len() < self.modelled {
            self.by_model()?
        } else {
            self.renew_simplexes()?;
            self.simplexes.ask()?
        };
        self.round += 1;
        Ok(self.asked.clone())
    }

    fn tell(&mut self, outcomes: &[Outcome]) -> Result<(), SearchError> {
        // before the first simplex there is none to be told
        self.simplexes.tell(outcomes)?;
        let told = self.asked.drain(..).zip(outcomes);
        self.samples.extend(told.map(|(point, outcome)| Sample { point, outcome: outcome.clone() }));
        Ok(())
    }
}
