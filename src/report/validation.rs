//! The page of a validation: what was expected, what came out, where the two are apart.

use super::html::HtmlPage;
use super::plot::{Curves, Dot, PlotCurve};
use super::svg_canvas::{Element, PathData};
use crate::batch::validate::{Axes, CheckReport, ERRORS, Expected, Figure, FigureOutcome, Verdict};
use crate::sampling::stats::Estimate;
use maud::{Markup, html};

const STYLE: &str = include_str!("validation.css");

/// The rule by which a figure passes, in words.
pub fn rule() -> String {
    format!(
        "A figure passes if ours lies within its tolerance and {ERRORS} standard errors of ours; a bound is to \
         be kept by {ERRORS} errors. The tolerance is what the source says its figure is good for, or half a \
         unit or a unit of its last digit. A figure that does not come out stays in the table."
    )
}

/// How a number is written whose error or tolerance is known.
pub fn written(ours: Estimate, tolerance: Option<f64>) -> String {
    let digits = |unit: f64| (1.0 - unit.log10().floor()).clamp(0.0, 9.0) as usize;
    if ours.error > 0.0 && ours.error < 1e-5 && ours.value.abs() > 1e-4 {
        return format!("{:.1$} ± {2:.0e}", ours.value, digits(ours.error), ours.error);
    }
    match (ours.text(), tolerance) {
        ((value, Some(error)), _) => format!("{value} ± {error}"),
        (_, Some(tolerance)) if tolerance > 0.0 => {
            let text = format!("{:.1$}", ours.value, digits(tolerance));
            if ours.value != 0.0 && text.trim_start_matches('-').chars().all(|c| "0.".contains(c)) {
                format!("{:.1e}", ours.value)
            } else {
                text
            }
        }
        (_, Some(_)) => format!("{}", ours.value),
        ((value, None), None) => value,
    }
}

/// The expectation of a figure.
pub fn expectation(figure: &Figure) -> String {
    let plain = |x: f64| {
        let small = x != 0.0 && x.abs() < 1e-4;
        if small { format!("{x:.0e}") } else { format!("{}", (x * 1e6).round() / 1e6) }
    };
    match figure.expected {
        Expected::Near(value, tolerance) if tolerance > 0.0 => {
            format!("{} ± {}", plain(value), plain(tolerance))
        }
        Expected::Near(value, _) => plain(value),
        bound => format!("{} {}", bound.relation(), plain(bound.value())),
    }
}

/// Words after a number: its unit.
fn with_unit(text: &str, unit: &str) -> String {
    if unit.is_empty() { text.into() } else { format!("{text} {unit}") }
}

/// How many figures have a verdict.
pub fn count(reports: &[CheckReport], verdict: Verdict) -> usize {
    reports.iter().flat_map(|r| &r.outcomes).filter(|o| o.verdict == verdict).count()
}

/// The whole page.
///
/// - `seed`, `command`: what it was made with
///
/// Looked at in `reports/validation.html`.
pub fn html(reports: &[CheckReport], seed: u64, command: &str) -> String {
    let outcomes = || reports.iter().flat_map(|r| &r.outcomes);
    let failed: Vec<&FigureOutcome> = outcomes().filter(|o| o.verdict == Verdict::Failed).collect();
    let mut subjects: Vec<&str> = Vec::new();
    for outcome in outcomes() {
        if !subjects.contains(&outcome.subject) {
            subjects.push(outcome.subject);
        }
    }
    let content = html! {
        section class="verdicts" {
            @for verdict in [Verdict::Passed, Verdict::Failed, Verdict::Skipped] {
                div class="tile" { dl { dt { (verdict.to_string()) } dd { b { (count(reports, verdict)) } } } }
            }
        }
        "\n"
        p { (rule()) }
        p class="note" {
            "published: stands in a publication; derived: follows from a definition; cross-checked: computed by a \
             tracer that has nothing in common with this program, and no literature. Light is unpolarised at \
             every facet, as in the tracers that the figures are from. After ± stands the tolerance of an \
             expectation, one standard error of ours. The bars show ours between the limits within which it \
             passes. Not here: photon-mapped pictures, whose energy and convergence the tests check."
        }
        "\n"
        @if !failed.is_empty() { (table("What did not come out", &failed)) }
        (plots(reports))
        @for subject in subjects {
            (table(subject, &outcomes().filter(|o| o.subject == subject).collect::<Vec<_>>()))
        }
    };
    let footer = html! {
        p { "Seed " (seed) ". The same in numbers: " a href="validation.csv" { "validation.csv" } }
        "\n"
    };
    let page = HtmlPage {
        title: "Validation",
        subtitle: "Published and derivable figures about cut stones, beside what cutlab computes",
        style: STYLE,
        content,
        footer,
        command,
    };
    page.html()
}

fn plots(reports: &[CheckReport]) -> Markup {
    let drawn = reports.iter().filter(|r| !r.line.is_empty()).filter_map(|r| Some((r, r.plot?)));
    html! {
        section class="curves" {
            @for (i, (report, axes)) in drawn.enumerate() {
                figure { (plot(report, axes).drawing(&format!("plot{i}"))) } "\n"
            }
        }
        "\n"
    }
}

fn plot(report: &CheckReport, axes: Axes) -> Curves {
    let dot = |o: &FigureOutcome| match o.figure.expected {
        Expected::Near(value, tolerance) => {
            Some(Dot { x: o.figure.at?, value, tolerance, hollow: o.verdict == Verdict::Failed })
        }
        _ => None,
    };
    let points = report.line.iter().map(|(x, e)| (*x, Some((e.value, e.error)))).collect();
    Curves {
        title: axes.title.into(),
        note: "line: ours, with its band of 95 in 100; dots: expected, with their tolerance, hollow where it is not met"
            .into(),
        x: axes.x.into(),
        y: axes.y.into(),
        curves: vec![PlotCurve { name: String::new(), points }],
        small: false,
        dots: report.outcomes.iter().filter_map(dot).collect(),
        ..Curves::default()
    }
}

fn table(subject: &str, outcomes: &[&FigureOutcome]) -> Markup {
    html! {
        section {
            h2 { (subject) }
            div class="wide" {
                table class="figures" {
                    thead {
                        tr {
                            th { "figure" } th { "source" } th { "expected" } th { "ours" } th {}
                            th { "verdict" }
                        }
                    }
                    "\n"
                    tbody { @for outcome in outcomes { (table_row(outcome)) } }
                }
            }
        }
        "\n"
    }
}

fn table_row(o: &FigureOutcome) -> Markup {
    let f = &o.figure;
    let ours = o.ours.map_or("–".into(), |e| with_unit(&written(e, f.expected.tolerance()), f.unit));
    html! {
        tr class=[(!o.why.is_empty()).then_some("has-why")] {
            th scope="row" { (f.name) }
            td class="source" { (f.source.kind.to_string()) ": " (f.source.name) }
            td class="value" { (with_unit(&expectation(f), f.unit)) }
            td class="value" { (ours) }
            td { @if let Some(bar) = o.ours.and_then(|e| bar(f.expected, e)) { (bar) } }
            td class=(o.verdict.to_string()) { (o.verdict.to_string()) }
        }
        "\n"
        @if !o.why.is_empty() {
            tr class="why" { td colspan="6" { (o.why) } } "\n"
        }
    }
}

/// Where ours lies between the limits: a strip for what passes, a dot with two standard errors. None of an
/// expectation without a tolerance.
fn bar(expected: Expected, ours: Estimate) -> Option<Element> {
    let tolerance = expected.tolerance()?;
    /// The strip reaches so far to either side of the middle, the drawing half as far again.
    const REACH: f64 = 44.0;
    let limit = (tolerance + ERRORS * ours.error).max(f64::MIN_POSITIVE);
    let along = |x: f64| (68.0 + REACH * x / limit).clamp(4.0, 132.0);
    let off = ours.value - expected.value();
    let (x, low, high) = (along(off), along(off - 2.0 * ours.error), along(off + 2.0 * ours.error));
    let colour = if expected.is_met(ours) { "#0072b2" } else { "#d55e00" };
    let path = || PathData::new(1);
    Some(
        Element::drawing((0.0, 0.0), (136.0, 18.0))
            .with(Element::rect((24.0, 4.0), (2.0 * REACH, 10.0)).fill("#e6ecf1"))
            .with(Element::path(path().down((68.0, 3.0), 12.0)).stroke("#9aa5af", 1.0))
            .with(Element::path(path().line([(low, 9.0), (high, 9.0)])).stroke(colour, 1.5))
            .with(Element::circle((x, 9.0), 3.2).fill(colour)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_that_their_tolerance_tells() {
        let exact = |x| Estimate::exact(x);
        assert_eq!(written(exact(21.504_87), Some(0.005)), "21.5049");
        assert_eq!(written(exact(153.0), Some(0.0)), "153");
        assert_eq!(written(exact(3e-14), Some(1e-9)), "3.0e-14");
        assert_eq!(written(Estimate { value: 0.283_1, error: 0.000_3 }, Some(0.001)), "0.28310 ± 0.00030");
    }
}
