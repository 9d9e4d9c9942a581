//! What was paid for what: objectives, other scores and proportions before and after.

use super::headline;
use super::kept::KeptDesign;
use crate::design::edit::MeasureChange;
use crate::metrics::{Better, Metric};
use crate::optimise::OptimiseRequest;
use crate::report::estimates::{difference_html, estimate_html};
use crate::sampling::stats::Estimate;
use crate::scoring::comparison::Comparison;
use crate::scoring::constraint::Quantity;
use crate::scoring::gain::Gain;
use crate::scoring::objective::{Aim, Objective, TiltedMetric};
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

/// The scores beside the objectives: [`ALWAYS`], and those that are bounded, without face-up objectives.
pub(super) fn metrics(request: &OptimiseRequest) -> Vec<&'static Metric> {
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
///
/// - `comparison`: of the start and the designs, in these `metrics`
pub(super) fn section(
    request: &OptimiseRequest,
    kept: &[KeptDesign],
    metrics: &[&'static Metric],
    comparison: &Comparison,
) -> Markup {
    let groups = [
        ("Objectives", objectives(request, kept)),
        ("Other scores, face-up", scores(metrics, comparison)),
        ("Proportions", proportions(kept)),
    ];
    html! {
        section {
            h2 { "What was paid for what" }
            div class="wide" {
                table class="versus price" {
                    thead { tr { th {} th { "start" } @for design in kept { th { (design.label) } } } }
                    "\n"
                    @for (name, rows) in &groups {
                        tbody {
                            tr { th class="group" colspan=(kept.len() + 2) { (name) } }
                            @for row in rows { (row.html()) }
                        }
                    }
                }
            }
            p class="note" {
                "Below each value stands its difference from the start, by the same random numbers; after ± one \
                 standard error. Scores are better or worse where the difference is beyond three of its errors and \
                 not negligible, and the score has a better side; else they differ. Proportions are exact, lengths in \
                 percent of the width."
                @if let Some(why) = comparison.rows.first().and_then(|row| row.omissions()) { " " (why) "." }
            }
        }
        "\n"
    }
}

impl Row {
    fn html(&self) -> Markup {
        html! {
            tr title=(self.about) {
                th scope="row" {
                    (self.name)
                    @if !self.unit.is_empty() { " " span class="se" { "(" (self.unit) ")" } }
                }
                td class="value" { (self.start) }
                @for cell in &self.cells {
                    td class={ "value " (cell.class()) } {
                        (cell.value)
                        span class="change" { (cell.difference) }
                        span class="said" { (cell.said) }
                    }
                }
            }
            "\n"
        }
    }
}

impl Cell {
    fn class(&self) -> &'static str {
        match self.said {
            "better" => "gain",
            "worse" => "loss",
            "not significant" => "same",
            _ => "",
        }
    }
}

/// The objectives, with their gains by fresh random numbers.
fn objectives(request: &OptimiseRequest, kept: &[KeptDesign]) -> Vec<Row> {
    let row = |(i, of): (usize, &Objective)| {
        let gains = || kept.iter().filter_map(|design| design.finalist.gains.get(i));
        let cell = |gain: &Gain| {
            let difference = Estimate { value: of.aim.sign() * gain.gain.value, ..gain.gain };
            Cell {
                value: estimate_html(Some(gain.value), ""),
                difference: difference_html(Some(difference)),
                said: said(Some(gain.is_significant), gain.gain.value),
            }
        };
        Row {
            name: of.name(),
            about: format!(
                "{}; {} was wanted",
                of.of.metric.about,
                if of.aim == Aim::Maximise { "more" } else { "less" }
            ),
            unit: of.of.metric.unit,
            start: estimate_html(gains().next().map(|gain| gain.start), ""),
            cells: gains().map(cell).collect(),
        }
    };
    request.objectives.iter().enumerate().map(row).collect()
}

/// The other scores; without those that the stone does not have.
fn scores(metrics: &[&'static Metric], comparison: &Comparison) -> Vec<Row> {
    let row = |(m, metric): (usize, &&'static Metric)| {
        let start = comparison.rows.first().and_then(|row| row.scores[m])?;
        let cell = |(other, differences): (usize, &Vec<Option<Estimate>>)| {
            let difference = differences[m];
            let significant = comparison.is_significant(other, m);
            let value = difference.map_or(0.0, |d| d.value);
            Cell {
                value: estimate_html(comparison.rows[other + 1].scores[m], ""),
                difference: difference_html(difference),
                said: match metric.better {
                    Better::More => said(significant, value),
                    Better::Less => said(significant, -value),
                    Better::Neither if significant == Some(true) => "differs",
                    Better::Neither => said(significant, value),
                },
            }
        };
        Some(Row {
            name: metric.name.into(),
            about: metric.about_and_better(),
            unit: metric.unit,
            start: estimate_html(Some(start), ""),
            cells: comparison.differences.iter().enumerate().map(cell).collect(),
        })
    };
    metrics.iter().enumerate().filter_map(row).collect()
}

/// - `gain`: positive for the better
fn said(significant: Option<bool>, gain: f64) -> &'static str {
    match significant {
        Some(true) if gain > 0.0 => "better",
        Some(true) => "worse",
        Some(false) => "not significant",
        None => "",
    }
}

/// The proportions, which have no error.
fn proportions(kept: &[KeptDesign]) -> Vec<Row> {
    let Some(first) = kept.first() else { return Vec::new() };
    let row = |(i, measure): (usize, &MeasureChange)| {
        let decimals = if measure.name == "volume_w3" { 4 } else { 2 };
        let shown = |value: Option<f64>| html! { (value.map_or("–".into(), |v| format!("{v:.decimals$}"))) };
        let cell = |design: &KeptDesign| {
            let own = &design.changes.measures[i];
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
            cells: kept.iter().map(cell).collect(),
        }
    };
    first.changes.measures.iter().enumerate().map(row).collect()
}
