//! Comparison page: scores, differences, pictures and tilt curves beside each other.

use super::diagram::projection::{self, DiagramView};
use super::estimates::{estimate_html, estimate_text};
use super::html::{data_uri, escaped};
use super::page::{head, scope_figure, tilt_section};
use super::request::ReportRequest;
use super::stone_report::{ReportError, table_picture};
use super::{tilt_curves, viewer_images};
use crate::geometry::{Polyhedron, SolidError};
use crate::scoring::comparison::Comparison;
use crate::scoring::score::{ScoreInput, ScoreRequest, ScoreRow};
use crate::storage::terminal::in_line;
use std::fmt::Write;

const OWN_STYLE: &str = include_str!("comparison_page.css");

/// Pixels across a picture through a scope.
const SCOPE_SIDE: u32 = 400;

/// Steps that [`html`] reports, for each stone.
pub const STEPS: usize = 3;

/// Names longer than this make a table too wide: a number stands for them.
const LONGEST: usize = 24;

/// What stands for each stone in tables: its name, or a number if that is long.
pub fn labels(names: &[&str]) -> Vec<String> {
    let label = |(i, name): (usize, &&str)| {
        if name.chars().count() > LONGEST { format!("stone {}", i + 1) } else { in_line(name) }
    };
    names.iter().enumerate().map(label).collect()
}

/// Which names the labels stand for, where they are not the names themselves.
pub fn explained(names: &[&str]) -> Vec<String> {
    let labels = labels(names);
    let names = names.iter().map(|name| in_line(name));
    let other = labels.iter().zip(names).filter(|(label, name)| *label != name);
    other.map(|(label, name)| format!("{label}: {name}")).collect()
}

/// What has no score, and why, stone by stone.
pub fn left_out(comparison: &Comparison) -> Vec<String> {
    let said = |row: &ScoreRow| Some(format!("{}: {}", in_line(&row.stone), row.omissions()?));
    comparison.rows.iter().filter_map(said).collect()
}

/// The page.
///
/// - `requests`: one a stone, in the order of the comparison
/// - `step`: called with what comes next, [`STEPS`] times a stone
pub fn html(
    requests: &[ReportRequest],
    comparison: &Comparison,
    plan: &ScoreRequest,
    step: &dyn Fn(&'static str),
) -> Result<String, ReportError> {
    let names: Vec<&str> = requests.iter().map(|r| r.stone.as_str()).collect();
    let materials: Vec<&str> = requests.iter().map(|r| r.material.name.as_ref()).collect();
    let labels = labels(&names);
    let mut sub = vec![format!("compared, in {}", together(&materials))];
    sub.extend(explained(&names));
    let mut out = head(&listed(&labels), OWN_STYLE, &sub.join(" · "));
    let solids: Vec<Polyhedron> =
        requests.iter().map(|r| r.design.solid()).collect::<Result<_, SolidError>>()?;
    let mut rows: Vec<Vec<String>> = Vec::new();
    for (request, solid) in requests.iter().zip(&solids) {
        step("scopes");
        let subject = ScoreInput {
            stone: request.stone.clone(),
            material: request.material.clone(),
            shape: Ok(solid.clone().into()),
            tilt: None,
        };
        let seen = viewer_images::pictures(&subject, plan, SCOPE_SIDE)?;
        step("picture");
        let picture = table_picture(request, &|_| ())?;
        let mut cells =
            vec![format!("<figure><img src=\"{}\" alt=\"on a grey table\"></figure>\n", data_uri(&picture))];
        cells.extend(seen.iter().map(scope_figure));
        cells.extend(
            [DiagramView::Crown, DiagramView::Side]
                .map(|v| format!("<figure>{}</figure>\n", projection::svg(solid, v))),
        );
        rows.push(cells);
    }
    // one row of the page for each kind of picture, so that equals stand beside each other
    for kind in 0..rows.first().map_or(0, Vec::len) {
        out += "<section class=\"beside\">\n";
        for (name, cells) in labels.iter().zip(&rows) {
            let _ = write!(out, "<div><h2>{}</h2>\n{}</div>\n", escaped(name), cells[kind]);
        }
        out += "</section>\n";
    }
    table(&labels, comparison, plan, &mut out);
    let lines: Vec<(&ReportRequest, &str, &Polyhedron)> = requests
        .iter()
        .zip(&labels)
        .zip(&solids)
        .map(|((request, label), solid)| (request, label.as_str(), solid))
        .collect();
    out += &tilt_section(&tilt_curves::plots(&lines, plan, &|| step("tilts")));
    let command = requests.first().map_or("", |r| r.command.as_str());
    let _ = write!(
        out,
        "<footer>\n<p>Made by cutlab {} with <code>{}</code></p>\n</footer>\n</main>\n</body>\n</html>\n",
        env!("CARGO_PKG_VERSION"),
        escaped(command)
    );
    Ok(out)
}

/// Names in a row, each once.
fn together(names: &[&str]) -> String {
    let first = |i: usize| !names[..i].contains(&names[i]);
    let once: Vec<String> = (0..names.len()).filter(|i| first(*i)).map(|i| names[i].to_string()).collect();
    listed(&once)
}

/// Names in a sentence.
fn listed(names: &[String]) -> String {
    match names {
        [rest @ .., last] if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => names.concat(),
    }
}

/// Scores and differences.
fn table(names: &[String], comparison: &Comparison, plan: &ScoreRequest, out: &mut String) {
    *out += "<section>\n<h2>Scores</h2>\n<div class=\"wide\"><table class=\"versus\">\n<thead><tr><th></th>";
    names.iter().for_each(|name| *out += &format!("<th>{}</th>", escaped(name)));
    names[1..]
        .iter()
        .for_each(|name| *out += &format!("<th>{} less {}</th>", escaped(name), escaped(&names[0])));
    *out += "</tr></thead>\n<tbody>\n";
    for (m, metric) in plan.metrics.iter().enumerate() {
        let better = match metric.better.said() {
            "" => String::new(),
            said => format!("<br><span class=\"se\">{said}</span>"),
        };
        let _ = write!(
            out,
            "<tr title=\"{}\"><th scope=\"row\">{}{}</th>",
            escaped(&metric.about_and_better()),
            metric.name,
            better
        );
        let cell = |value, class: &str| format!("<td class=\"{class}\">{}</td>", estimate_html(value, ""));
        comparison.rows.iter().for_each(|row| *out += &cell(row.scores[m], "value"));
        for (other, differences) in comparison.differences.iter().enumerate() {
            let d = differences[m];
            let differs = comparison.is_significant(other, m) == Some(true);
            let text = cell(d, if differs { "value differs" } else { "value same" });
            let positive = d.is_some_and(|e| e.value > 0.0 && estimate_text(e).0.parse() != Ok(0.0));
            let sign = if positive { "<b>+" } else { "<b>" };
            *out += &text.replacen("<b>", sign, 1);
        }
        *out += "</tr>\n";
    }
    *out += "</tbody></table></div>\n<p class=\"note\">After ± stands one standard error. Differences are of \
             paired runs with the same random numbers; bold ones are beyond three of their errors, and more \
             than 1e-6 of the metric’s scale (1, or 100 for percentages), or 1e-4 where photons are traced.";
    left_out(comparison).iter().for_each(|line| *out += &format!(" {}.", escaped(line)));
    *out += "</p>\n</section>\n";
}
