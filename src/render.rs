//! Pictures: camera rays, passes, tone.

pub mod film;
pub mod tone;
pub mod tracer;

pub use film::{Film, Pass};
pub use tracer::{Maps, Settings, render};
