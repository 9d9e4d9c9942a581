//! Search: the best points of a box for one objective, or the front of several, within a budget of
//! evaluations.
//!
//! The search knows nothing of stones. A [`Problem`] has variables with a range each, and objectives, all to be
//! maximised; an [`Evaluate`] gives the [`Outcome`] of points, a batch at a time; a [`Method`] chooses the next
//! batch from the outcomes so far. The same problem, settings and seed ask for the same candidates in the same
//! order, on any number of threads and after any interruption ([`Replay`]).
//!
//! The methods are those of the crate `genoxide` (ask and tell: it never calls back), and one on top of its
//! Gaussian processes.

pub mod front;
mod method;
mod methods;
mod problem;
mod replay;
mod run;

pub use method::{METHODS, Method, NoSuchMethod, SearchError, SearchSettings};
pub use problem::{Candidate, Evaluate, MOST_OBJECTIVES, Outcome, Problem, ProblemError};
pub use replay::Replay;
pub use run::{SearchResult, search};
