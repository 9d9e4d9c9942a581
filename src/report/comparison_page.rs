//! Comparison page: scores, differences, pictures and tilt curves beside each other.

use super::diagram::projection::{self, DiagramView};
use super::estimates::{difference_html, estimate_html};
use super::html::{HtmlPage, data_uri};
use super::page::{scope_figure, tilt_section};
use super::request::ReportInput;
use super::stone_report::{ReportError, table_picture};
use super::{tilt_curves, viewer_images};
use crate::geometry::{Polyhedron, SolidError};
use crate::scoring::comparison::Comparison;
use crate::scoring::score::{ScoreInput, ScoreRequest, ScoreRow};
use crate::storage::terminal::in_line;
use maud::{Markup, html};

const OWN_STYLE: &str = include_str!("comparison_page.css");

/// Steps that [`html()`] reports, for each stone.
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
    requests: &[ReportInput],
    comparison: &Comparison,
    plan: &ScoreRequest,
    step: &dyn Fn(&'static str),
) -> Result<String, ReportError> {
    let names: Vec<&str> = requests.iter().map(|r| r.stone.as_str()).collect();
    let materials: Vec<&str> = requests.iter().map(|r| r.material.name.as_ref()).collect();
    let labels = labels(&names);
    let mut sub = vec![format!("compared, in {}", together(&materials))];
    sub.extend(explained(&names));
    let solids: Vec<Polyhedron> =
        requests.iter().map(|r| r.design.solid()).collect::<Result<_, SolidError>>()?;
    let mut rows: Vec<Vec<Markup>> = Vec::new();
    for (request, solid) in requests.iter().zip(&solids) {
        step("scopes");
        let subject = ScoreInput {
            stone: request.stone.clone(),
            material: request.material.clone(),
            shape: Ok(solid.clone().into()),
            tilt: None,
        };
        let seen = viewer_images::pictures(&subject, plan, request.width * 5 / 8)?;
        step("picture");
        let picture = table_picture(request, &|_| ())?;
        let mut cells = vec![html! { figure { img src=(data_uri(&picture)) alt="on a grey table"; } }];
        cells.extend(seen.iter().map(scope_figure));
        let views = [DiagramView::Crown, DiagramView::Side].map(|v| projection::drawing(solid, v));
        cells.extend(views.map(|drawing| html! { figure { (drawing) } }));
        rows.push(cells);
    }
    let lines: Vec<(&ReportInput, &str, &Polyhedron)> = requests
        .iter()
        .zip(&labels)
        .zip(&solids)
        .map(|((request, label), solid)| (request, label.as_str(), solid))
        .collect();
    let tilts = tilt_curves::plots(&lines, plan, &|| step("tilts"));
    let content = html! {
        // one row of the page for each kind of picture, so that equals stand beside each other
        @for kind in 0..rows.first().map_or(0, Vec::len) {
            section class="beside" {
                @for (name, cells) in labels.iter().zip(&rows) {
                    div { h2 { (name) } (cells[kind]) } "\n"
                }
            }
            "\n"
        }
        (table(&labels, comparison, plan))
        (tilt_section(&tilts))
    };
    let page = HtmlPage {
        title: &listed(&labels),
        subtitle: &sub.join(" · "),
        style: OWN_STYLE,
        content,
        footer: html! {},
        command: requests.first().map_or("", |r| r.command.as_str()),
    };
    Ok(page.html())
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
fn table(names: &[String], comparison: &Comparison, plan: &ScoreRequest) -> Markup {
    html! {
        section {
            h2 { "Scores" }
            div class="wide" {
                table class="versus" {
                    thead {
                        tr {
                            th {}
                            @for name in names { th { (name) } }
                            @for name in &names[1..] { th { (name) " less " (names[0]) } }
                        }
                    }
                    "\n"
                    tbody { @for m in 0..plan.metrics.len() { (table_row(comparison, plan, m)) } }
                }
            }
            p class="note" {
                "After ± stands one standard error. Differences are of paired runs with the same random numbers; \
                 bold ones are beyond three of their errors, and more than 1e-6 of the metric’s scale (1, or 100 \
                 for percentages), or 1e-4 where photons are traced."
                @for line in left_out(comparison) { " " (line) "." }
            }
        }
        "\n"
    }
}

/// The scores of one metric, and their differences from the first.
fn table_row(comparison: &Comparison, plan: &ScoreRequest, metric: usize) -> Markup {
    let better = plan.metrics[metric].better.said();
    html! {
        tr title=(plan.metrics[metric].about_and_better()) {
            th scope="row" {
                (plan.metrics[metric].name)
                @if !better.is_empty() { br; span class="se" { (better) } }
            }
            @for row in &comparison.rows { td class="value" { (estimate_html(row.scores[metric], "")) } }
            @for (other, differences) in comparison.differences.iter().enumerate() {
                @let differs = comparison.is_significant(other, metric) == Some(true);
                td class={ "value " (if differs { "differs" } else { "same" }) } {
                    (difference_html(differences[metric]))
                }
            }
        }
        "\n"
    }
}
