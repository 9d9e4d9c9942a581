//! Scores of stones: which experiments to run, how long, and one row a stone.

use crate::experiments::view::{Sky, Surroundings};
use crate::experiments::weigh::Effort as Work;
use crate::experiments::{
    Aspect, BATCHES, Beam, Contrast, Experiment, ExperimentError, Hemisphere, Iso, Medium, Quadrature,
    Scintillation, Traced, View, by_beams, cells, iso, view,
};
use crate::math::stats::{self, Estimate, Sum};
use crate::metrics::{METRICS, Metric, Reading};
use crate::optics::Material;
use crate::solid::Polyhedron;
use crate::walk::Stone;
use crate::walk::beams::Beams;

/// Points of the hemisphere and of the view when nothing else is asked: ±.0003 of `wlr` for a
/// round brilliant, ±.0002 of the `aset` scores.
pub const DEFAULT_SAMPLES: u64 = 1 << 18;

/// So many points of the hemisphere are as dear as one of the beam, which has six lines and follows
/// paths to a hundredth of the power; what a given number of samples is divided by for the beam.
const BEAM_COST: u64 = 4;

/// The same for a cell of two points.
const CONTRAST_COST: u64 = 2;

/// The same for a cell of one to a thousand points, three on average, seen twice.
const ROCKING_COST: u64 = 6;

/// The same for a direction of the dome that is followed by beams.
const DIRECTION_COST: u64 = 256;

/// The same for a photon that finishes beams, which then outweigh it.
const PHOTON_COST: u64 = 16;

/// Points of the hemisphere, or as much of other experiments, before its error is looked at: enough for every batch to have seen
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
    /// Whether metrics that beams can give are taken from beams: the effort is then theirs. Not in a
    /// stone that absorbs: the path differs across a beam.
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
    /// Its shape, in millimetres if the material absorbs; or why it has none: the row then carries
    /// the message.
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
    let exact = plan.exact && subject.material.is_clear();
    let mut sheet = Sheet { row, plan, exact };
    let hemisphere = |r| if let Reading::Hemisphere(f) = r { Some(f) } else { None };
    sheet.fill("hemisphere", hemisphere, false, 1, || Hemisphere::seen_from(stone, &medium, aspect))?;
    let view = |r| if let Reading::View(f) = r { Some(f) } else { None };
    let surroundings = Surroundings { scope: sky(view::SCOPE_DEG), dome: sky(view::OBSERVER_DEG) };
    sheet.fill("view", view, false, 1, || View::seen_from(stone, &medium, aspect, surroundings))?;
    let iso = |r| if let Reading::Iso(f) = r { Some(f) } else { None };
    let head = sky(iso::OBSERVER_DEG);
    sheet.fill("iso", iso, false, 1, || Iso::seen_from(stone, &medium, aspect, head))?;
    let cells = sky(cells::OBSERVER_DEG);
    let contrast = |r| if let Reading::Contrast(f) = r { Some(f) } else { None };
    sheet.fill("contrast", contrast, false, CONTRAST_COST, || {
        Contrast::seen_from(stone, &medium, aspect, cells)
    })?;
    let scintillation = |r| if let Reading::Scintillation(f) = r { Some(f) } else { None };
    sheet.fill("scintillation", scintillation, false, ROCKING_COST, || {
        Scintillation::seen_from(stone, &medium, aspect, cells)
    })?;
    let beam = |r| if let Reading::Beam(f) = r { Some(f) } else { None };
    let dispersive = subject.material.is_dispersive();
    if dispersive {
        sheet.fill("beam", beam, false, BEAM_COST, || Beam::seen_from(stone, &medium, aspect))?;
    }
    if exact {
        let make = || Quadrature::seen_from(stone, &medium, aspect);
        sheet.fill("quadrature", hemisphere, true, DIRECTION_COST, make)?;
        let beams = Beams::new(stone);
        sheet.finish("view by beams", view, |w| by_beams::view(&beams, &medium, aspect, surroundings, w))?;
        sheet.finish("iso by beams", iso, |_| Ok(vec![by_beams::iso(&beams, &medium, aspect, head)?]))?;
        if dispersive {
            sheet.finish("beam by beams", beam, |w| by_beams::colours(&beams, &medium, aspect, w))?;
        }
    }
    Ok(())
}

/// A row that is being filled in.
struct Sheet<'a> {
    row: &'a mut Row,
    plan: &'a Plan,
    /// Whether beams are used.
    exact: bool,
}

/// A column: its number, its metric's scale, and what it reads from a tally.
type Column<F> = (usize, f64, F);

impl Sheet<'_> {
    /// The columns that read a tally.
    ///
    /// - `of`: what a metric reads from it, if it does; `by_beams`: whether beams have filled it in
    fn columns<F>(&self, of: impl Fn(Reading) -> Option<F>, by_beams: bool) -> Vec<Column<F>> {
        let asked = |m: &Metric| (self.exact && m.by_beams) == by_beams;
        let metrics = self.plan.metrics.iter().enumerate().filter(|(_, m)| asked(m));
        metrics.filter_map(|(i, m)| Some((i, m.scale, of(m.reading)?))).collect()
    }

    /// Traces an experiment as far as the plan asks and fills in the columns that read it, if there
    /// are any.
    ///
    /// - `of`, `by_beams`: as [`Sheet::columns`] has them
    /// - `cost`: so many points of the hemisphere are as dear as one of this experiment
    fn fill<E: Experiment, F: Fn(&E::Tally) -> f64>(
        &mut self,
        name: &'static str,
        of: impl Fn(Reading) -> Option<F>,
        by_beams: bool,
        cost: u64,
        make: impl FnOnce() -> Result<E, ExperimentError>,
    ) -> Result<(), ExperimentError> {
        let columns = self.columns(of, by_beams);
        if columns.is_empty() {
            return Ok(());
        }
        let mut traced = Traced::new(make()?, self.plan.seed);
        match self.plan.effort {
            Effort::Samples(samples) => traced.extend_to((samples / cost).max(1)),
            Effort::Error(target) => {
                let worst = |t: &Traced<E>| worst(&columns, |f| t.estimate(f));
                let (first, cap) = (FIRST_SAMPLES / cost, self.plan.cap / cost);
                if let Some(error) = reach(&mut traced, target, first.max(1), cap, worst) {
                    self.complain(name, target, error, traced.samples());
                }
            }
        }
        self.take(name, traced.samples(), &columns, |f| traced.estimate(f));
        Ok(())
    }

    /// Fills in the columns that beams of one direction give, with photons for what is left over as
    /// far as the plan asks.
    fn finish<T: Sum, F: Fn(&T) -> f64>(
        &mut self,
        name: &'static str,
        of: impl Fn(Reading) -> Option<F>,
        tallies: impl Fn(&Work) -> Result<Vec<T>, ExperimentError>,
    ) -> Result<(), ExperimentError> {
        let columns = self.columns(of, true);
        if columns.is_empty() {
            return Ok(());
        }
        let cap = self.plan.cap / PHOTON_COST;
        let mut photons = match self.plan.effort {
            Effort::Samples(samples) => samples / PHOTON_COST,
            Effort::Error(_) => FIRST_SAMPLES / PHOTON_COST,
        };
        loop {
            // fewer than two a batch would leave the remainder out
            photons = photons.max(2 * BATCHES as u64);
            let work = Work { photons: photons as usize, seed: self.plan.seed, ..Work::default() };
            let found = tallies(&work)?;
            let estimate = |f: &F| match &found[..] {
                [only] => Estimate::exact(f(only)),
                all => stats::jackknife(all, f),
            };
            let error = worst(&columns, estimate);
            match self.plan.effort {
                Effort::Error(target) if error > target && photons < cap => {
                    photons = more(photons, error / target).min(cap);
                    continue;
                }
                Effort::Error(target) if error > target => self.complain(name, target, error, photons),
                _ => (),
            }
            self.take(name, photons, &columns, estimate);
            return Ok(());
        }
    }

    fn take<F>(
        &mut self,
        name: &'static str,
        samples: u64,
        columns: &[Column<F>],
        estimate: impl Fn(&F) -> Estimate,
    ) {
        for (column, _, f) in columns {
            let score = estimate(f);
            self.row.scores[*column] = Some(score).filter(|e| e.value.is_finite() && e.error.is_finite());
        }
        self.row.samples.push((name, samples));
    }

    /// Notes an error that was not reached.
    fn complain(&mut self, name: &str, target: f64, error: f64, samples: u64) {
        let note =
            format!("{name}: standard error {target} not reached: {error:.2e} after {samples} samples");
        let before = self.row.error.take();
        self.row.error = Some(before.map_or(note.clone(), |e| format!("{e}; {note}")));
    }
}

/// The largest error of any column, measured against its scale.
fn worst<F>(columns: &[Column<F>], estimate: impl Fn(&F) -> Estimate) -> f64 {
    columns.iter().map(|(_, scale, f)| estimate(f).error / scale).fold(0.0, f64::max)
}

/// How many samples are likely to bring an error down that is `times` too large: the errors of evenly
/// spread points fall with the root of the samples or faster, about as samples to the power of 2/3.
fn more(samples: u64, times: f64) -> u64 {
    (samples as f64 * times.powf(1.5).clamp(LEAST_STEP, LARGEST_STEP)) as u64
}

/// Traces until the error is below the target; the error if the cap comes first.
fn reach<E: Experiment>(
    traced: &mut Traced<E>,
    target: f64,
    first: u64,
    cap: u64,
    worst: impl Fn(&Traced<E>) -> f64,
) -> Option<f64> {
    traced.extend_to(first.min(cap));
    loop {
        let error = worst(traced);
        if error <= target {
            return None;
        }
        if traced.samples() >= cap {
            return Some(error);
        }
        traced.extend_to(more(traced.samples(), error / target).min(cap));
    }
}
