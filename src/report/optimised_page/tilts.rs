//! Tilt curves of a page of an optimisation: the metrics of its objectives, and iso, before and after.

use super::headline;
use super::kept::KeptDesign;
use crate::geometry::Polyhedron;
use crate::materials::Material;
use crate::metrics::{Metric, MetricSource};
use crate::optimise::OptimiseRequest;
use crate::parallel;
use crate::report::plot::PlotCurve;
use crate::report::tilt_curves::{self, TiltPlot};
use crate::sampling::stats::Estimate;
use crate::scoring::evaluator::Evaluator;
use crate::scoring::objective::{Objective, TiltedMetric, Tilts};

/// Of more designs than these some are drawn, the first and the last among them.
const MOST_LINES: usize = 3;

/// Points of each estimator at each tilt: ±.0009 of `wlr`.
const SAMPLES: u64 = 1 << 15;

/// What is drawn: the objectives' metrics, and iso, each once for an observer. The weight does not change with a
/// tilt.
fn metrics(request: &OptimiseRequest) -> Vec<TiltedMetric> {
    let observer = headline::observer(request);
    let iso = Metric::by_name("iso").map(|iso| TiltedMetric { observer, ..TiltedMetric::new(iso) });
    let mut metrics: Vec<TiltedMetric> = Vec::new();
    for of in request.objectives.iter().map(|objective| objective.of.clone()).chain(iso) {
        let same = |o: &TiltedMetric| {
            o.metric.name == of.metric.name && o.observer == of.observer && o.material == of.material
        };
        if !matches!(of.metric.read_from, MetricSource::Solid(_)) && !metrics.iter().any(same) {
            metrics.push(of);
        }
    }
    metrics
}

/// The designs that are drawn: all of a few, or some evenly along them.
pub(super) fn drawn<'k, 'a>(kept: &'k [KeptDesign<'a>]) -> Vec<&'k KeptDesign<'a>> {
    let last = kept.len().saturating_sub(1);
    match kept.len() {
        0..=MOST_LINES => kept.iter().collect(),
        _ => (0..MOST_LINES).map(|i| &kept[i * last / (MOST_LINES - 1)]).collect(),
    }
}

/// One plot for each metric, with a line for the start and one for each of the designs.
///
/// - `start`: the solid as it was, and what all are made of
pub(super) fn plots(
    request: &OptimiseRequest,
    start: (&Material, &Polyhedron),
    designs: &[&KeptDesign],
) -> Vec<TiltPlot> {
    let tilts: Vec<f64> = tilt_curves::tilts().collect();
    let names = ["start"].into_iter().chain(designs.iter().map(|design| design.mark.as_str()));
    let names: Vec<&str> = names.collect();
    let plot = |of: TiltedMetric| {
        let rows = parallel::map(tilts.len(), |i| at_tilt(request, (&of, tilts[i]), start, designs));
        let curve = |(line, name): (usize, &&str)| PlotCurve {
            name: (*name).to_owned(),
            points: tilts
                .iter()
                .zip(&rows)
                .map(|(tilt, row)| (*tilt, row[line].map(|e| (e.value, e.error))))
                .collect(),
        };
        tilt_curves::plot(of.metric, names.iter().enumerate().map(curve).collect())
    };
    metrics(request).into_iter().map(plot).collect()
}

/// A metric of the start and of the designs at one tilt; none where it has no value.
fn at_tilt(
    request: &OptimiseRequest,
    (of, degrees): (&TiltedMetric, f64),
    (material, start): (&Material, &Polyhedron),
    designs: &[&KeptDesign],
) -> Vec<Option<Estimate>> {
    let mut of = of.clone();
    of.tilts = Tilts::default();
    of.tilts.degrees = vec![degrees];
    let effort = request.effort.samples(SAMPLES).seed(!request.effort.seed);
    let objective = Objective::maximise(of);
    let Ok(evaluator) = Evaluator::new(vec![objective], Vec::new(), material, effort, start) else {
        return vec![None; designs.len() + 1];
    };
    let first = evaluator.start().objectives.first().copied();
    let value = |solid: &Polyhedron| evaluator.values(solid).ok()?.objectives.first().copied();
    let others = designs.iter().map(|design| value(&design.finalist.edited.solid));
    std::iter::once(first).chain(others).collect()
}
