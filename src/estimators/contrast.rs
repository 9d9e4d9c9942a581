//! Contrast: two points of each cell of the face-up picture.

use super::batches::Estimator;
use super::entry_sampling::Silhouette;
use super::kind::{EstimatorKind, LIGHT, Method, Metric, MetricSource, Setup};
use super::pixel_cells::{self, AGS_OBSERVER_DEG, CellTracer, PixelCell, SampleGroups, SightLine};
use super::viewer_lighting::ObserverDome;
use super::{EstimatorError, TraceOptics, ViewFrame};
use crate::sampling::kronecker::KroneckerPoints;
use crate::sampling::random::{Purpose, Stream};
use crate::sampling::statistic::Statistic;
use crate::sampling::tally::{Column, Tally, columns};
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

// Sums of a batch.
columns! {
    /// Cells, drawn in proportion to their share of the outline.
    CELLS,
    /// Σ luminance, dome = 1.
    LUMINANCE,
    /// Σ square of a cell's mean luminance.
    SQUARE,
}

/// Standard deviation of the cells over their mean.
fn contrast(sums: &Tally) -> f64 {
    let mean = sums[LUMINANCE] / sums[CELLS];
    (sums[SQUARE] / sums[CELLS] / (mean * mean) - 1.0).max(0.0).sqrt()
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
    tally: &'a mut Tally,
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
        self.tally[CELLS] += 1.0;
        self.tally[LUMINANCE] += 0.5 * (a + b);
        self.tally[SQUARE] += a * b;
    }
}

impl Estimator for Contrast<'_> {
    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Tally) {
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

/// So many points of the hemisphere are as dear as a cell of two points.
const COST: u64 = 2;

/// Contrast as scores have it.
#[derive(Debug, Clone, Copy)]
pub struct ContrastKind;

impl EstimatorKind for ContrastKind {
    fn name(&self) -> &'static str {
        "contrast"
    }

    fn metrics(&self) -> &'static [Metric] {
        &METRICS
    }

    fn columns(&self) -> &'static [Column] {
        &COLUMNS
    }

    fn methods<'a>(&self, stone: &'a ConvexStone, setup: Setup<'a>, _: &[&Metric]) -> Vec<Method<'a>> {
        pixel_cells::methods("contrast", COST, setup, move |dome| {
            let estimator = Contrast::in_frame(stone, &setup.medium, setup.view_frame, dome)?;
            Ok(estimator.with_stop_power(setup.stop_power))
        })
    }
}

/// The metrics.
static METRICS: [Metric; 1] = [Metric {
    name: "contrast",
    about: "how much the face-up picture varies: standard deviation per mean of its cells",
    range: (0.0, 100.0),
    observer: Some(AGS_OBSERVER_DEG),
    definition: &[
        "Parallel face-up view traced backward over the whole outline;",
        LIGHT,
        "White dome above the horizon with a dark observer cone of 15° half-angle, or --observer; \
                reflection at entry included. The luminance is the mean over square cells of 1/100 of the \
                girdle's width (what of them lies in the outline; mean over all ways to lay the grid). \
                Standard deviation per mean of the cells, by their area in the outline.",
    ],
    source: "resolution: J. Sasián et al., Optical Engineering 46 (2007) 093604; observer: American Gem \
            Society; the figure is cutlab's",
    ..Metric::of(&ContrastKind, MetricSource::Sums(Statistic::Smooth(contrast)))
}];
