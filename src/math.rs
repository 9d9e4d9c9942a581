//! Mathematics that knows nothing of gems: random streams, sampling warps, statistics, numbers as typed.

pub mod histogram;
pub mod plain;
pub mod points;
pub mod random;
pub mod sample;
pub mod statistic;
pub mod stats;
pub mod typed;
