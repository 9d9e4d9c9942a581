//! Contrast: two points of each cell of the face-up picture.

use super::batches::Estimator;
use super::entry_sampling::Silhouette;
use super::pixel_cells::{self, CellTracer, PixelCell, SampleGroups, SightLine};
use super::view::ObserverDome;
use super::{EstimatorError, TraceOptics, ViewFrame};
use crate::sampling::kronecker::KroneckerPoints;
use crate::sampling::random::{Purpose, Stream};
use crate::sampling::stats::Accumulate;
use crate::trace::ConvexStone;
use std::ops::Range;

/// Cells of the picture, one stream a batch and one a run of it.
const STREAM: Purpose = Purpose::named("contrast");

/// The picture of a stone under a white dome with a dark observer, in cells.
///
/// The product of the luminances of two independent points of a cell has the square of the cell's
/// mean as its expectation, so the variance of the cells comes out without the noise of the points.
#[derive(Debug, Clone)]
pub struct Contrast<'a> {
    seen: CellTracer<'a>,
    view_frame: ViewFrame,
    outline: Silhouette,
    side: f64,
}

/// Sums of a batch.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ContrastTally {
    /// Cells, drawn in proportion to their share of the outline.
    pub cells: f64,
    /// Σ luminance, dome = 1.
    pub luminance: f64,
    /// Σ square of a cell's mean luminance.
    pub square: f64,
}

impl ContrastTally {
    /// Standard deviation of the cells over their mean.
    pub fn contrast(&self) -> f64 {
        let mean = self.luminance / self.cells;
        (self.square / self.cells / (mean * mean) - 1.0).max(0.0).sqrt()
    }
}

impl Accumulate for ContrastTally {
    fn accumulate(&mut self, other: &ContrastTally) {
        self.cells += other.cells;
        self.luminance += other.luminance;
        self.square += other.square;
    }
}

impl<'a> Contrast<'a> {
    /// Looks at a stone.
    pub fn in_frame(
        stone: &'a ConvexStone,
        medium: &TraceOptics,
        view_frame: ViewFrame,
        sky: ObserverDome,
    ) -> Result<Self, EstimatorError> {
        Ok(Self {
            seen: CellTracer::new(stone, medium, sky)?,
            view_frame,
            outline: Silhouette::new(stone, view_frame)?,
            side: pixel_cells::side_for(stone),
        })
    }

    /// Gives rays up below `power` instead of [`super::STOP_POWER`].
    pub fn with_stop_power(mut self, power: f32) -> Self {
        self.seen.stop_power = power;
        self
    }
}

/// Pairs of points of a run of cells.
struct Pairs<'a> {
    estimator: &'a Contrast<'a>,
    points: KroneckerPoints<2>,
    stream: Stream,
    tally: &'a mut ContrastTally,
}

impl SampleGroups for Pairs<'_> {
    const POINT_GROUPS: usize = 1;

    fn next_group(&mut self, group: &mut Vec<SightLine>) -> bool {
        let Some(u) = self.points.next() else { return false };
        let Contrast { view_frame, outline, side, .. } = self.estimator;
        let at = outline.sample_point(u);
        let cell = PixelCell::around(at, *side, &mut self.stream);
        let other = cell.sample(&mut self.stream, |at| outline.contains(at));
        group.extend([at, other].map(|at| SightLine::new(view_frame, outline, at)));
        true
    }

    fn accept(&mut self, luminances: &[f32]) {
        let [a, b] = luminances else { return };
        let (a, b) = (f64::from(*a), f64::from(*b));
        self.tally.cells += 1.0;
        self.tally.luminance += 0.5 * (a + b);
        self.tally.square += a * b;
    }
}

impl Estimator for Contrast<'_> {
    type Tally = ContrastTally;

    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut ContrastTally) {
        let start = points.start;
        let mut pairs = Pairs {
            estimator: self,
            stream: pixel_cells::stream(seed, STREAM, batch, start),
            points: KroneckerPoints::new(seed, STREAM, batch, points),
            tally,
        };
        self.seen.trace(&mut pairs, seed, batch, start);
    }
}
