//! Scores of stones: which experiments to run, how long, and one row a stone.

use crate::experiments::view::{Sky, Surroundings};
use crate::experiments::{
    Aspect, Beam, Contrast, Experiment, ExperimentError, Hemisphere, Iso, Medium, Scintillation, Traced,
    View, cells, iso, view,
};
use crate::math::stats::Estimate;
use crate::metrics::{METRICS, Metric, Reading};
use crate::optics::Material;
use crate::solid::Polyhedron;
use crate::walk::Stone;

/// Points of the hemisphere and of the view when nothing else is asked: ±.0003 of `wlr` for a
/// round brilliant, ±.0002 of the `aset` scores.
pub const DEFAULT_SAMPLES: u64 = 1 << 18;

/// So many points of the hemisphere are as dear as one of the beam, which has six lines and follows
/// paths to a hundredth of the power; what a given number of samples is divided by for the beam.
const BEAM_COST: u64 = 4;

/// The same for a cell of two points.
const CONTRAST_COST: u64 = 2;

/// The same for a cell of one to 64 points, seen twice.
const ROCKING_COST: u64 = 6;

/// Points of every experiment before its error is looked at: enough for every batch to have seen
/// something.
const FIRST_SAMPLES: u64 = 1 << 13;

/// By how much samples grow from one look at the error to the next.
const LEAST_STEP: f64 = 1.1;
const LARGEST_STEP: f64 = 16.0;

/// Unless the plan says otherwise no experiment is traced further than this in pursuit of an error:
/// about a minute a stone and experiment on two cores.
pub const SAMPLES_CAP: u64 = 1 << 25;

/// How far to trace.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Effort {
    /// So many points of the hemisphere and the view, fewer of dearer experiments.
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
    /// No experiment is traced further than so many samples in pursuit of an error (dearer ones
    /// fewer); where this ends one, the row says so.
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
            if let Err(e) = fill(&mut row, &stone, subject, plan) {
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

fn fill(row: &mut Row, stone: &Stone, subject: &Subject, plan: &Plan) -> Result<(), ExperimentError> {
    let medium = Medium { material: &subject.material, polarised: plan.polarised };
    let aspect = subject.tilt.map_or(Aspect::FACE_UP, |t| Aspect::tilted(t.degrees, t.azimuth));
    let sky = |own: f64| Sky::behind(plan.observer.unwrap_or(own));
    for (column, metric) in plan.metrics.iter().enumerate() {
        if let Reading::Solid(of) = metric.reading {
            row.scores[column] = of(&stone.solid).map(Estimate::exact);
        }
    }
    let mut sheet = Sheet { row, plan };
    let pick = |r| if let Reading::Hemisphere(f) = r { Some(f) } else { None };
    sheet.fill("hemisphere", pick, 1, || Hemisphere::seen_from(stone, &medium, aspect))?;
    let pick = |r| if let Reading::View(f) = r { Some(f) } else { None };
    let surroundings = Surroundings { scope: sky(view::SCOPE_DEG), dome: sky(view::OBSERVER_DEG) };
    sheet.fill("view", pick, 1, || View::seen_from(stone, &medium, aspect, surroundings))?;
    let pick = |r| if let Reading::Iso(f) = r { Some(f) } else { None };
    sheet.fill("iso", pick, 1, || Iso::seen_from(stone, &medium, aspect, sky(iso::OBSERVER_DEG)))?;
    let cells = sky(cells::OBSERVER_DEG);
    let pick = |r| if let Reading::Contrast(f) = r { Some(f) } else { None };
    sheet.fill("contrast", pick, CONTRAST_COST, || Contrast::seen_from(stone, &medium, aspect, cells))?;
    let pick = |r| if let Reading::Scintillation(f) = r { Some(f) } else { None };
    sheet.fill("scintillation", pick, ROCKING_COST, || {
        Scintillation::seen_from(stone, &medium, aspect, cells)
    })?;
    if subject.material.is_dispersive() {
        let pick = |r| if let Reading::Beam(f) = r { Some(f) } else { None };
        sheet.fill("beam", pick, BEAM_COST, || Beam::seen_from(stone, &medium, aspect))?;
    }
    Ok(())
}

/// A row that is being filled in.
struct Sheet<'a> {
    row: &'a mut Row,
    plan: &'a Plan,
}

impl Sheet<'_> {
    /// Traces an experiment as far as the plan asks and fills in the columns that read it, if there
    /// are any.
    ///
    /// - `of`: what a metric reads from the tally, if it reads this experiment
    /// - `cost`: so many points of the hemisphere are as dear as one of this experiment
    fn fill<E: Experiment, F: Fn(&E::Tally) -> f64>(
        &mut self,
        name: &'static str,
        of: impl Fn(Reading) -> Option<F>,
        cost: u64,
        make: impl FnOnce() -> Result<E, ExperimentError>,
    ) -> Result<(), ExperimentError> {
        let metrics = self.plan.metrics.iter().enumerate();
        let columns: Vec<(usize, f64, F)> =
            metrics.filter_map(|(i, m)| Some((i, m.scale, of(m.reading)?))).collect();
        if columns.is_empty() {
            return Ok(());
        }
        let mut traced = Traced::new(make()?, self.plan.seed);
        match self.plan.effort {
            Effort::Samples(samples) => traced.extend_to((samples / cost).max(1)),
            Effort::Error(target) => {
                let worst = |t: &Traced<E>| {
                    columns.iter().map(|(_, scale, f)| t.estimate(f).error / scale).fold(0.0, f64::max)
                };
                if let Some(error) = reach(&mut traced, target, self.plan.cap / cost, worst) {
                    let note = format!(
                        "{name}: standard error {target} not reached: {error:.2e} after {} samples",
                        traced.samples()
                    );
                    let row = &mut self.row;
                    row.error = Some(row.error.take().map_or(note.clone(), |e| format!("{e}; {note}")));
                }
            }
        }
        for (column, _, f) in &columns {
            let score = traced.estimate(f);
            self.row.scores[*column] = Some(score).filter(|e| e.value.is_finite() && e.error.is_finite());
        }
        self.row.samples.push((name, traced.samples()));
        Ok(())
    }
}

/// Traces until the error is below the target; the error if the cap comes first.
fn reach<E: Experiment>(
    traced: &mut Traced<E>,
    target: f64,
    cap: u64,
    worst: impl Fn(&Traced<E>) -> f64,
) -> Option<f64> {
    traced.extend_to(FIRST_SAMPLES.min(cap));
    loop {
        let error = worst(traced);
        if error <= target {
            return None;
        }
        if traced.samples() >= cap {
            return Some(error);
        }
        // errors fall with the root of the samples or faster; one of few samples may be far off
        let steps = (error / target).powi(2).clamp(LEAST_STEP, LARGEST_STEP);
        traced.extend_to(((traced.samples() as f64 * steps) as u64).min(cap));
    }
}
