//! Scores of stones: which experiments to run, how long, and one row a stone.

use super::sheet::Sheet;
use crate::cut::Zone;
use crate::experiments::beam::Needs;
use crate::experiments::view::{Sky, Surroundings};
use crate::experiments::{
    Aspect, Beam, Contrast, ExperimentError, Hemisphere, Iso, Medium, Quadrature, STOP_POWER, Scintillation,
    View, beam, by_beams, cells, dented, fire, hemisphere, iso, view,
};
use crate::math::stats::Estimate;
use crate::metrics::{METRICS, Metric, Reading, Statistic};
use crate::optics::Material;
use crate::solid::{Body, Polyhedron};
use crate::walk::Stone;
use crate::walk::beams::Beams;
use crate::walk::mesh::MeshStone;
use std::borrow::Cow;

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

/// The same for a ray of a stone that is not convex.
const DENTED_COST: u64 = 16;

/// The same for a direction of the dome that is followed by beams.
const DIRECTION_COST: u64 = 256;

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
    /// stone that absorbs: the path differs across a beam; nor in one with dents.
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

/// The shape of a stone.
#[derive(Debug, Clone)]
pub enum Shape {
    /// A convex solid: it has every score.
    Convex(Polyhedron),
    /// One closed surface with dents: it has the scores that are sums of power ([`Metric::dented`]).
    Dented(Box<Body>),
}

impl From<Polyhedron> for Shape {
    fn from(solid: Polyhedron) -> Shape {
        Shape::Convex(solid)
    }
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
    pub shape: Result<Shape, String>,
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
    /// One a metric of the plan; none where the metric does not apply (see [`Row::left_out`]) or the
    /// stone failed.
    pub scores: Vec<Option<Estimate>>,
    /// Points traced, by experiment.
    pub samples: Vec<(&'static str, u64)>,
    /// What is to be said of the scores: photons that took the place of beams.
    pub note: Option<&'static str>,
    /// What went wrong: no shape, no light, or an error not reached (the scores then stand).
    pub error: Option<String>,
    /// Metrics of the plan that do not apply to the stone, with the reason: nothing went wrong.
    pub left_out: Vec<(&'static str, Cow<'static, str>)>,
}

impl Row {
    /// Leaves the score of a metric empty, for a reason.
    pub(super) fn leave_out(&mut self, metric: &Metric, why: impl Into<Cow<'static, str>>) {
        self.left_out.push((metric.name, why.into()));
    }

    /// What is left out and why, in words: metrics of one reason together. None if every score is there.
    pub fn omissions(&self) -> Option<String> {
        let mut reasons: Vec<(&str, Vec<&str>)> = Vec::new();
        for (metric, why) in &self.left_out {
            match reasons.iter_mut().find(|(reason, _)| *reason == why.as_ref()) {
                Some((_, metrics)) => metrics.push(metric),
                None => reasons.push((why, vec![metric])),
            }
        }
        let said: Vec<String> =
            reasons.iter().map(|(why, metrics)| format!("{} left out: {why}", metrics.join(", "))).collect();
        (!said.is_empty()).then(|| said.join("; "))
    }

    /// The reason for which a metric is left out, if it is.
    pub fn why_left_out(&self, metric: &Metric) -> Option<&str> {
        self.left_out.iter().find(|(name, _)| *name == metric.name).map(|(_, why)| why.as_ref())
    }
}

/// Why scores that look at single rays are left out.
const DENTED: &str = "not known for stones that are not convex";

/// Why scores that compare with the Tolkowsky stone are left out.
const NO_OUTLINE: &str = "the stone has no outline to compare";

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
        note: None,
        error: None,
        left_out: Vec::new(),
    };
    let filled = match &subject.shape {
        Ok(Shape::Convex(solid)) => {
            let stone = Stone::new(solid.clone());
            row.facets = Some(stone.facet_count());
            fill(&mut row, &stone, subject, plan).map_err(|e| e.to_string())
        }
        Ok(Shape::Dented(_)) if !plan.metrics.iter().any(|m| m.dented) => {
            Err("not convex: it has none of the scores asked for (cutlab list metrics tells which it has)"
                .into())
        }
        Ok(Shape::Dented(body)) => {
            row.facets = Some(body.facets.len());
            MeshStone::new(&body.mesh())
                .map_err(|e| e.to_string())
                .and_then(|stone| fill_dented(&mut row, &stone, subject, plan).map_err(|e| e.to_string()))
        }
        Err(why) => Err(why.clone()),
    };
    if let Err(why) = filled {
        row.error = Some(why);
    }
    row
}

/// Scores stones one after the other, each on all threads.
pub fn score_all(subjects: &[Subject], plan: &Plan) -> Vec<Row> {
    subjects.iter().map(|s| score(s, plan)).collect()
}

fn fill(row: &mut Row, stone: &Stone, subject: &Subject, plan: &Plan) -> Result<(), ExperimentError> {
    let (medium, aspect) = (subject.medium(plan), subject.aspect());
    let sky = |own: f64| plan.sky(own);
    for (column, metric) in plan.metrics.iter().enumerate() {
        if let Reading::Solid(of) = metric.reading {
            row.scores[column] = of(&stone.solid).map(Estimate::exact);
            if row.scores[column].is_none() {
                row.leave_out(metric, NO_OUTLINE);
            }
        }
    }
    let exact = plan.exact && subject.material.is_clear();
    let table = stone.planes.iter().any(|p| Zone::of(p.normal) == Zone::Table);
    let mut sheet = Sheet { row, plan, exact, dented: false, table, unfinished: false };
    let (stop, wavelengths) = (plan.stop_power(), medium.wavelengths_a_point());
    sheet.fill("hemisphere", of_hemisphere, false, 1, || {
        Ok(Hemisphere::seen_from(stone, &medium, aspect)?.followed_to(stop))
    })?;
    let surroundings = plan.surroundings();
    sheet.fill("view", of_view, false, wavelengths, || {
        Ok(View::seen_from(stone, &medium, aspect, surroundings)?.followed_to(stop))
    })?;
    let iso = |r| if let Reading::Iso(f) = r { Some(f) } else { None };
    let head = sky(iso::OBSERVER_DEG);
    sheet.fill("iso", iso, false, 1, || Iso::seen_from(stone, &medium, aspect, head))?;
    let cells = sky(cells::OBSERVER_DEG);
    let contrast = |r| if let Reading::Contrast(f) = r { Some(f) } else { None };
    sheet.fill("contrast", contrast, false, CONTRAST_COST * wavelengths, || {
        Ok(Contrast::seen_from(stone, &medium, aspect, cells)?.followed_to(stop))
    })?;
    let scintillation = |r| if let Reading::Scintillation(f) = r { Some(f) } else { None };
    sheet.fill("scintillation", scintillation, false, ROCKING_COST * wavelengths, || {
        Ok(Scintillation::seen_from(stone, &medium, aspect, cells)?.followed_to(stop))
    })?;
    let beams = Beams::new(stone);
    let dispersive = subject.material.is_dispersive();
    if !dispersive {
        plan.metrics
            .iter()
            .filter(|m| m.needs_dispersion())
            .for_each(|m| sheet.row.leave_out(m, subject.material.no_dispersion()));
    } else if subject.material.is_clear() {
        // beams are nearly exact for one direction, and ten times as cheap as photons
        let fire = |r| of_beam(r).filter(|f| !Needs::of(f).faint);
        let readings = || plan.metrics.iter().filter_map(|m| fire(m.reading)).map(|f| Needs::of(&f));
        let needs = Needs { lit: readings().any(|needs| needs.lit), faint: false };
        sheet.finish("fire", fire, false, |w| fire::fire(&beams, &medium, aspect, needs, w))?;
        let colours = |r| of_beam(r).filter(|f| Needs::of(f).faint);
        sheet.fill("beam", colours, false, BEAM_COST, || {
            Ok(Beam::seen_from(stone, &medium, aspect)?.for_needs(Needs { lit: false, faint: true }))
        })?;
    } else {
        sheet.fill("beam", of_beam, false, BEAM_COST, || Beam::seen_from(stone, &medium, aspect))?;
    }
    if exact {
        let make = || Quadrature::seen_from(stone, &medium, aspect);
        sheet.fill("quadrature", of_hemisphere, true, DIRECTION_COST, make)?;
        let reads_strongest = |m: &&Metric| of_view(m.reading).is_some_and(|s| by_beams::reads_strongest(&s));
        let strongest = plan.metrics.iter().any(reads_strongest);
        sheet.finish("view by beams", of_view, true, |w| {
            by_beams::view(&beams, &medium, aspect, surroundings, strongest, w)
        })?;
        sheet
            .finish("iso by beams", iso, true, |_| Ok(vec![by_beams::iso(&beams, &medium, aspect, head)?]))?;
        if dispersive {
            sheet
                .finish("beam by beams", of_beam, true, |w| by_beams::colours(&beams, &medium, aspect, w))?;
        }
        sheet.unfinished = true;
        let finished = sheet.row.samples.len();
        sheet.fill("view", of_view, false, 1, || {
            Ok(View::seen_from(stone, &medium, aspect, surroundings)?.followed_to(stop))
        })?;
        if row.samples.len() > finished {
            // what beams did not give photons have
            let scored = |name: &str| {
                plan.metrics.iter().zip(&row.scores).any(|(m, score)| m.name == name && score.is_some())
            };
            row.left_out.retain(|(name, _)| !scored(name));
            row.note = Some(TOO_MANY_BEAMS);
        }
    } else if plan.exact && plan.metrics.iter().any(|m| m.by_beams) {
        row.note = Some(NO_BEAMS_IN_COLOUR);
    }
    Ok(())
}

/// Notes of rows that have photons where beams were asked for.
const TOO_MANY_BEAMS: &str =
    "too many beams to follow each point's strongest path: by photons, with their error";
const NO_BEAMS_IN_COLOUR: &str = "beams do not follow absorption: --exact has no effect on a coloured stone";
const NO_BEAMS_IN_DENTS: &str = "beams need a convex stone: --exact has no effect on this one";

/// The scores of a stone that is not convex.
fn fill_dented(
    row: &mut Row,
    stone: &MeshStone,
    subject: &Subject,
    plan: &Plan,
) -> Result<(), ExperimentError> {
    let (medium, aspect) = (subject.medium(plan), subject.aspect());
    plan.metrics.iter().filter(|m| !m.dented).for_each(|m| row.leave_out(m, DENTED));
    if plan.exact && plan.metrics.iter().any(|m| m.by_beams && m.dented) {
        row.note = Some(NO_BEAMS_IN_DENTS);
    }
    let mut sheet = Sheet { row, plan, exact: false, dented: true, table: true, unfinished: false };
    sheet.fill("hemisphere", of_hemisphere, false, DENTED_COST, || {
        Ok(dented::Dome::new(stone, &medium, aspect)?.followed_to(plan.stop_power()))
    })?;
    sheet.fill("view", of_view, false, DENTED_COST, || {
        let gaze = dented::Gaze::new(stone, &medium, aspect, plan.surroundings())?;
        Ok(gaze.followed_to(plan.stop_power()))
    })
}

fn of_hemisphere(reading: Reading) -> Option<Statistic<hemisphere::Tally>> {
    if let Reading::Hemisphere(f) = reading { Some(f) } else { None }
}

fn of_beam(reading: Reading) -> Option<Statistic<beam::Tally>> {
    if let Reading::Beam(f) = reading { Some(f) } else { None }
}

fn of_view(reading: Reading) -> Option<Statistic<view::Tally>> {
    if let Reading::View(f) = reading { Some(f) } else { None }
}

impl Plan {
    /// The share of a ray's light below which it is given up: no more than half of an error that is
    /// asked for, so that what is given up does not stand in the way of it.
    fn stop_power(&self) -> f32 {
        /// Below this the roundings of `f32` count for as much.
        const LEAST: f32 = 1e-8;
        match self.effort {
            Effort::Samples(_) => STOP_POWER,
            Effort::Error(target) => ((0.5 * target) as f32).clamp(LEAST, STOP_POWER),
        }
    }

    /// The dome of a metric whose own observer has a cone of half-angle `own`, in degrees.
    fn sky(&self, own: f64) -> Sky {
        Sky::behind(self.observer.unwrap_or(own))
    }

    fn surroundings(&self) -> Surroundings {
        Surroundings { scope: self.sky(view::SCOPE_DEG), dome: self.sky(view::OBSERVER_DEG) }
    }
}

impl Subject {
    fn medium(&self, plan: &Plan) -> Medium<'_> {
        Medium { material: &self.material, polarised: plan.polarised }
    }

    fn aspect(&self) -> Aspect {
        self.tilt.map_or(Aspect::FACE_UP, |t| Aspect::tilted(t.degrees, t.azimuth))
    }
}
