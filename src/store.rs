//! What is on disk: the only place that writes files, and how much of one is read.

pub mod kept;
pub mod limits;
pub mod lock;
pub mod place;
pub mod progress;
pub mod replace;
pub mod stdin;
pub mod terminal;
pub mod text;
