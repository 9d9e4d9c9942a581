//! Methods of search: each asks for points of the unit cube, and is told their outcomes.

mod evolution;
mod hypervolume_gain;
mod proposer;
mod radial_basis;
mod random;
mod side_by_side;
mod surrogate_front;
mod surrogate_model;
mod surrogate_peak;

use super::method::{Method, SearchError, SearchSettings};
use super::problem::Problem;
use evolution::Evolutionary;
use proposer::Proposer;

/// The method of the settings at its beginning.
///
/// - `start`: of the problem, in the unit cube; its outcome is known, and to ask for it costs nothing
pub(super) fn proposer(
    problem: &Problem,
    start: Vec<f64>,
    settings: &SearchSettings,
) -> Result<Box<dyn Proposer>, SearchError> {
    let objectives = problem.objectives();
    match settings.method {
        Method::Random => Ok(Box::new(random::Random::new(start.len(), settings.seed))),
        Method::NelderMead => side_by_side::nelder_mead(start, settings),
        Method::CmaEs => side_by_side::cma_es(start, settings),
        Method::Nsga2 => evolution::evolution(Evolutionary::Nsga2, objectives, start, settings),
        Method::SmsEmoa => evolution::evolution(Evolutionary::SmsEmoa, objectives, start, settings),
        Method::Surrogate if objectives == 1 => surrogate_peak::surrogate_peak(start, settings),
        Method::Surrogate => surrogate_front::surrogate_front(objectives, start, settings),
    }
}
