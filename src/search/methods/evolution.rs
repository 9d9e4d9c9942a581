//! Evolutionary methods for a front: NSGA-II and SMS-EMOA.

use super::proposer::{Proposer, spread, unit_cube};
use crate::search::method::{SearchError, SearchSettings};
use crate::search::problem::Outcome;
use genoxide::Objective;
use genoxide::genome::{Real, Reals};
use genoxide::multi::{MultiObjectiveAlgorithm, Nsga2, Scores, SmsEmoa};
use genoxide::operator::{PolynomialMutation, SimulatedBinaryCrossover};

/// Distribution index of the simulated binary crossover.
const CROSSOVER_INDEX: f64 = 15.0;

/// Distribution index of the polynomial mutation; one variable in a child is changed on average.
const MUTATION_INDEX: f64 = 20.0;

/// Generations for which the population is chosen.
const GENERATIONS: usize = 20;

/// The two methods of this file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Evolutionary {
    /// Selection by non-dominated sorting and crowding (K. Deb et al., IEEE Trans. Evol. Comput. 6 (2002) 182).
    Nsga2,
    /// Selection by hypervolume (N. Beume, B. Naujoks and M. Emmerich, Eur. J. Oper. Res. 181 (2007) 1653).
    SmsEmoa,
}

/// NSGA-II over the unit cube, for `M` objectives to be maximised.
pub type CubeNsga2<const M: usize> = Nsga2<Real, SimulatedBinaryCrossover, PolynomialMutation, M>;

/// An algorithm of `genoxide` for so many objectives.
struct Evolution<A, const M: usize>(A);

/// A search for a front of 2 to [`MOST_OBJECTIVES`](crate::search::MOST_OBJECTIVES) objectives.
pub fn evolution(
    method: Evolutionary,
    objectives: usize,
    start: Vec<f64>,
    settings: &SearchSettings,
) -> Result<Box<dyn Proposer>, SearchError> {
    match objectives {
        2 => evolution_of::<2>(method, start, settings),
        3 => evolution_of::<3>(method, start, settings),
        4 => evolution_of::<4>(method, start, settings),
        _ => evolution_of::<5>(method, start, settings),
    }
}

fn evolution_of<const M: usize>(
    method: Evolutionary,
    start: Vec<f64>,
    settings: &SearchSettings,
) -> Result<Box<dyn Proposer>, SearchError> {
    let variables = start.len();
    let size = (settings.evaluations / GENERATIONS).clamp(12, 100);
    let points = spread(start, size, settings.seed)?;
    if method == Evolutionary::Nsga2 {
        return Ok(Box::new(Evolution::<_, M>(nsga2::<M>(variables, points, size, settings.seed)?)));
    }
    let algorithm = SmsEmoa::builder(unit_cube(variables)?, [Objective::Maximize; M])
        .population_size(size)
        .offspring((size / 4).max(1))
        .crossover(SimulatedBinaryCrossover::new(CROSSOVER_INDEX)?)
        .mutate(PolynomialMutation::per_gene(1.0 / variables as f64, MUTATION_INDEX)?)
        .seed(settings.seed)
        .initial_genomes(points.into_iter().map(Reals::from))
        .build()?;
    Ok(Box::new(Evolution::<_, M>(algorithm)))
}

/// NSGA-II over a cube of so many variables.
///
/// - `first`: of the first population; the rest of it is random
pub fn nsga2<const M: usize>(
    variables: usize,
    first: Vec<Vec<f64>>,
    size: usize,
    seed: u64,
) -> Result<CubeNsga2<M>, SearchError> {
    let builder = Nsga2::builder(unit_cube(variables)?, [Objective::Maximize; M])
        .population_size(size)
        .crossover(SimulatedBinaryCrossover::new(CROSSOVER_INDEX)?)
        .mutate(PolynomialMutation::per_gene(1.0 / variables as f64, MUTATION_INDEX)?);
    Ok(builder.seed(seed).initial_genomes(first.into_iter().map(Reals::from)).build()?)
}

/// The outcome of a point as `genoxide` compares it.
pub fn scores<const M: usize>(outcome: &Outcome) -> Scores<M> {
    let values = <[f64; M]>::try_from(outcome.objectives.as_slice());
    values.map_or(Scores::invalid(), |values| Scores::constrained(values, outcome.violation))
}

impl<A: MultiObjectiveAlgorithm<M, Genome = Reals>, const M: usize> Proposer for Evolution<A, M> {
    fn ask(&mut self) -> Result<Vec<Vec<f64>>, SearchError> {
        Ok(self.0.ask().iter().map(|genome| genome.to_vec()).collect())
    }

    fn tell(&mut self, outcomes: &[Outcome]) -> Result<(), SearchError> {
        Ok(self.0.tell(&outcomes.iter().map(scores).collect::<Vec<_>>())?)
    }
}
