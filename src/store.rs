//! The only place that writes files.

pub mod lock;
pub mod progress;
pub mod replace;
