//! The page of a validation: what was expected, what came out, where the two are apart.

use super::estimates::estimate_text;
use super::html::escaped;
use super::plot::{Curves, Dot, PlotCurve};
use crate::batch::validate::{Axes, CheckReport, ERRORS, Expected, Figure, FigureOutcome, Verdict};
use crate::sampling::stats::Estimate;
use std::fmt::Write;

const STYLE: &str = include_str!("page.css");
const OWN_STYLE: &str = include_str!("validation.css");

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
    match (estimate_text(ours), tolerance) {
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
    let mut out = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>Validation · cutlab</title>\n<style>\n{STYLE}{OWN_STYLE}</style>\n</head>\n<body>\n<main>\n\
         <header>\n<h1>Validation</h1>\n<p class=\"sub\">Published and derivable figures about cut stones, \
         beside what cutlab computes</p>\n</header>\n<section class=\"verdicts\">\n"
    );
    for verdict in [Verdict::Passed, Verdict::Failed, Verdict::Skipped] {
        let _ = writeln!(
            out,
            "<div class=\"tile\"><dl><dt>{verdict}</dt><dd><b>{}</b></dd></dl></div>",
            count(reports, verdict)
        );
    }
    let _ = writeln!(
        out,
        "</section>\n<p>{}</p>\n<p class=\"note\">published: stands in a publication; derived: follows from a \
         definition; cross-checked: computed by a tracer that has nothing in common with this program, and no \
         literature. Light is unpolarised at every facet, as in the tracers that the figures are from. After ± \
         stands the tolerance of an expectation, one standard error of ours. The bars show ours between the \
         limits within which it passes. Not here: photon-mapped pictures, whose energy and convergence the \
         tests check.</p>",
        rule()
    );
    let failed = reports.iter().flat_map(|r| &r.outcomes).filter(|o| o.verdict == Verdict::Failed);
    let failed: Vec<&FigureOutcome> = failed.collect();
    if !failed.is_empty() {
        table("What did not come out", &failed, &mut out);
    }
    plots(reports, &mut out);
    let mut subjects: Vec<&str> = Vec::new();
    for outcome in reports.iter().flat_map(|r| &r.outcomes) {
        if !subjects.contains(&outcome.subject) {
            subjects.push(outcome.subject);
        }
    }
    for subject in subjects {
        let of = reports.iter().flat_map(|r| &r.outcomes).filter(|o| o.subject == subject);
        table(subject, &of.collect::<Vec<_>>(), &mut out);
    }
    let _ = writeln!(
        out,
        "<footer>\n<p>Seed {seed}. The same in numbers: <a href=\"validation.csv\">validation.csv</a></p>\n\
         <p>Made by cutlab {} with <code>{}</code></p>\n</footer>\n</main>\n</body>\n</html>",
        env!("CARGO_PKG_VERSION"),
        escaped(command)
    );
    out
}

fn plots(reports: &[CheckReport], out: &mut String) {
    *out += "<section class=\"curves\">\n";
    let drawn = reports.iter().filter(|r| !r.line.is_empty());
    for (i, (report, axes)) in drawn.filter_map(|r| Some((r, r.plot?))).enumerate() {
        // several drawings share one page: each needs a clip of its own name
        let svg = plot(report, axes).replace("id=\"plot\"", &format!("id=\"plot{i}\""));
        let _ = writeln!(out, "<figure>{}</figure>", svg.replace("url(#plot)", &format!("url(#plot{i})")));
    }
    *out += "</section>\n";
}

fn plot(report: &CheckReport, axes: Axes) -> String {
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
    .svg()
}

fn table(subject: &str, outcomes: &[&FigureOutcome], out: &mut String) {
    let _ = writeln!(
        out,
        "<section>\n<h2>{}</h2>\n<div class=\"wide\"><table class=\"figures\"><thead><tr><th>figure</th>\
         <th>source</th><th>expected</th><th>ours</th><th></th><th>verdict</th></tr></thead><tbody>",
        escaped(subject)
    );
    for o in outcomes {
        let f = &o.figure;
        let ours = o.ours.map_or("–".into(), |e| with_unit(&written(e, f.expected.tolerance()), f.unit));
        let has_why = if o.why.is_empty() { "" } else { " class=\"has-why\"" };
        let _ = writeln!(
            out,
            "<tr{has_why}><th scope=\"row\">{}</th><td class=\"source\">{}: {}</td><td class=\"value\">{}</td>\
             <td class=\"value\">{}</td><td>{}</td><td class=\"{verdict}\">{verdict}</td></tr>",
            escaped(&f.name),
            f.source.kind,
            escaped(f.source.name),
            escaped(&with_unit(&expectation(f), f.unit)),
            escaped(&ours),
            o.ours.map_or(String::new(), |e| bar(f.expected, e)),
            verdict = o.verdict
        );
        if !o.why.is_empty() {
            let _ = writeln!(out, "<tr class=\"why\"><td colspan=\"6\">{}</td></tr>", escaped(&o.why));
        }
    }
    *out += "</tbody></table></div>\n</section>\n";
}

/// Where ours lies between the limits: a strip for what passes, a dot with two standard errors.
fn bar(expected: Expected, ours: Estimate) -> String {
    let Some(tolerance) = expected.tolerance() else { return String::new() };
    /// The strip reaches so far to either side of the middle, the drawing half as far again.
    const REACH: f64 = 44.0;
    let limit = (tolerance + ERRORS * ours.error).max(f64::MIN_POSITIVE);
    let along = |x: f64| (68.0 + REACH * x / limit).clamp(4.0, 132.0);
    let off = ours.value - expected.value();
    let (x, low, high) = (along(off), along(off - 2.0 * ours.error), along(off + 2.0 * ours.error));
    let colour = if expected.is_met(ours) { "#0072b2" } else { "#d55e00" };
    format!(
        "<svg viewBox=\"0 0 136 18\"><rect x=\"24\" y=\"4\" width=\"88\" height=\"10\" fill=\"#e6ecf1\"/>\
         <path d=\"M68 3v12\" stroke=\"#9aa5af\"/><path d=\"M{low:.1} 9H{high:.1}\" stroke=\"{colour}\" \
         stroke-width=\"1.5\"/><circle cx=\"{x:.1}\" cy=\"9\" r=\"3.2\" fill=\"{colour}\"/></svg>"
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
