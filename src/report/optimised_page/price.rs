//! What was paid for what: objectives, other scores and proportions before and after.

use super::headline;
use super::kept::KeptDesign;
use crate::design::edit::MeasureChange;
use crate::geometry::Polyhedron;
use crate::materials::Material;
use crate::metrics::{Better, Metric};
use crate::optimise::OptimiseRequest;
use crate::report::estimates::{difference_html, estimate_html};
use crate::sampling::stats::Estimate;
use crate::scoring::constraint::Quantity;
use crate::scoring::evaluator::Evaluator;
use crate::scoring::gain::Gain;
use crate::scoring::objective::{Aim, Objective, ObjectiveError, TiltedMetric};
use maud::{Markup, html};

/// Scores that stand on every page, whether they were asked for or not: light of the faceters' view and of the
/// hemisphere, its loss, fire, pattern, weight.
const ALWAYS: [&str; 9] = [
    "iso",
    "wlr",
    "leakage",
    "windowing",
    "fire_streak",
    "contrast",
    "scintillation",
    "spread",
    "weight_ratio",
];

/// One quantity of all designs.
struct Row {
    name: String,
    about: String,
    unit: &'static str,
    start: Markup,
    cells: Vec<Cell>,
}

/// A value after, and how it differs from the one before.
struct Cell {
    value: Markup,
    difference: Markup,
    /// `better`, `worse`, `differs`; `not significant`, or nothing to be said.
    said: &'static str,
}

/// Scores that were no objectives.
pub(super) struct OtherScores {
    metrics: Vec<&'static Metric>,
    /// Of each design one a metric; what is gained is the difference from the start.
    gains: Vec<Vec<Gain>>,
    /// What the stones do not have, and why.
    left_out: Vec<String>,
}

impl OtherScores {
    /// The scores of the kept designs beside the start, face-up, in the way of objectives: by fresh random
    /// numbers, the same for all stones.
    ///
    /// - `start`: the solid as it was
    pub(super) fn of(
        request: &OptimiseRequest,
        kept: &[KeptDesign],
        (material, start): (&Material, &Polyhedron),
        samples: u64,
    ) -> OtherScores {
        let mut scores = OtherScores { metrics: metrics(request), gains: Vec::new(), left_out: Vec::new() };
        let solids: Vec<Polyhedron> = kept.iter().map(|k| k.finalist.edited.solid.clone()).collect();
        let observer = headline::observer(request);
        while !scores.metrics.is_empty() {
            let of = |metric: &&'static Metric| {
                Objective::maximise(TiltedMetric { observer, ..TiltedMetric::new(metric) })
            };
            let objectives = scores.metrics.iter().map(of).collect();
            let effort = request.effort.samples(samples);
            let evaluator = Evaluator::new(objectives, Vec::new(), material, effort, start);
            match evaluator.and_then(|evaluator| evaluator.gains(start, &solids)) {
                Ok(gains) => {
                    scores.gains = gains;
                    break;
                }
                // one that a stone does not have goes; whatever else is wrong is wrong with all
                Err(error) => {
                    scores.left_out.push(format!("Left out: {error}."));
                    let before = scores.metrics.len();
                    if let ObjectiveError::NotMeasured { quantity, .. } = &error {
                        scores.metrics.retain(|metric| metric.name != quantity);
                    }
                    if scores.metrics.len() == before {
                        scores.metrics.clear();
                    }
                }
            }
        }
        scores
    }

    fn rows(&self) -> Vec<Row> {
        let row = |(m, metric): (usize, &&'static Metric)| {
            let gains = || self.gains.iter().map(|of_design| &of_design[m]);
            let cell = |gain: &Gain| {
                let said = match metric.better {
                    Better::More => said(gain, 1.0),
                    Better::Less => said(gain, -1.0),
                    Better::Neither if gain.is_significant => "differs",
                    Better::Neither => said(gain, 1.0),
                };
                Cell::of_gain(gain, 1.0, said)
            };
            Row {
                name: metric.name.into(),
                about: metric.about_and_better(),
                unit: metric.unit,
                start: estimate_html(gains().next().map(|gain| gain.start), ""),
                cells: gains().map(cell).collect(),
            }
        };
        self.metrics.iter().enumerate().map(row).collect()
    }
}

/// The metrics beside the objectives: [`ALWAYS`], and those that are bounded, without face-up objectives.
fn metrics(request: &OptimiseRequest) -> Vec<&'static Metric> {
    let bounded = request.constraints.iter().filter_map(|constraint| match &constraint.of {
        Quantity::Score(of) => Some(of.metric),
        _ => None,
    });
    let observer = headline::observer(request);
    let is_objective = |metric: &Metric| {
        let same = |o: &TiltedMetric| o.metric.name == metric.name && o.is_face_up();
        let seen_alike = |o: &TiltedMetric| o.observer == observer && o.material.is_none();
        request.objectives.iter().any(|o| same(&o.of) && seen_alike(&o.of))
    };
    let mut metrics: Vec<&'static Metric> = Vec::new();
    for metric in ALWAYS.iter().filter_map(|name| Metric::by_name(name)).chain(bounded) {
        if !is_objective(metric) && metrics.iter().all(|m| m.name != metric.name) {
            metrics.push(metric);
        }
    }
    metrics
}

/// The section.
pub(super) fn section(request: &OptimiseRequest, kept: &[KeptDesign], others: &OtherScores) -> Markup {
    let groups = [
        ("Objectives", objectives(request, kept)),
        ("Other scores, face-up", others.rows()),
        ("Proportions", proportions(kept)),
    ];
    // one design has room for columns of its own; of several each has one
    let is_one = kept.len() == 1;
    html! {
        section {
            h2 { "What was paid for what" }
            div class="wide" {
                table class="versus price" {
                    thead {
                        tr {
                            th {} th { "start" }
                            @for design in kept { th { (design.label) } }
                            @if is_one { th { "difference" } th {} }
                        }
                    }
                    "\n"
                    @for (name, rows) in groups.iter().filter(|(_, rows)| !rows.is_empty()) {
                        tbody {
                            tr { th class="group" colspan=(kept.len() + if is_one { 4 } else { 2 }) { (name) } }
                            @for row in rows { (row.html(is_one)) }
                        }
                    }
                }
            }
            p class="note" {
                @if !is_one { "Below each value stands its difference from the start. " }
                "Scores are by the same random numbers for all stones, with one standard error after ±. They are \
                 better or worse where the difference is beyond three of its errors and not negligible and the \
                 score has a better side; where it has none, they differ. Proportions are exact, lengths in percent \
                 of the width; those that are not listed did not change."
                @for why in &others.left_out { " " (why) }
            }
        }
        "\n"
    }
}

impl Row {
    /// - `in_columns`: whether value, difference and what is said of it have a column each
    fn html(&self, in_columns: bool) -> Markup {
        html! {
            tr title=(self.about) {
                th scope="row" {
                    (self.name)
                    @if !self.unit.is_empty() { " " span class="se" { "(" (self.unit) ")" } }
                }
                td class="value" { (self.start) }
                @for cell in &self.cells {
                    @let class = format!("value {}", cell.class());
                    @if in_columns {
                        td class="value" { (cell.value) }
                        td class=(class) { span class="change" { (cell.difference) } }
                        td class=(class) { span class="said" { (cell.said) } }
                    } @else {
                        td class=(class) {
                            (cell.value)
                            span class="change" { (cell.difference) }
                            span class="said" { (cell.said) }
                        }
                    }
                }
            }
            "\n"
        }
    }
}

impl Cell {
    /// - `sign`: of the difference where something is gained
    fn of_gain(gain: &Gain, sign: f64, said: &'static str) -> Cell {
        let difference = Estimate { value: sign * gain.gain.value, ..gain.gain };
        Cell {
            value: estimate_html(Some(gain.value), ""),
            difference: difference_html(Some(difference)),
            said,
        }
    }

    fn class(&self) -> &'static str {
        match self.said {
            "better" => "gain",
            "worse" => "loss",
            _ => "",
        }
    }
}

/// The objectives, with their gains by fresh random numbers.
fn objectives(request: &OptimiseRequest, kept: &[KeptDesign]) -> Vec<Row> {
    let row = |(i, of): (usize, &Objective)| {
        let gains = || kept.iter().filter_map(|design| design.finalist.gains.get(i));
        let wanted = if of.aim == Aim::Maximise { "more" } else { "less" };
        Row {
            name: of.name(),
            about: format!("{}; {wanted} was wanted", of.of.metric.about),
            unit: of.of.metric.unit,
            start: estimate_html(gains().next().map(|gain| gain.start), ""),
            cells: gains().map(|gain| Cell::of_gain(gain, of.aim.sign(), said(gain, 1.0))).collect(),
        }
    };
    request.objectives.iter().enumerate().map(row).collect()
}

/// - `sign`: of a gain that is for the better
fn said(gain: &Gain, sign: f64) -> &'static str {
    match gain.is_significant {
        true if sign * gain.gain.value > 0.0 => "better",
        true => "worse",
        false => "not significant",
    }
}

/// The proportions that changed in a design. They have no error.
fn proportions(kept: &[KeptDesign]) -> Vec<Row> {
    let Some(first) = kept.first() else { return Vec::new() };
    let changes = |i: usize| kept.iter().map(move |design| &design.changes.measures[i]);
    let row = |(i, measure): (usize, &MeasureChange)| {
        let decimals = if measure.name == "volume_w3" { 4 } else { 2 };
        let shown = |value: Option<f64>| html! { (value.map_or("–".into(), |v| format!("{v:.decimals$}"))) };
        let cell = |own: &MeasureChange| {
            let difference = own.value.before.zip(own.value.after).map(|(was, is)| is - was);
            let text = difference.filter(|_| own.is_changed()).map(|d| format!("{d:+.decimals$}"));
            Cell {
                value: html! { b { (shown(own.value.after)) } },
                difference: html! { (text.unwrap_or_else(|| "unchanged".into()).replace('-', "−")) },
                said: "",
            }
        };
        Row {
            name: measure.name.replace('_', " "),
            about: String::new(),
            unit: measure.unit,
            start: html! { b { (shown(measure.value.before)) } },
            cells: changes(i).map(cell).collect(),
        }
    };
    let all = first.changes.measures.iter().enumerate();
    all.filter(|(i, _)| changes(*i).any(MeasureChange::is_changed)).map(row).collect()
}
