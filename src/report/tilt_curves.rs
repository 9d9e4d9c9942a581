//! Tilt curves: scores against the tilt of the stone.

use super::plot::{Curves, PlotCurve};
use super::request::ReportInput;
use crate::geometry::Polyhedron;
use crate::metrics::Metric;
use crate::scoring::score::{ScoreInput, ScoreRequest, Target, Tilt, score};

/// Tilts to both sides, in degrees.
const MOST_TILT: i32 = 20;
const STEP: usize = 2;

/// Points of each estimator at each tilt: ±.0009 of `wlr`.
const SAMPLES: u64 = 1 << 15;

/// Scores that are drawn against the tilt.
pub const TILTED: [&str; 3] = ["wlr", "aset_leak", "iso"];

/// A plot of one score.
#[derive(Debug, Clone)]
pub struct TiltPlot {
    /// The score.
    pub metric: &'static Metric,
    /// The drawing.
    pub svg: String,
}

/// One plot for each score of [`TILTED`], with a line for each stone, tilted about the x axis.
///
/// - `stones`: each with the name of its line, empty for none
/// - `plan`: polarisation, seed and observer are taken from it
/// - `step`: called before each stone
///
/// Stones that cannot be scored at a tilt have a gap there.
pub fn plots(
    stones: &[(&ReportInput, &str, &Polyhedron)],
    plan: &ScoreRequest,
    step: &dyn Fn(),
) -> Vec<TiltPlot> {
    let metrics: Vec<&'static Metric> = TILTED.iter().filter_map(|name| Metric::by_name(name)).collect();
    let plan = ScoreRequest {
        metrics: metrics.clone(),
        target: Target::Samples(SAMPLES),
        exact: false,
        ..plan.clone()
    };
    let mut curves: Vec<Vec<PlotCurve>> = vec![Vec::new(); metrics.len()];
    for (request, name, solid) in stones {
        step();
        let mut lines = vec![PlotCurve { name: name.to_string(), points: Vec::new() }; metrics.len()];
        for degrees in tilts() {
            let subject = ScoreInput {
                stone: request.stone.clone(),
                material: request.material.clone(),
                shape: Ok((*solid).clone().into()),
                tilt: Some(Tilt { degrees, azimuth: 0.0 }),
            };
            for (line, value) in lines.iter_mut().zip(score(&subject, &plan).scores) {
                line.points.push((degrees, value.map(|e| (e.value, e.error))));
            }
        }
        curves.iter_mut().zip(lines).for_each(|(all, line)| all.push(line));
    }
    metrics.into_iter().zip(curves).map(|(metric, curves)| plot(metric, curves)).collect()
}

/// Tilts at which scores are drawn, in degrees.
pub(super) fn tilts() -> impl Iterator<Item = f64> {
    (-MOST_TILT..=MOST_TILT).step_by(STEP).map(f64::from)
}

/// The plot of one score.
pub(super) fn plot(metric: &'static Metric, curves: Vec<PlotCurve>) -> TiltPlot {
    let unit = if metric.unit.is_empty() { String::new() } else { format!(" ({})", metric.unit) };
    let drawing = Curves {
        title: metric.name.into(),
        x: "tilt (°)".into(),
        y: format!("{}{unit}", metric.name),
        curves,
        dots: Vec::new(),
        small: true,
        ..Curves::default()
    };
    TiltPlot { metric, svg: drawing.svg() }
}
