//! Contrast: two points of each cell of the face-up picture.

use super::batches::Experiment;
use super::cells::{self, Cell, Groups, Seen, Sight};
use super::entrance::Outline;
use super::view::Sky;
use super::{Aspect, ExperimentError, Medium};
use crate::math::points::Points;
use crate::math::random::{Purpose, Stream};
use crate::math::stats::Sum;
use crate::walk::Stone;
use std::ops::Range;

/// The picture of a stone under a white dome with a dark observer, in cells.
///
/// The product of the luminances of two independent points of a cell has the square of the cell's
/// mean as its expectation, so the variance of the cells comes out without the noise of the points.
#[derive(Debug, Clone)]
pub struct Contrast<'a> {
    seen: Seen<'a>,
    aspect: Aspect,
    outline: Outline,
    side: f64,
}

/// Sums of a batch.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tally {
    /// Cells, drawn in proportion to their share of the outline.
    pub cells: f64,
    /// Σ luminance, dome = 1.
    pub luminance: f64,
    /// Σ square of a cell's mean luminance.
    pub square: f64,
}

impl Tally {
    /// Standard deviation of the cells over their mean.
    pub fn contrast(&self) -> f64 {
        let mean = self.luminance / self.cells;
        (self.square / self.cells / (mean * mean) - 1.0).max(0.0).sqrt()
    }
}

impl Sum for Tally {
    fn add(&mut self, other: &Tally) {
        self.cells += other.cells;
        self.luminance += other.luminance;
        self.square += other.square;
    }
}

impl<'a> Contrast<'a> {
    /// Looks at a stone.
    pub fn seen_from(
        stone: &'a Stone,
        medium: &Medium,
        aspect: Aspect,
        sky: Sky,
    ) -> Result<Self, ExperimentError> {
        Ok(Self {
            seen: Seen::new(stone, medium, sky)?,
            aspect,
            outline: Outline::new(stone, aspect)?,
            side: cells::side_for(stone),
        })
    }

    /// Gives rays up below `power` instead of [`super::STOP_POWER`].
    pub fn followed_to(mut self, power: f32) -> Self {
        self.seen.stop_power = power;
        self
    }
}

/// Pairs of points of a run of cells.
struct Pairs<'a> {
    experiment: &'a Contrast<'a>,
    points: Points<2>,
    stream: Stream,
    tally: &'a mut Tally,
}

impl Groups for Pairs<'_> {
    const OF_A_POINT: usize = 1;

    fn next(&mut self, group: &mut Vec<Sight>) -> bool {
        let Some(u) = self.points.next() else { return false };
        let Contrast { aspect, outline, side, .. } = self.experiment;
        let at = outline.place(u);
        let cell = Cell::around(at, *side, &mut self.stream);
        let other = cell.another(&mut self.stream, |at| outline.holds(at));
        group.extend([at, other].map(|at| Sight::new(aspect, outline, at)));
        true
    }

    fn take(&mut self, luminances: &[f32]) {
        let [a, b] = luminances else { return };
        let (a, b) = (f64::from(*a), f64::from(*b));
        self.tally.cells += 1.0;
        self.tally.luminance += 0.5 * (a + b);
        self.tally.square += a * b;
    }
}

impl Experiment for Contrast<'_> {
    type Tally = Tally;

    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Tally) {
        let hues = cells::stream(seed, Purpose::ScoreHue, batch, points.start);
        let mut pairs = Pairs {
            experiment: self,
            stream: cells::stream(seed, Purpose::Contrast, batch, points.start),
            points: Points::new(seed, Purpose::Contrast, batch, points),
            tally,
        };
        self.seen.walk(&mut pairs, hues);
    }
}
