//! The only place that writes files.

pub mod progress;
pub mod replace;
