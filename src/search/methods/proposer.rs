//! What a method of search does: it asks, and is told.

use crate::search::method::SearchError;
use crate::search::problem::Outcome;
use genoxide::genome::{Real, Reals};
use genoxide::{Fitness, StreamRng};

/// A method at work.
pub trait Proposer {
    /// The next points of the unit cube, which are evaluated together; none where the round needs none.
    fn ask(&mut self) -> Result<Vec<Vec<f64>>, SearchError>;

    /// The outcomes of the points of the last [`ask`](Self::ask), in their order.
    fn tell(&mut self, outcomes: &[Outcome]) -> Result<(), SearchError>;
}

/// The first objective of an outcome as `genoxide` compares it: by Deb's rules.
pub fn fitness(outcome: &Outcome) -> Fitness {
    let score = outcome.objectives.first();
    score.map_or(Fitness::invalid(), |&score| Fitness::constrained(score, outcome.violation))
}

/// The unit cube of so many variables.
pub fn unit_cube(variables: usize) -> Result<Real, SearchError> {
    Ok(Real::uniform(variables, 0.0..=1.0)?)
}

/// A point of the unit cube, and others spread over the cube, `count` in all and at least that one: a Latin
/// hypercube (M. McKay, R. Beckman and W. Conover, Technometrics 21 (1979) 239).
pub fn spread(first: Vec<f64>, count: usize, seed: u64) -> Result<Vec<Vec<f64>>, SearchError> {
    let cube = unit_cube(first.len())?;
    let mut points = vec![first];
    if count > 1 {
        let others = cube.latin_hypercube(count - 1, &mut StreamRng::seed_from_u64(seed))?;
        points.extend(others.into_iter().map(Reals::into_vec));
    }
    Ok(points)
}

/// The largest difference of two points in a coordinate.
pub fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
