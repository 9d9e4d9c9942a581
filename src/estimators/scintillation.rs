//! Scintillation: cells of the picture while the stone is rocked.

use super::batches::Estimator;
use super::entry_sampling::Silhouette;
use super::kind::{EstimatorKind, LIGHT, Method, Metric, MetricSource, Setup};
use super::pixel_cells::{self, AGS_OBSERVER_DEG, CellTracer, PixelCell, SampleGroups, SightLine};
use super::viewer_lighting::ObserverDome;
use super::{EstimatorError, TraceOptics, ViewFrame};
use crate::design::Zone;
use crate::geometry::Polyhedron;
use crate::geometry::measure::centroid;
use crate::sampling::kronecker::KroneckerPoints;
use crate::sampling::random::{Purpose, Stream};
use crate::sampling::statistic::Statistic;
use crate::sampling::tally::{Column, Tally, columns};
use crate::trace::ConvexStone;
use glam::{DVec2, DVec3};
use std::ops::Range;

/// Cells of the rocked picture, one stream a batch and one a run of it.
const STREAM: Purpose = Purpose::named("scintillation");

/// Tilts to each side, in steps of a degree, about the picture's right and top.
const REACH: i32 = 15;

/// Steps from one tilt to the next, both axes together.
const STEPS: usize = 4 * REACH as usize;

/// The most points of a cell, as a power of two. What the last doubling takes off is summed up in
/// [`LAST`], and is about what is left to take off: checked in `tests/library/faceter_view.rs`.
const FINEST: u32 = 10;

/// A cell has 2^k points or more with probability 2^(−k · this).
const RARER: f64 = 1.25;

/// The picture of a stone under a white dome with a dark observer, in cells, before and after steps
/// of a degree.
///
/// The mean change of a cell is wanted, and the change of a mean of n points is larger by their
/// noise. So each cell has a random number of points 2^k: what doubling the points takes off the
/// change is added up with the inverse of the probability that a cell has so many, and the sum has
/// the change at 2^`FINEST` points as its expectation (C. Rhee and P. Glynn, *Operations Research*
/// 63 (2015) 1026).
#[derive(Debug, Clone)]
pub struct Scintillation<'a> {
    seen: CellTracer<'a>,
    steps: Vec<Step>,
    side: f64,
}

/// A step of a degree.
#[derive(Debug, Clone)]
struct Step {
    before: (ViewFrame, Silhouette),
    after: (ViewFrame, Silhouette),
    /// From where a place of the picture lies before to where it lies after: the pivot stays where it
    /// is in the picture.
    shift: DVec2,
}

/// The point about which a stone is rocked, in the design's frame: the middle (by area) of its table,
/// on which an eye rests. Without a table it is the middle of the face-up outline, halfway up the
/// points of the stone that lie on it.
pub fn pivot(solid: &Polyhedron) -> DVec3 {
    let is_table =
        |face: &usize| Zone::from_normal(solid.area_vector(*face).normalize_or_zero()) == Zone::Table;
    let table = (0..solid.faces.len()).filter(is_table);
    let corners: Option<Vec<DVec3>> = table
        .max_by(|a, b| solid.area(*a).total_cmp(&solid.area(*b)))
        .map(|face| solid.polygon(face).collect());
    if let Some(corners) = corners {
        let flat: Vec<DVec2> = corners.iter().map(|c| c.truncate()).collect();
        let height = corners.iter().map(|c| c.z).sum::<f64>() / corners.len() as f64;
        return centroid(&flat).extend(height);
    }
    let outline = solid.outline();
    let near = 1e-9 * solid.width();
    let on_it = solid.vertices.iter().filter(|v| outline.iter().any(|o| o.distance(v.truncate()) <= near));
    let (least, most) = on_it.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, m), v| (l.min(v.z), m.max(v.z)));
    centroid(&outline).extend(0.5 * (least + most))
}

// Sums of a batch.
columns! {
    /// Cells, drawn in proportion to their share of the outline.
    CELLS,
    /// Σ luminance, dome = 1.
    LUMINANCE,
    /// Σ |change of a cell's luminance| in one step.
    CHANGE,
    /// The part of it that the doubling to the most points has added (negative).
    LAST,
}

impl<'a> Scintillation<'a> {
    /// Rocks a stone about its [`pivot`], from a view frame.
    pub fn in_frame(
        stone: &'a ConvexStone,
        medium: &TraceOptics,
        view_frame: ViewFrame,
        sky: ObserverDome,
    ) -> Result<Self, EstimatorError> {
        Self::with_pivot(stone, medium, view_frame, sky, pivot(&stone.solid))
    }

    /// Rocks a stone about another point.
    ///
    /// - `pivot`: design's frame
    ///
    /// Checked in `tests/library/scintillation.rs` against figures for two other pivots.
    pub fn with_pivot(
        stone: &'a ConvexStone,
        medium: &TraceOptics,
        view_frame: ViewFrame,
        sky: ObserverDome,
        pivot: DVec3,
    ) -> Result<Self, EstimatorError> {
        let pivot = stone.point_from_design(pivot);
        let seen = |axle, degrees: i32| {
            let view_frame = view_frame.turned(degrees.into(), axle);
            Ok((view_frame, Silhouette::new(stone, view_frame)?))
        };
        let mut steps = Vec::with_capacity(STEPS);
        for axle in [view_frame.right, view_frame.top] {
            for degrees in -REACH..REACH {
                let (before, after) = (seen(axle, degrees)?, seen(axle, degrees + 1)?);
                let shift = after.0.project(pivot) - before.0.project(pivot);
                steps.push(Step { before, after, shift });
            }
        }
        Ok(Self { seen: CellTracer::new(stone, medium, sky)?, steps, side: pixel_cells::side_for(stone) })
    }

    /// Gives rays up below `power` instead of [`super::STOP_POWER`].
    pub fn with_stop_power(mut self, power: f32) -> Self {
        self.seen.stop_power = power;
        self
    }
}

/// Cells of a run.
struct Changes<'a> {
    estimator: &'a Scintillation<'a>,
    points: KroneckerPoints<3>,
    stream: Stream,
    tally: &'a mut Tally,
    /// Changes of points, then of ever larger parts of a cell.
    changes: Vec<f64>,
}

impl SampleGroups for Changes<'_> {
    const POINT_GROUPS: usize = 2;

    fn next_group(&mut self, group: &mut Vec<SightLine>) -> bool {
        let Scintillation { steps, side, .. } = self.estimator;
        for [u, v, w] in &mut self.points {
            let Step { before, after, shift } = &steps[((w * STEPS as f64) as usize).min(STEPS - 1)];
            let at = before.1.sample_point([u, v]);
            if !after.1.contains(at + *shift) {
                continue;
            }
            let cell = PixelCell::around(at, *side, &mut self.stream);
            let level = level(&mut self.stream);
            for point in 0..1 << level {
                let inside = |at| before.1.contains(at) && after.1.contains(at + *shift);
                let at = if point == 0 { at } else { cell.sample(&mut self.stream, inside) };
                group.push(SightLine::new(&before.0, &before.1, at));
                group.push(SightLine::new(&after.0, &after.1, at + *shift));
            }
            return true;
        }
        false
    }

    fn accept(&mut self, luminances: &[f32]) {
        self.changes.clear();
        self.changes.extend(luminances.chunks_exact(2).map(|pair| f64::from(pair[1]) - f64::from(pair[0])));
        let sum: f64 = luminances.iter().map(|l| f64::from(*l)).sum();
        self.tally[CELLS] += 1.0;
        self.tally[LUMINANCE] += sum / luminances.len() as f64;
        let (change, last) = unbiased(&mut self.changes);
        self.tally[CHANGE] += change;
        self.tally[LAST] += if luminances.len() == 2 << FINEST { last } else { 0.0 };
    }
}

/// The exponent k of a cell's 2^k points.
fn level(stream: &mut Stream) -> u32 {
    ((-stream.unit64().log2() / RARER) as u32).min(FINEST)
}

/// What the changes of 2^k points of a cell add to the mean |change| of cells, and the last doubling's part
/// of it.
fn unbiased(changes: &mut Vec<f64>) -> (f64, f64) {
    let mean_size = |changes: &[f64]| changes.iter().map(|c| c.abs()).sum::<f64>() / changes.len() as f64;
    let mut coarse = mean_size(changes);
    let (mut sum, mut weight, mut last) = (coarse, 1.0, 0.0);
    while changes.len() > 1 {
        let half = changes.len() / 2;
        for i in 0..half {
            changes[i] = 0.5 * (changes[2 * i] + changes[2 * i + 1]);
        }
        changes.truncate(half);
        weight *= RARER.exp2();
        let fine = mean_size(changes);
        last = weight * (fine - coarse);
        sum += last;
        coarse = fine;
    }
    (sum, last)
}

impl Estimator for Scintillation<'_> {
    fn trace(&self, seed: u64, batch: u64, points: Range<u64>, tally: &mut Tally) {
        let start = points.start;
        let mut changes = Changes {
            estimator: self,
            stream: pixel_cells::stream(seed, STREAM, batch, start),
            points: KroneckerPoints::new(seed, STREAM, batch, points),
            tally,
            changes: Vec::new(),
        };
        self.seen.trace(&mut changes, seed, batch, start);
    }
}

/// So many points of the hemisphere are as dear as a cell of one to a thousand points, three on average, seen
/// twice.
const COST: u64 = 6;

/// Scintillation as scores have it.
#[derive(Debug, Clone, Copy)]
pub struct ScintillationKind;

impl EstimatorKind for ScintillationKind {
    fn name(&self) -> &'static str {
        "scintillation"
    }

    fn metrics(&self) -> &'static [Metric] {
        &METRICS
    }

    fn columns(&self) -> &'static [Column] {
        &COLUMNS
    }

    fn methods<'a>(&self, stone: &'a ConvexStone, setup: Setup<'a>, _: &[&Metric]) -> Vec<Method<'a>> {
        pixel_cells::methods("scintillation", COST, setup, move |dome| {
            let estimator = Scintillation::in_frame(stone, &setup.medium, setup.view_frame, dome)?;
            Ok(estimator.with_stop_power(setup.stop_power))
        })
    }
}

/// The metrics.
static METRICS: [Metric; 1] = [Metric {
    name: "scintillation",
    about: "how much the picture changes for each degree that the stone is rocked",
    unit: "1/°",
    range: (0.0, 2.0),
    observer: Some(AGS_OBSERVER_DEG),
    definition: &[
        "Parallel view traced backward over the whole outline;",
        LIGHT,
        "White dome above the horizon with a dark observer cone of 15° half-angle, or --observer; \
                reflection at entry included. The luminance is the mean over square cells of 1/100 of the \
                girdle's width (what of them lies in the outline; mean over all ways to lay the grid). The \
                stone is rocked over ±15° in steps of 1° about the picture's right and about its top \
                (azimuths 0 and 90°); the pivot is the middle of the table, which stays in its place in the \
                picture, or without a table the middle of the outline at half the girdle's height. The dome \
                stays with the viewer. Mean |change of a cell's luminance| in a step, per mean luminance, by \
                the cells' area in the outline.",
    ],
    source: "resolution: J. Sasián et al., Optical Engineering 46 (2007) 093604; observer: American Gem \
            Society; the figure is cutlab's",
    ..Metric::of(&ScintillationKind, MetricSource::Sums(Statistic::Smooth(|t| t[CHANGE] / t[LUMINANCE])))
}];

#[cfg(test)]
mod tests {
    use super::*;

    /// Changes of a cell's points are 1 with probability .6 and −1 otherwise: the mean size of the mean
    /// of many is .2 (by the binomial law), that of one is 1.
    #[test]
    fn what_few_points_add_has_the_change_of_many_as_its_mean() {
        let n = 1 << FINEST;
        let mut law = vec![1.0];
        for _ in 0..n {
            let mut next = vec![0.0; law.len() + 1];
            for (i, p) in law.iter().enumerate() {
                next[i] += 0.4 * p;
                next[i + 1] += 0.6 * p;
            }
            law = next;
        }
        let of = |(i, p): (usize, &f64)| p * (2.0 * i as f64 / f64::from(n) - 1.0).abs();
        let expected: f64 = law.iter().enumerate().map(of).sum();
        let mut stream = Stream::new(1, Purpose::TEST, 3);
        let (runs, mut sum, mut squares) = (400_000, 0.0, 0.0);
        for _ in 0..runs {
            let level = level(&mut stream);
            let change = |s: &mut Stream| if s.unit64() < 0.6 { 1.0 } else { -1.0 };
            let mut changes: Vec<f64> = (0..1 << level).map(|_| change(&mut stream)).collect();
            let (x, _) = unbiased(&mut changes);
            sum += x;
            squares += x * x;
        }
        let mean = sum / f64::from(runs);
        let error = ((squares / f64::from(runs) - mean * mean) / f64::from(runs)).sqrt();
        assert!((mean - expected).abs() < 4.0 * error, "{mean} ± {error}, expected {expected}");
        assert!(error < 0.005, "{error}");
    }
}
