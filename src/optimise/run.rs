//! The run of an optimisation: the search, and what its finalists are worth by fresh random numbers.

use super::candidates::Candidates;
use super::guards::GuardedStone;
use super::request::OptimiseRequest;
use super::variable::{self, Degree};
use crate::design::edit::{EditError, Edited, Editor};
use crate::geometry::{Polyhedron, SolidError};
use crate::progress::Progress;
use crate::scoring::evaluator::Evaluator;
use crate::scoring::gain::Gain;
use crate::scoring::objective::ObjectiveError;
use crate::search::front;
use crate::search::{Candidate, Method, Problem, ProblemError, Replay, SearchError, SearchSettings, search};
use crate::stone::{Stone, StoneError};

/// Designs nearer to each other than this, in the unit cube of the variables, are not distinct.
const DISTINCT: f64 = 0.05;

/// The greatest error of an angle, in degrees, that a stone can be optimised for.
pub const MOST_TOLERANCE_DEG: f64 = 5.0;

/// Why there is nothing optimised.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OptimiseError {
    /// A mesh that is no convex stone.
    #[error(transparent)]
    Stone(#[from] StoneError),
    /// A tier or a parameter that the design does not have, or meets that cannot be recovered.
    #[error(transparent)]
    Edit(#[from] EditError),
    /// An objective or a bound that is none, or that the stone does not have.
    #[error(transparent)]
    Objective(#[from] ObjectiveError),
    /// Nothing to vary, too many objectives, a range that is none.
    #[error(transparent)]
    Problem(#[from] ProblemError),
    /// A method that does not fit.
    #[error(transparent)]
    Search(#[from] SearchError),
    /// A tolerance that is none.
    #[error("the error of an angle is from 0° to {MOST_TOLERANCE_DEG}°, not {0}°")]
    Tolerance(f64),
    /// Planes that bound no stone.
    #[error(transparent)]
    Solid(#[from] SolidError),
    /// A bound that the design breaks as it is.
    #[error("the design as it is breaks a bound: {0}; optimise from one that keeps it, or set another bound")]
    Broken(String),
}

/// A design that the search ends with.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Finalist {
    /// Its number among the candidates.
    pub candidate: usize,
    /// The value of each variable.
    pub values: Vec<f64>,
    /// The design, its solid, and what followed.
    pub edited: Edited,
    /// What it gains over the start in each objective, by fresh random numbers, if both are cut as they are drawn.
    pub gains: Vec<Gain>,
    /// What it gains if both are cut within the tolerance; none without one.
    pub tolerant_gains: Option<Vec<Gain>>,
}

impl Finalist {
    /// What it gains in what the search made better: within the tolerance if there is one.
    pub fn searched_gains(&self) -> &[Gain] {
        self.tolerant_gains.as_ref().unwrap_or(&self.gains)
    }
}

/// What an optimisation has found.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Optimised {
    /// What varied.
    pub degrees: Vec<Degree>,
    /// Every design that was scored, in the order of scoring; the first is the start.
    pub candidates: Vec<Candidate>,
    /// Those that none is better than in everything, numbers in `candidates`: of one objective the best.
    pub front: Vec<usize>,
    /// The designs that are kept: of one objective the best first; of several along the first.
    pub finalists: Vec<Finalist>,
    /// Whether it was ended before its time.
    pub is_cancelled: bool,
}

/// An optimisation made ready to run: everything that can be wrong with it is known.
pub struct Optimisation<'r> {
    request: &'r OptimiseRequest,
    /// The design with its meets.
    pub editor: Editor,
    /// What varies.
    pub degrees: Vec<Degree>,
    problem: Problem,
    evaluator: Evaluator,
    guards: GuardedStone,
}

impl OptimiseRequest {
    /// Optimises a stone. A stone whose colour depends on a size that nobody says is taken as wide as stones
    /// usually are.
    pub fn run(&self, stone: &Stone, progress: &dyn Progress) -> Result<Optimised, OptimiseError> {
        self.prepared(stone)?.run(Vec::new(), &|_| (), progress)
    }

    /// Made ready to run for a stone.
    ///
    /// Errors: tiers, parameters, metrics that the stone does not have; a bound that it breaks as it is.
    pub fn prepared(&self, stone: &Stone) -> Result<Optimisation<'_>, OptimiseError> {
        if self.objectives.is_empty() {
            return Err(ObjectiveError::Nothing.into());
        }
        let (method, objectives) = (self.method.unwrap_or(Method::BEST), self.objectives.len());
        if !method.takes(objectives) {
            return Err(SearchError::Method { method, objectives }.into());
        }
        if !(0.0..=MOST_TOLERANCE_DEG).contains(&self.tolerance_deg) {
            return Err(OptimiseError::Tolerance(self.tolerance_deg));
        }
        let editor = Editor::new(stone.convex_design()?)?;
        let usual;
        let vary = match &self.vary[..] {
            [] => {
                usual = variable::usual();
                &usual[..]
            }
            vary => vary,
        };
        let degrees = variable::resolved(vary, &editor)?;
        let ranges = degrees.iter().map(|d| d.range.clone()).collect();
        let start = degrees.iter().map(|d| d.start).collect();
        let problem = Problem::new(ranges, start, self.objectives.len())?;
        let (objectives, constraints) = (self.objectives.clone(), self.constraints.clone());
        let evaluator =
            Evaluator::new(objectives, constraints, stone.material(), self.effort, &editor.solid)?;
        if let Some(broken) = evaluator.broken_by_start().first() {
            return Err(OptimiseError::Broken(broken.to_string()));
        }
        let guards = GuardedStone::new(self.guards, &editor.solid);
        Ok(Optimisation { request: self, editor, degrees, problem, evaluator, guards })
    }
}

impl Optimisation<'_> {
    /// Searches, and scores the finalists again.
    ///
    /// - `known`: candidates of an earlier run that was interrupted
    /// - `found`: is told new candidates as they come, in their order
    pub fn run(
        &self,
        known: Vec<Candidate>,
        found: &dyn Fn(&[Candidate]),
        progress: &dyn Progress,
    ) -> Result<Optimised, OptimiseError> {
        let request = self.request;
        let settings = SearchSettings {
            method: request.method.unwrap_or(Method::BEST),
            evaluations: request.evaluations,
            starts: request.starts,
            seed: request.seed,
        };
        let candidates = self.candidates(progress);
        let replay = Replay::new(known, &candidates, found);
        let result = search(&self.problem, &settings, &replay, progress)?;
        let front = result.front();
        let most = request.most_kept();
        let chosen = match request.objectives.len() {
            _ if front.is_empty() => Vec::new(),
            1 => front::best_distinct(&self.problem, &result.candidates, most, DISTINCT),
            _ => spread(&front, most),
        };
        let edited: Vec<Edited> = chosen
            .iter()
            .map(|c| candidates.edited(&result.candidates[*c].values))
            .collect::<Result<_, _>>()?;
        let solids: Vec<Polyhedron> = edited.iter().map(|e| e.solid.clone()).collect();
        let gains = self.evaluator.gains(&self.editor.solid, &solids)?;
        let tolerant = self.tolerant_gains(&candidates, &edited)?;
        let finalists = chosen.iter().zip(edited).zip(gains).enumerate();
        let finalist = |(i, ((candidate, edited), gains)): (usize, ((&usize, Edited), Vec<Gain>))| Finalist {
            candidate: *candidate,
            values: result.candidates[*candidate].values.clone(),
            edited,
            gains,
            tolerant_gains: tolerant.as_ref().map(|gains| gains[i].clone()),
        };
        let mut finalists: Vec<Finalist> = finalists.map(finalist).collect();
        if request.objectives.len() == 1 {
            // the fresh numbers decide which is best
            let gained = |f: &Finalist| f.searched_gains()[0].gain.value;
            finalists.sort_by(|a, b| gained(b).total_cmp(&gained(a)));
        }
        Ok(Optimised {
            finalists,
            front,
            is_cancelled: result.is_cancelled,
            candidates: result.candidates,
            degrees: self.degrees.clone(),
        })
    }

    /// What designs gain over the start if all are cut within the tolerance; none without one.
    fn tolerant_gains(
        &self,
        candidates: &Candidates,
        finalists: &[Edited],
    ) -> Result<Option<Vec<Vec<Gain>>>, OptimiseError> {
        let Some(start) = candidates.stones(&self.editor.unchanged())? else { return Ok(None) };
        let each: Option<Vec<Vec<Polyhedron>>> =
            finalists.iter().map(|edited| candidates.stones(edited)).collect::<Result<_, _>>()?;
        Ok(Some(self.evaluator.gains_over(&start, &each.unwrap_or_default())?))
    }

    /// The candidates of the search.
    pub fn candidates<'a>(&'a self, progress: &'a dyn Progress) -> Candidates<'a> {
        Candidates {
            editor: &self.editor,
            degrees: &self.degrees,
            keep: self.request.keep,
            guards: &self.guards,
            evaluator: &self.evaluator,
            tolerance_deg: self.request.tolerance_deg,
            progress,
        }
    }
}

/// So many of the front's candidates, evenly along it, its ends among them.
fn spread(front: &[usize], count: usize) -> Vec<usize> {
    let last = front.len() - 1;
    let count = count.clamp(1, front.len());
    let at = |i: usize| front[if count == 1 { 0 } else { (i * last + (count - 1) / 2) / (count - 1) }];
    (0..count).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn some_of_a_front_are_its_ends_and_what_lies_between() {
        let front: Vec<usize> = (10..21).collect();
        assert_eq!(spread(&front, 3), [10, 15, 20]);
        assert_eq!(spread(&front, 1), [10]);
        assert_eq!(spread(&front, 50), front);
        assert_eq!(spread(&front[..2], 2), [10, 11]);
    }
}
