//! Optimising a design: variables of a design, objectives and bounds of its stone, and the search between
//! them.

mod candidates;
mod guards;
mod request;
mod run;
mod variable;

pub use candidates::Candidates;
pub use guards::{GuardedStone, Guards};
pub use request::OptimiseRequest;
pub use run::{Finalist, MOST_TOLERANCE_DEG, Optimisation, OptimiseError, Optimised};
pub use variable::{Degree, Variable, VariableError, resolved, usual};
