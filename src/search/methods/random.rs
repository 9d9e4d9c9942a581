//! Random search: independent points, uniform in the box.

use super::proposer::Proposer;
use crate::sampling::random::{Purpose, Stream};
use crate::search::method::SearchError;
use crate::search::problem::Outcome;

const STREAM: Purpose = Purpose::named("random search");

/// Points of a batch.
const BATCH: u64 = 64;

/// Random search.
pub struct Random {
    variables: usize,
    seed: u64,
    asked: u64,
}

impl Random {
    /// A search over so many variables.
    pub fn new(variables: usize, seed: u64) -> Random {
        Random { variables, seed, asked: 0 }
    }
}

/// The point number `index` of the random points of a seed.
pub fn point(variables: usize, seed: u64, index: u64) -> Vec<f64> {
    let mut stream = Stream::new(seed, STREAM, index);
    (0..variables).map(|_| stream.unit64()).collect()
}

impl Proposer for Random {
    fn ask(&mut self) -> Result<Vec<Vec<f64>>, SearchError> {
        let first = self.asked;
        self.asked += BATCH;
        Ok((first..self.asked).map(|index| point(self.variables, self.seed, index)).collect())
    }

    fn tell(&mut self, _outcomes: &[Outcome]) -> Result<(), SearchError> {
        Ok(())
    }
}
