//! Scores of stones: which experiments to run, how long, and one row a stone.

use crate::experiments::{Beam, Experiment, ExperimentError, Hemisphere, Medium, Traced, View};
use crate::math::stats::Estimate;
use crate::metrics::{METRICS, Metric, Reading};
use crate::optics::Material;
use crate::solid::Polyhedron;
use crate::walk::Stone;

/// Points of the hemisphere and of the view when nothing else is asked: ±.0003 of `wlr` for a
/// round brilliant, ±.0002 of the `aset` scores.
pub const DEFAULT_SAMPLES: u64 = 1 << 18;

/// So many points of the others are as dear as one of the beam, which has six lines and follows
/// paths to a hundredth of the power; what a given number of samples is divided by for the beam.
const BEAM_COST: u64 = 4;

/// Points of every experiment before its error is looked at: enough for every batch to have seen
/// something.
const FIRST_SAMPLES: u64 = 1 << 14;

/// Unless the plan says otherwise no experiment is traced further than this in pursuit of an error:
/// about a minute a stone and experiment on two cores.
pub const SAMPLES_CAP: u64 = 1 << 25;

/// How far to trace.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Effort {
    /// So many points of the hemisphere and the view, a quarter of it of the beam.
    Samples(u64),
    /// Until the standard error of every metric asked for is below this times the metric's
    /// [`Metric::scale`]: a fraction, degrees for angles, hundredths of it for percentages.
    Error(f64),
}

impl Default for Effort {
    fn default() -> Self {
        Effort::Samples(DEFAULT_SAMPLES)
    }
}

/// What to score, and how.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The metrics, in the order of the columns.
    pub metrics: Vec<&'static Metric>,
    /// How far to trace.
    pub effort: Effort,
    /// Whether light keeps its polarisation from facet to facet; if not it counts as unpolarised at
    /// each (scalar Fresnel).
    pub polarised: bool,
    /// The user's seed.
    pub seed: u64,
    /// No experiment is traced further than so many samples in pursuit of an error (the beam a
    /// quarter of it); where this ends one, the row says so.
    pub cap: u64,
    /// Whether metrics that beams can give are taken from beams: the effort is then theirs.
    pub exact: bool,
    /// Half-angle in degrees of the observer's dark cone, for the metrics that have one
    /// ([`Metric::observer`]); none leaves each its own.
    pub observer: Option<f64>,
}

impl Default for Plan {
    /// Every metric, default effort and cap, polarisation followed, seed 1, no beams, each metric's
    /// own observer.
    fn default() -> Self {
        Plan {
            metrics: METRICS.to_vec(),
            effort: Effort::default(),
            polarised: true,
            seed: 1,
            cap: SAMPLES_CAP,
            exact: false,
            observer: None,
        }
    }
}

/// How a stone is turned before viewer and light, which stay.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tilt {
    /// Degrees, right-handed about the axis.
    pub degrees: f64,
    /// Azimuth of the axis, which is horizontal, in degrees from +x towards +y.
    pub azimuth: f64,
}

/// A stone to score.
#[derive(Debug, Clone)]
pub struct Subject {
    /// Its name in the table.
    pub stone: String,
    /// What it is made of.
    pub material: Material,
    /// Its shape, or why it has none: the row then carries the message.
    pub solid: Result<Polyhedron, String>,
    /// How it is turned; none for face-up.
    pub tilt: Option<Tilt>,
}

/// The scores of a stone.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// The stone's name.
    pub stone: String,
    /// Its material's name.
    pub material: String,
    /// Number of its facets; none if it has no shape.
    pub facets: Option<usize>,
    /// One a metric of the plan; none where the metric does not apply (no dispersion) or the stone
    /// failed.
    pub scores: Vec<Option<Estimate>>,
    /// Points traced, by experiment.
    pub samples: Vec<(&'static str, u64)>,
    /// What went wrong: no shape, no light, or an error not reached (the scores then stand).
    pub error: Option<String>,
}

/// Scores one stone.
///
/// The result is a pure function of subject and plan: the number of threads shows in no bit.
/// Never fails; a stone that cannot be scored says so in [`Row::error`].
/// Checked against published and reference figures in `tests/scores.rs`.
pub fn score(subject: &Subject, plan: &Plan) -> Row {
    let mut row = Row {
        stone: subject.stone.clone(),
        material: subject.material.name.to_string(),
        facets: None,
        scores: vec![None; plan.metrics.len()],
        samples: Vec::new(),
        error: None,
    };
    match &subject.solid {
        Ok(solid) => {
            let stone = Stone::new(solid.clone());
            row.facets = Some(stone.facet_count());
            if let Err(e) = fill(&mut row, &stone, &subject.material, plan) {
                row.error = Some(e.to_string());
            }
        }
        Err(why) => row.error = Some(why.clone()),
    }
    row
}

/// Scores stones one after the other, each on all threads.
pub fn score_all(subjects: &[Subject], plan: &Plan) -> Vec<Row> {
    subjects.iter().map(|s| score(s, plan)).collect()
}

fn fill(row: &mut Row, stone: &Stone, material: &Material, plan: &Plan) -> Result<(), ExperimentError> {
    let medium = Medium { material, polarised: plan.polarised };
    let hemisphere = readings(plan, |r| if let Reading::Hemisphere(f) = r { Some(f) } else { None });
    let view = readings(plan, |r| if let Reading::View(f) = r { Some(f) } else { None });
    let beam = readings(plan, |r| if let Reading::Beam(f) = r { Some(f) } else { None });
    if !hemisphere.is_empty() {
        run(row, Hemisphere::new(stone, &medium)?, &hemisphere, plan, 1);
    }
    if !view.is_empty() {
        run(row, View::new(stone, &medium)?, &view, plan, 1);
    }
    if !beam.is_empty() && material.is_dispersive() {
        run(row, Beam::new(stone, &medium)?, &beam, plan, BEAM_COST);
    }
    Ok(())
}

/// The columns that read one experiment, with what they read there.
fn readings<F>(plan: &Plan, of: impl Fn(Reading) -> Option<F>) -> Vec<(usize, F)> {
    plan.metrics.iter().enumerate().filter_map(|(i, m)| Some((i, of(m.reading)?))).collect()
}

/// A column's number, and what it reads from a tally.
type Column<T> = (usize, fn(&T) -> (f64, f64));

/// Traces an experiment as far as the plan asks and fills in its columns.
fn run<E: Experiment>(row: &mut Row, experiment: E, columns: &[Column<E::Tally>], plan: &Plan, cost: u64) {
    let mut traced = Traced::new(experiment, plan.seed);
    match plan.effort {
        Effort::Samples(samples) => traced.extend_to((samples / cost).max(1)),
        Effort::Error(target) => {
            traced.extend_to(FIRST_SAMPLES);
            let largest =
                |t: &Traced<E>| columns.iter().map(|(_, f)| t.estimate(f).error).fold(0.0, f64::max);
            let mut error = largest(&traced);
            while error > target && traced.samples() < plan.cap / cost {
                traced.extend_to((traced.samples() * 5 / 4).min(plan.cap / cost));
                error = largest(&traced);
            }
            if error > target {
                let note = format!(
                    "standard error {target} not reached: {error:.2e} after {} samples",
                    traced.samples()
                );
                row.error = Some(row.error.take().map_or(note.clone(), |e| format!("{e}; {note}")));
            }
        }
    }
    for (column, f) in columns {
        row.scores[*column] = Some(traced.estimate(f));
    }
}
