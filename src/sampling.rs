//! Sampling: random streams, quasi-random sequences, warps, discrete distributions, statistics with their errors.

pub mod discrete_cdf;
pub mod histogram;
pub mod kronecker;
pub mod random;
pub mod statistic;
pub mod stats;
pub mod tally;
pub mod warps;
