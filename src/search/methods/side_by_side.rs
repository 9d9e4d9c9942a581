//! Methods that improve a point for one objective, several side by side: simplexes of Nelder and Mead, and
//! CMA-ES.

use super::proposer::{Proposer, fitness, spread, unit_cube};
use crate::search::method::{SearchError, SearchSettings};
use crate::search::problem::Outcome;
use genoxide::algorithm::{Algorithm, Cmaes, NelderMead, cmaes, local};
use genoxide::genome::Reals;

/// Edges of a first simplex, in shares of the ranges.
const SIMPLEX_EDGE: f64 = 0.15;

/// The first standard deviation of CMA-ES, in shares of the ranges.
const FIRST_DEVIATION: f64 = 0.2;

/// An algorithm of `genoxide` for one objective.
pub type Climber = Box<dyn Algorithm<Genome = Reals>>;

/// Algorithms side by side: a batch has the next points of each.
#[derive(Default)]
pub struct SideBySide {
    /// Each with its own population.
    pub climbers: Vec<Climber>,
    /// How many points of the last batch are of each.
    asked: Vec<usize>,
}

/// Simplexes from the starts; one that has converged begins again at a random point (J. Nelder and R. Mead,
/// Comput. J. 7 (1965) 308).
pub fn nelder_mead(start: Vec<f64>, settings: &SearchSettings) -> Result<Box<dyn Proposer>, SearchError> {
    from_starts(start, settings, |point, seed| {
        let builder = NelderMead::builder(unit_cube(point.len())?).maximize().seed(seed);
        let builder = builder.initial_genome(Reals::from(point)).initial_step(SIMPLEX_EDGE);
        Ok(Box::new(builder.restarts(local::Restarts::Random { times: u64::MAX }).build()?))
    })
}

/// CMA-ES from the starts; one that has converged begins again at a random point with a larger population
/// (N. Hansen and A. Ostermeier, Evol. Comput. 9 (2001) 159; A. Auger and N. Hansen, CEC 2005, 1769).
pub fn cma_es(start: Vec<f64>, settings: &SearchSettings) -> Result<Box<dyn Proposer>, SearchError> {
    from_starts(start, settings, |point, seed| {
        let builder = Cmaes::builder(unit_cube(point.len())?).maximize().seed(seed);
        let builder = builder.initial_mean(Reals::from(point)).initial_step(FIRST_DEVIATION);
        Ok(Box::new(builder.restarts(cmaes::Restarts::Ipop).build()?))
    })
}

fn from_starts(
    start: Vec<f64>,
    settings: &SearchSettings,
    climber: impl Fn(Vec<f64>, u64) -> Result<Climber, SearchError>,
) -> Result<Box<dyn Proposer>, SearchError> {
    let starts = spread(start, settings.starts, settings.seed)?.into_iter().zip(0..);
    let climbers = starts.map(|(point, i)| climber(point, settings.seed.wrapping_add(i)));
    Ok(Box::new(SideBySide { climbers: climbers.collect::<Result<_, _>>()?, asked: Vec::new() }))
}

impl Proposer for SideBySide {
    fn ask(&mut self) -> Result<Vec<Vec<f64>>, SearchError> {
        let mut points = Vec::new();
        self.asked.clear();
        for climber in &mut self.climbers {
            let before = points.len();
            points.extend(climber.ask().iter().map(|genome| genome.to_vec()));
            self.asked.push(points.len() - before);
        }
        Ok(points)
    }

    fn tell(&mut self, outcomes: &[Outcome]) -> Result<(), SearchError> {
        let mut rest = outcomes;
        for (climber, &count) in self.climbers.iter_mut().zip(&self.asked) {
            let (own, others) = rest.split_at(count.min(rest.len()));
            climber.tell(&own.iter().map(fitness).collect::<Vec<_>>())?;
            rest = others;
        }
        Ok(())
    }
}
