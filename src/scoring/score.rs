//! Scores of stones: which estimators to run, how long, and one row a stone.

use super::adaptive::ScoreAccumulator;
pub use super::settings::{
    DEFAULT_SAMPLES, MAX_SAMPLES, ScoreInput, ScoreRequest, ScoreRow, StoneShape, Target, Tilt,
};
use crate::design::Zone;
use crate::estimators::nonconvex::NonconvexView;
use crate::estimators::point_light::PointLightNeeds;
use crate::estimators::view::{ObserverDome, ViewerLighting};
use crate::estimators::{
    Contrast, EstimatorError, FaceterView, Hemisphere, PointLight, Quadrature, STOP_POWER, Scintillation,
    TraceOptics, View, ViewFrame, beam_tallies, faceter_view, fire, hemisphere, nonconvex, pixel_cells,
    point_light, view,
};
use crate::metrics::{Metric, MetricSource, Statistic};
use crate::sampling::stats::Estimate;
use crate::trace::ConvexStone;
use crate::trace::beams::Beams;
use crate::trace::nonconvex::MeshStone;

/// So many points of the hemisphere are as dear as one of the beam, which has six lines and follows
/// paths to a hundredth of the power; what a given number of samples is divided by for the beam.
const BEAM_COST: u64 = 4;

/// The same for a cell of two points.
const CONTRAST_COST: u64 = 2;

/// The same for a cell of one to a thousand points, three on average, seen twice.
const ROCKING_COST: u64 = 6;

/// The same for a ray of a stone that is not convex.
const NONCONVEX_COST: u64 = 16;

/// The same for a direction of the dome that is followed by beams.
const DIRECTION_COST: u64 = 256;

/// Why scores that look at single rays are left out.
const NONCONVEX: &str = "not known for stones that are not convex";

/// Why scores that compare with the Tolkowsky stone are left out.
const NO_OUTLINE: &str = "the stone has no outline to compare";

/// Scores one stone.
///
/// The result is a pure function of subject and plan: the number of threads shows in no bit.
/// Never fails; a stone that cannot be scored says so in [`ScoreRow::error`].
/// Checked against published and reference figures in `tests/scores.rs`.
pub fn score(subject: &ScoreInput, plan: &ScoreRequest) -> ScoreRow {
    let mut row = ScoreRow {
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
        Ok(StoneShape::Convex(solid)) => {
            let stone = ConvexStone::new(solid.clone());
            row.facets = Some(stone.facet_count());
            fill(&mut row, &stone, subject, plan).map_err(|e| e.to_string())
        }
        Ok(StoneShape::Nonconvex(_)) if !plan.metrics.iter().any(|m| m.nonconvex) => {
            Err("not convex: it has none of the scores asked for (cutlab list metrics tells which it has)"
                .into())
        }
        Ok(StoneShape::Nonconvex(body)) => {
            row.facets = Some(body.facets.len());
            MeshStone::new(&body.mesh())
                .map_err(|e| e.to_string())
                .and_then(|stone| fill_nonconvex(&mut row, &stone, subject, plan).map_err(|e| e.to_string()))
        }
        Err(why) => Err(why.clone()),
    };
    if let Err(why) = filled {
        row.error = Some(why);
    }
    row
}

/// Scores stones one after the other, each on all threads.
pub fn score_all(subjects: &[ScoreInput], plan: &ScoreRequest) -> Vec<ScoreRow> {
    subjects.iter().map(|s| score(s, plan)).collect()
}

fn fill(
    row: &mut ScoreRow,
    stone: &ConvexStone,
    subject: &ScoreInput,
    plan: &ScoreRequest,
) -> Result<(), EstimatorError> {
    let (medium, view_frame) = (subject.medium(plan), subject.view_frame());
    let sky = |own: f64| plan.sky(own);
    for (column, metric) in plan.metrics.iter().enumerate() {
        if let MetricSource::Solid(of) = metric.read_from {
            row.scores[column] = of(&stone.solid).map(Estimate::exact);
            if row.scores[column].is_none() {
                row.leave_out(metric, NO_OUTLINE);
            }
        }
    }
    let exact = plan.exact && subject.material.is_clear();
    let table = stone.planes.iter().any(|p| Zone::from_normal(p.normal) == Zone::Table);
    let mut sheet = ScoreAccumulator { row, plan, exact, nonconvex: false, table, unfinished: false };
    let (stop, wavelengths) = (plan.stop_power(), medium.wavelengths_per_point());
    sheet.fill("hemisphere", hemisphere_statistic, false, 1, || {
        Ok(Hemisphere::in_frame(stone, &medium, view_frame)?.with_stop_power(stop))
    })?;
    sheet.fill("view", view_statistic, false, wavelengths, || subject.view(stone, plan))?;
    let iso = |r| if let MetricSource::FaceterView(f) = r { Some(f) } else { None };
    let head = sky(faceter_view::GEMRAY_OBSERVER_DEG);
    sheet.fill("iso", iso, false, 1, || FaceterView::in_frame(stone, &medium, view_frame, head))?;
    let cells = sky(pixel_cells::AGS_OBSERVER_DEG);
    let contrast = |r| if let MetricSource::Contrast(f) = r { Some(f) } else { None };
    sheet.fill("contrast", contrast, false, CONTRAST_COST * wavelengths, || {
        Ok(Contrast::in_frame(stone, &medium, view_frame, cells)?.with_stop_power(stop))
    })?;
    let scintillation = |r| if let MetricSource::Scintillation(f) = r { Some(f) } else { None };
    sheet.fill("scintillation", scintillation, false, ROCKING_COST * wavelengths, || {
        Ok(Scintillation::in_frame(stone, &medium, view_frame, cells)?.with_stop_power(stop))
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
        let fire = |r| point_light_statistic(r).filter(|f| !PointLightNeeds::from_statistic(f).faint);
        let readings = || {
            plan.metrics.iter().filter_map(|m| fire(m.read_from)).map(|f| PointLightNeeds::from_statistic(&f))
        };
        let needs = PointLightNeeds { lit: readings().any(|needs| needs.lit), faint: false };
        sheet.finish("fire", fire, false, |w| fire::fire(&beams, &medium, view_frame, needs, w))?;
        let colours = |r| point_light_statistic(r).filter(|f| PointLightNeeds::from_statistic(f).faint);
        sheet.fill("beam", colours, false, BEAM_COST, || {
            Ok(PointLight::in_frame(stone, &medium, view_frame)?
                .for_needs(PointLightNeeds { lit: false, faint: true }))
        })?;
    } else {
        sheet.fill("beam", point_light_statistic, false, BEAM_COST, || {
            PointLight::in_frame(stone, &medium, view_frame)
        })?;
    }
    if exact {
        let make = || Quadrature::in_frame(stone, &medium, view_frame);
        sheet.fill("quadrature", hemisphere_statistic, true, DIRECTION_COST, make)?;
        let reads_strongest =
            |m: &&Metric| view_statistic(m.read_from).is_some_and(|s| beam_tallies::needs_strongest_path(&s));
        let strongest = plan.metrics.iter().any(reads_strongest);
        sheet.finish("view by beams", view_statistic, true, |w| {
            beam_tallies::view(&beams, &medium, view_frame, plan.surroundings(), strongest, w)
        })?;
        sheet.finish("iso by beams", iso, true, |_| {
            Ok(vec![beam_tallies::iso(&beams, &medium, view_frame, head)?])
        })?;
        if dispersive {
            sheet.finish("beam by beams", point_light_statistic, true, |w| {
                beam_tallies::colours(&beams, &medium, view_frame, w)
            })?;
        }
        sheet.unfinished = true;
        let finished = sheet.row.samples.len();
        sheet.fill("view", view_statistic, false, 1, || subject.view(stone, plan))?;
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
const NO_BEAMS_IN_NONCONVEX: &str = "beams need a convex stone: --exact has no effect on this one";

/// The scores of a stone that is not convex.
fn fill_nonconvex(
    row: &mut ScoreRow,
    stone: &MeshStone,
    subject: &ScoreInput,
    plan: &ScoreRequest,
) -> Result<(), EstimatorError> {
    let (medium, view_frame) = (subject.medium(plan), subject.view_frame());
    plan.metrics.iter().filter(|m| !m.nonconvex).for_each(|m| row.leave_out(m, NONCONVEX));
    if plan.exact && plan.metrics.iter().any(|m| m.by_beams && m.nonconvex) {
        row.note = Some(NO_BEAMS_IN_NONCONVEX);
    }
    let mut sheet =
        ScoreAccumulator { row, plan, exact: false, nonconvex: true, table: true, unfinished: false };
    sheet.fill("hemisphere", hemisphere_statistic, false, NONCONVEX_COST, || {
        Ok(nonconvex::NonconvexHemisphere::new(stone, &medium, view_frame)?
            .with_stop_power(plan.stop_power()))
    })?;
    sheet.fill("view", view_statistic, false, NONCONVEX_COST, || subject.nonconvex_view(stone, plan))
}

fn hemisphere_statistic(reading: MetricSource) -> Option<Statistic<hemisphere::HemisphereTally>> {
    if let MetricSource::Hemisphere(f) = reading { Some(f) } else { None }
}

fn point_light_statistic(reading: MetricSource) -> Option<Statistic<point_light::PointLightTally>> {
    if let MetricSource::PointLight(f) = reading { Some(f) } else { None }
}

fn view_statistic(reading: MetricSource) -> Option<Statistic<view::ViewTally>> {
    if let MetricSource::View(f) = reading { Some(f) } else { None }
}

impl ScoreRequest {
    /// The share of a ray's light below which it is given up: no more than half of an error that is
    /// asked for, so that what is given up does not stand in the way of it.
    fn stop_power(&self) -> f32 {
        /// Below this the roundings of `f32` count for as much.
        const LEAST: f32 = 1e-8;
        match self.target {
            Target::Samples(_) => STOP_POWER,
            Target::Error(target) => ((0.5 * target) as f32).clamp(LEAST, STOP_POWER),
        }
    }

    /// The dome of a metric whose own observer has a cone of half-angle `own`, in degrees.
    fn sky(&self, own: f64) -> ObserverDome {
        ObserverDome::with_observer(self.observer.unwrap_or(own))
    }

    fn surroundings(&self) -> ViewerLighting {
        ViewerLighting { scope: self.sky(view::SCOPE_DEG), dome: self.sky(view::GIA_OBSERVER_DEG) }
    }
}

impl ScoreInput {
    /// The optics that the stone is scored with.
    pub fn medium(&self, plan: &ScoreRequest) -> TraceOptics<'_> {
        TraceOptics { material: &self.material, polarised: plan.polarised }
    }

    /// The view that the stone is scored by.
    pub fn view<'a>(&self, stone: &'a ConvexStone, plan: &ScoreRequest) -> Result<View<'a>, EstimatorError> {
        let view = View::in_frame(stone, &self.medium(plan), self.view_frame(), plan.surroundings())?;
        Ok(view.with_stop_power(plan.stop_power()))
    }

    /// The same of a stone that is not convex.
    pub fn nonconvex_view<'a>(
        &self,
        stone: &'a MeshStone,
        plan: &ScoreRequest,
    ) -> Result<NonconvexView<'a>, EstimatorError> {
        let view = NonconvexView::new(stone, &self.medium(plan), self.view_frame(), plan.surroundings())?;
        Ok(view.with_stop_power(plan.stop_power()))
    }

    fn view_frame(&self) -> ViewFrame {
        self.tilt.map_or(ViewFrame::FACE_UP, |t| ViewFrame::tilted(t.degrees, t.azimuth))
    }
}
