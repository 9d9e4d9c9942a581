//! Optimising a design: variables of a design, objectives and bounds of its stone, and the search between
//! them.

mod guards;
mod variable;

pub use guards::{GuardedStone, Guards};
pub use variable::{Degree, Variable, VariableError, resolved, usual};
