//! Views: the metrics of objectives and constraints by material, observer and tilt, each scored once, and what
//! several tilts together are.

use super::objective::{Aim, ObjectiveError, OverTilts, TiltedMetric};
use super::paired_runs::PairedRuns;
use super::settings::Tilt;
use crate::estimators::catalogue::BeamNoise;
use crate::limits::Limits;
use crate::materials::Material;
use crate::metrics::{Metric, MetricSource};
use crate::sampling::stats::Estimate;

/// Metrics of one view.
pub(super) struct View {
    pub material: Material,
    pub observer: Option<f64>,
    pub tilt: Option<Tilt>,
    /// Whether they have no noise.
    pub is_closed: bool,
    pub metrics: Vec<&'static Metric>,
}

/// A metric among the views.
#[derive(Debug, Clone, Copy)]
struct Place {
    view: usize,
    column: usize,
}

/// Where the values are that a metric at tilts is made of: tilt by tilt, those about each axis.
pub(super) struct Places {
    tilts: Vec<Vec<Place>>,
    over: OverTilts,
    aim: Aim,
}

/// The places of a metric at its tilts; views that nothing else has asked for are added.
pub(super) fn places(
    views: &mut Vec<View>,
    of: &TiltedMetric,
    aim: Aim,
    material: &Material,
) -> Result<Places, ObjectiveError> {
    of.check()?;
    let material = match &of.material {
        Some(name) => Material::open(name, Limits::default()).map_err(ObjectiveError::Material)?,
        None => material.clone(),
    };
    let is_solid = matches!(of.metric.read_from, MetricSource::Solid(_));
    let is_closed = is_solid || material.is_clear() && of.metric.beam_noise() == Some(BeamNoise::None);
    let mut place = |tilt: Option<Tilt>| {
        let same = |v: &View| {
            v.is_closed == is_closed && v.observer == of.observer && v.tilt == tilt && v.material == material
        };
        let view = views.iter().position(same).unwrap_or_else(|| {
            let material = material.clone();
            views.push(View { material, observer: of.observer, tilt, is_closed, metrics: Vec::new() });
            views.len() - 1
        });
        let metrics = &mut views[view].metrics;
        let column = metrics.iter().position(|m| m.name == of.metric.name).unwrap_or_else(|| {
            metrics.push(of.metric);
            metrics.len() - 1
        });
        Place { view, column }
    };
    let tilts = of.views().into_iter().map(|about| about.into_iter().map(&mut place).collect()).collect();
    Ok(Places { tilts, over: of.tilts.over, aim })
}

/// The mean of estimates; their errors may have a cause in common, so they add up.
fn mean(of: impl ExactSizeIterator<Item = Estimate>) -> Estimate {
    let n = of.len() as f64;
    let sum = of.fold(Estimate::exact(0.0), |sum, e| Estimate {
        value: sum.value + e.value,
        error: sum.error + e.error,
    });
    Estimate { value: sum.value / n, error: sum.error / n }
}

/// A metric at its tilts from the scores of one run.
pub(super) fn value(of: &Places, scores: &[Vec<Estimate>]) -> Estimate {
    let tilts: Vec<Estimate> = of
        .tilts
        .iter()
        .map(|about| mean(about.iter().map(|place| scores[place.view][place.column])))
        .collect();
    of.over(tilts)
}

impl Places {
    /// Whether it reads scores of a view.
    pub fn uses(&self, view: usize) -> bool {
        self.tilts.iter().flatten().any(|place| place.view == view)
    }

    /// What counts of values at several tilts, or of several stones: their mean, or the worst.
    pub fn over(&self, values: Vec<Estimate>) -> Estimate {
        let badness = |e: &Estimate| -self.aim.sign() * e.value;
        let worst = match self.over {
            OverTilts::Mean => return mean(values.iter().copied()),
            OverTilts::Worst => values.iter().copied().max_by(|a, b| badness(a).total_cmp(&badness(b))),
        };
        let worst = worst.unwrap_or(Estimate::exact(f64::NAN));
        // any may be the worst that is within the errors of it
        let could_be = |e: &&Estimate| badness(e) + 2.0 * e.error >= badness(&worst) - 2.0 * worst.error;
        Estimate { error: values.iter().filter(could_be).map(|e| e.error).fold(0.0, f64::max), ..worst }
    }

    /// As [`Places::over`], of paired runs. The worst is what is worst in the mean over the runs.
    pub fn paired_over(&self, runs: Vec<PairedRuns>) -> PairedRuns {
        let badness = |runs: &PairedRuns| -self.aim.sign() * runs.value();
        match self.over {
            OverTilts::Mean => mean_of_runs(&runs),
            OverTilts::Worst => {
                let worst = runs.into_iter().max_by(|a, b| badness(a).total_cmp(&badness(b)));
                worst.unwrap_or_else(|| PairedRuns::new(Vec::new(), 0.0))
            }
        }
    }
}

fn mean_of_runs(parts: &[PairedRuns]) -> PairedRuns {
    let weight = 1.0 / parts.len() as f64;
    PairedRuns::combined(parts.iter().map(|part| (weight, part)))
}

/// A metric at its tilts in paired runs.
pub(super) fn paired(of: &Places, runs: &[Vec<Vec<Estimate>>]) -> PairedRuns {
    let at = |place: &Place| {
        let scores = || runs.iter().map(|scores| scores[place.view][place.column]);
        let first = scores().next().unwrap_or(Estimate::exact(f64::NAN));
        match scores().all(|score| score == first) {
            true => PairedRuns::new(vec![first.value], first.error),
            // the runs differ by their noise, which their errors hold
            false => PairedRuns::new(scores().map(|score| score.value).collect(), 0.0),
        }
    };
    let about_each_axis = |about: &Vec<Place>| mean_of_runs(&about.iter().map(at).collect::<Vec<_>>());
    of.paired_over(of.tilts.iter().map(about_each_axis).collect())
}
