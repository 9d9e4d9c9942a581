//! The methods of search by name, and the settings of a search.

use std::str::FromStr;

/// How points are chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Method {
    /// Independent points of the box: what any other method is measured against.
    Random,
    /// The simplex of Nelder and Mead.
    NelderMead,
    /// Covariance matrix adaptation.
    CmaEs,
    /// Non-dominated sorting.
    Nsga2,
    /// Selection by hypervolume.
    SmsEmoa,
    /// A model of what was evaluated, searched for what promises most.
    Surrogate,
}

/// All methods, in the order in which they are listed.
pub const METHODS: &[Method] =
    &[Method::Random, Method::NelderMead, Method::CmaEs, Method::Nsga2, Method::SmsEmoa, Method::Surrogate];

/// A name that no method has.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("'{0}' is not a method of search")]
pub struct NoSuchMethod(pub String);

impl Method {
    /// The method that was best when measured (`tools/bench_search.rs`), for one objective as for several.
    pub const BEST: Method = Method::Surrogate;

    /// As it is written on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Method::Random => "random",
            Method::NelderMead => "nelder-mead",
            Method::CmaEs => "cma-es",
            Method::Nsga2 => "nsga-ii",
            Method::SmsEmoa => "sms-emoa",
            Method::Surrogate => "surrogate",
        }
    }

    /// Whether it searches for so many objectives.
    pub fn takes(self, objectives: usize) -> bool {
        match self {
            Method::Random | Method::Surrogate => true,
            Method::NelderMead | Method::CmaEs => objectives == 1,
            Method::Nsga2 | Method::SmsEmoa => objectives > 1,
        }
    }
}

impl FromStr for Method {
    type Err = NoSuchMethod;

    fn from_str(name: &str) -> Result<Method, NoSuchMethod> {
        METHODS.iter().copied().find(|m| m.name() == name).ok_or_else(|| NoSuchMethod(name.into()))
    }
}

/// How a problem is searched.
#[derive(Debug, Clone, PartialEq)]
pub struct SearchSettings {
    /// How points are chosen.
    pub method: Method,
    /// The most points that are evaluated, candidate 0 included.
    pub evaluations: usize,
    /// How many improvements of a point run side by side: simplexes, CMA-ES. They begin at candidate 0 and at
    /// others spread over the box, or, after a search of a model, at its best points.
    pub starts: usize,
    /// Of the random numbers.
    pub seed: u64,
}

impl Default for SearchSettings {
    fn default() -> Self {
        Self { method: Method::BEST, evaluations: 400, starts: 1, seed: 1 }
    }
}

/// Why a problem is not searched.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SearchError {
    /// The method is one for another number of objectives.
    #[error("{} is not a method for {objectives} objectives", method.name())]
    Method {
        /// That was asked for.
        method: Method,
        /// Of the problem.
        objectives: usize,
    },
    /// What the crate of the method says.
    #[error("the search failed: {0}")]
    Failed(#[from] genoxide::Error),
}
