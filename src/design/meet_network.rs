//! The meet network of a design: which facets pass through which corners, recovered from the planes
//! alone, and solved again when angles change, so that what met still meets.
//!
//! The unknowns are one distance a part of the design (facets of one angle and distance, which move as
//! one), and angles where they have to follow. A corner in which more than three facets meet gives one
//! equation for each facet beyond three. What these leave open is decided in this order: angles stay, the
//! girdle stays where it is, the table keeps its size, and every other facet stays at its corner nearest
//! the girdle. Checked in `tests/library/meet_network.rs`.

mod change;
mod check;
mod corners;
mod equations;
mod error;
mod holds;
mod least_squares;
mod network;
mod parts;
mod scaling;
mod solver;
mod state;

pub use change::{Change, Solved};
pub use corners::Corner;
pub use error::NetworkError;
pub use network::MeetNetwork;
pub use parts::Part;
