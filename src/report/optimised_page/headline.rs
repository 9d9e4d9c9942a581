//! The head of an optimisation's page: what each design that was kept gains, what was asked for, what varied.

use super::kept::KeptDesign;
use crate::optimise::{Degree, OptimiseRequest, Optimised};
use crate::parse::format_number;
use crate::sampling::stats::Estimate;
use crate::scoring::constraint::{Bound, Constraint, Side};
use crate::scoring::gain::Gain;
use crate::scoring::objective::{Aim, Objective};
use crate::search::Method;
use maud::{Markup, html};

/// The objectives in words: `more iso@0,10 and less spread`.
pub(super) fn objectives(request: &OptimiseRequest) -> String {
    let said = |objective: &Objective| {
        let way = if objective.aim == Aim::Maximise { "more" } else { "less" };
        format!("{way} {}", objective.name())
    };
    let all: Vec<String> = request.objectives.iter().map(said).collect();
    match &all[..] {
        [rest @ .., last] if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => all.concat(),
    }
}

/// Half-angle in degrees of the observer's dark cone that objectives are taken with; none for each metric's own.
pub(super) fn observer(request: &OptimiseRequest) -> Option<f64> {
    request.objectives.iter().find_map(|objective| objective.of.observer)
}

/// What each design gains, in words.
pub(super) fn verdicts(request: &OptimiseRequest, kept: &[KeptDesign]) -> Markup {
    html! {
        section {
            h2 { "Result" }
            ul class="verdicts" {
                @for design in kept {
                    li {
                        (link(design))
                        ": "
                        @for (i, (of, gain)) in request.objectives.iter().zip(&design.finalist.gains).enumerate() {
                            @if i > 0 { "; " }
                            (of.name()) " " b { (estimate(gain.value)) (unit(of.of.metric.unit)) } ", "
                            (verdict(gain))
                        }
                    }
                    "\n"
                }
            }
            p class="note" {
                "The designs were scored again with random numbers that the search had not seen, the start with \
                 the same ones. After ± stands one standard error; a difference is called significant if it is \
                 beyond three of its errors and not negligible."
            }
        }
        "\n"
    }
}

/// What a design is called, with a link to its file.
pub(super) fn link(design: &KeptDesign) -> Markup {
    html! {
        @if let Some(file) = design.file { a href=(file) { (design.label) } } @else { b { (design.label) } }
    }
}

/// A gain against the start in words.
fn verdict(gain: &Gain) -> String {
    let size = estimate(Estimate { value: gain.gain.value.abs(), ..gain.gain });
    let from = estimate(gain.start);
    let way = if gain.gain.value < 0.0 { "worse" } else { "better" };
    if gain.gain == Estimate::exact(0.0) {
        return "as the start".to_owned();
    }
    format!("{size} {way} than the start’s {from} ({})", gain.said())
}

fn estimate(of: Estimate) -> String {
    of.to_string().replace('-', "−")
}

fn unit(unit: &str) -> String {
    if matches!(unit, "" | "°") { unit.to_owned() } else { format!("\u{a0}{unit}") }
}

/// What was asked for, and how it was searched.
pub(super) fn request(request: &OptimiseRequest, found: &Optimised) -> Markup {
    let feasible = found.candidates.iter().filter(|c| c.outcome.is_feasible()).count();
    let bounds: Vec<String> = request.constraints.iter().map(bound).collect();
    let guards = &request.guards;
    let method = request.method.unwrap_or(Method::BEST);
    let observer = match observer(request) {
        Some(degrees) => format!(", observer’s dark cone of {}° to each side", format_number(degrees)),
        None => String::new(),
    };
    let facts = [
        ("objectives", objectives(request) + &observer),
        ("bounds", if bounds.is_empty() { "none but those always on".into() } else { bounds.join("; ") }),
        (
            "always on",
            format!(
                "closed and convex, no facet lost; no facet narrower than {} % of the width, unless it was; girdle \
                 at least {} of its thickness",
                format_number(guards.least_facet_percent),
                format_number(guards.least_girdle)
            ),
        ),
        ("candidates", format!("{}, of which {feasible} keep the bounds", found.candidates.len())),
        (
            "search",
            format!(
                "method {}, {} start{}, seed {}",
                method.name(),
                request.starts,
                if request.starts == 1 { "" } else { "s side by side" },
                request.seed
            ),
        ),
    ];
    html! {
        section {
            h2 { "What was asked for" }
            table class="facts" {
                tbody { @for (label, value) in facts { tr { th scope="row" { (label) } td { (value) } } "\n" } }
            }
        }
        "\n"
    }
}

/// A bound in words.
fn bound(constraint: &Constraint) -> String {
    let side = if constraint.side == Side::AtLeast { "at least" } else { "at most" };
    let of = constraint.of.name();
    match constraint.bound {
        Bound::Value(value) => format!("{of} {side} {}", format_number(value)),
        Bound::OfStart(times) => format!("{of} {side} {} × what the start has", format_number(times)),
    }
}

/// The variables: where they began, how far they could go, where each design has them.
pub(super) fn variables(found: &Optimised, kept: &[KeptDesign]) -> Markup {
    html! {
        section {
            h2 { "Variables" }
            div class="wide" {
                table class="versus" {
                    thead {
                        tr {
                            th {} th { "start" } th { "range" }
                            @for design in kept { th { (design.label) } }
                        }
                    }
                    "\n"
                    tbody {
                        @for (i, degree) in found.degrees.iter().enumerate() {
                            tr {
                                th scope="row" { (titled(degree)) }
                                td class="value" { (rounded(degree.start)) }
                                td class="value" {
                                    (rounded(*degree.range.start())) " to " (rounded(*degree.range.end()))
                                }
                                @for design in kept { (value(degree, design.finalist.values[i])) }
                            }
                            "\n"
                        }
                    }
                }
            }
            p class="note" {
                "Scales are ratios of tangents, depths and indices are added. A value at an end of its range \
                 says that a wider range may give more."
            }
        }
        "\n"
    }
}

/// A variable with its unit.
pub(super) fn titled(degree: &Degree) -> String {
    match degree.target.unit().sign() {
        "" => degree.name.clone(),
        sign => format!("{} ({sign})", degree.name),
    }
}

fn value(degree: &Degree, value: f64) -> Markup {
    let (from, to) = (*degree.range.start(), *degree.range.end());
    let near = 1e-6 * (to - from);
    let is_end = (value - from).abs() < near || (value - to).abs() < near;
    html! {
        td class="value" {
            b { (rounded(value)) }
            @if is_end { span class="se" { "end of its range" } }
        }
    }
}

/// A number as people read it.
fn rounded(value: f64) -> String {
    format_number((value * 1e4).round() / 1e4).replace('-', "−")
}
