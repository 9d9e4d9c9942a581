//! The request of an optimisation, as data.

use super::guards::Guards;
use super::variable::Variable;
use crate::design::edit::Keep;
use crate::parse::format_number;
use crate::scoring::constraint::Constraint;
use crate::scoring::effort::Effort;
use crate::scoring::objective::{Objective, OverTilts};
use crate::search::Method;
use serde::{Deserialize, Serialize};

/// Of a front so many designs are kept, if nobody says how many.
const OF_A_FRONT: usize = 8;

/// What of a design may vary, what it is to be made better in, what it must keep, and how long to search.
///
/// ```
/// use cutlab::advanced::scoring::Objective;
/// use cutlab::{OptimiseRequest, Stone};
///
/// let stone = Stone::parse("classic:ri=1.54")?;
/// let request = OptimiseRequest::new([Objective::maximise("iso".parse()?)]).evaluations(30);
/// let found = request.run(&stone, &())?;
/// assert!(found.finalists[0].gains[0].gain.value > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[non_exhaustive]
pub struct OptimiseRequest {
    /// What varies; none for the two tangent ratios.
    pub vary: Vec<Variable>,
    /// What is made better: one, or several, between which a front is found.
    pub objectives: Vec<Objective>,
    /// Bounds that a design must keep; the start keeps them.
    pub constraints: Vec<Constraint>,
    /// Bounds that are always on.
    pub guards: Guards,
    /// What a change leaves as it is.
    pub keep: Keep,
    /// How finely candidates are scored.
    pub effort: Effort,
    /// By how many degrees the angle of a tier may be off when the stone is cut: an objective is then that of the
    /// stones that [`crate::advanced::design::cutting_error::stones`] makes, the mean, or the worst for an objective
    /// of the worst tilt. 0 for stones cut as they are drawn.
    pub tolerance_deg: f64,
    /// How points are chosen; none for the method that was best when measured.
    #[serde(with = "method_by_name")]
    pub method: Option<Method>,
    /// The most designs that are scored, the start among them.
    pub evaluations: usize,
    /// How many improvements run side by side.
    pub starts: usize,
    /// Of the random numbers of the search.
    pub seed: u64,
    /// How many distinct designs are kept at most; none keeps one, or of a front up to eight.
    pub keep_best: Option<usize>,
}

/// A method as its name.
mod method_by_name {
    use crate::search::Method;
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(method: &Option<Method>, to: S) -> Result<S::Ok, S::Error> {
        method.map(Method::name).serialize(to)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Method>, D::Error> {
        let name: Option<String> = Option::deserialize(from)?;
        name.map(|name| name.parse().map_err(D::Error::custom)).transpose()
    }
}

impl Default for OptimiseRequest {
    fn default() -> OptimiseRequest {
        OptimiseRequest {
            vary: Vec::new(),
            objectives: Vec::new(),
            constraints: Vec::new(),
            guards: Guards::default(),
            keep: Keep::default(),
            effort: Effort::default(),
            tolerance_deg: 0.0,
            method: None,
            evaluations: 200,
            starts: 1,
            seed: 1,
            keep_best: None,
        }
    }
}

impl OptimiseRequest {
    /// A request with these objectives, of the two tangent ratios.
    pub fn new(objectives: impl IntoIterator<Item = Objective>) -> OptimiseRequest {
        OptimiseRequest { objectives: objectives.into_iter().collect(), ..OptimiseRequest::default() }
    }

    /// With these variables.
    pub fn vary(mut self, variables: impl IntoIterator<Item = Variable>) -> OptimiseRequest {
        self.vary = variables.into_iter().collect();
        self
    }

    /// With the error in degrees that the angle of a tier may have when the stone is cut.
    pub fn tolerance(mut self, degrees: f64) -> OptimiseRequest {
        self.tolerance_deg = degrees;
        self
    }

    /// What the search made better, as tables call it: `iso within ± 0.2°`, without a tolerance `iso`.
    pub fn searched_name(&self, of: &Objective) -> String {
        let worst = if of.of.tilts.over == OverTilts::Worst { "worst " } else { "" };
        match self.tolerance_deg > 0.0 {
            true => format!("{} {worst}within ± {}°", of.name(), format_number(self.tolerance_deg)),
            false => of.name(),
        }
    }

    /// With one more bound.
    pub fn constraint(mut self, constraint: Constraint) -> OptimiseRequest {
        self.constraints.push(constraint);
        self
    }

    /// With so many designs scored at most.
    pub fn evaluations(mut self, evaluations: usize) -> OptimiseRequest {
        self.evaluations = evaluations;
        self
    }

    /// With so many improvements side by side.
    pub fn starts(mut self, starts: usize) -> OptimiseRequest {
        self.starts = starts;
        self
    }

    /// With a seed of the search.
    pub fn seed(mut self, seed: u64) -> OptimiseRequest {
        self.seed = seed;
        self
    }

    /// How many designs are kept at most.
    pub fn most_kept(&self) -> usize {
        let usual = if self.objectives.len() > 1 { OF_A_FRONT } else { 1 };
        self.keep_best.unwrap_or(usual)
    }

    /// With so many distinct designs kept at most.
    pub fn keep_best(mut self, count: usize) -> OptimiseRequest {
        self.keep_best = Some(count);
        self
    }
}
