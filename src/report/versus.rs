//! The page of a comparison: scores, differences, pictures and tilt curves beside each other.

use super::aset;
use super::bundle::{ReportError, Request, table_picture};
use super::diagram::projection::{self, View};
use super::page::{data_uri, escaped, number};
use super::plot::{Curve, Curves};
use crate::metrics::Metric;
use crate::study::compare::{Comparison, is_significant};
use crate::study::score::{Effort, Plan, Subject, Tilt, score};
use crate::walk::Stone;
use std::fmt::Write;

const STYLE: &str = include_str!("page.css");
const OWN_STYLE: &str = include_str!("versus.css");

/// Pixels across an ASET picture.
const ASET_SIDE: u32 = 480;

/// Tilts of the curves, to both sides, in degrees.
const MOST_TILT: i32 = 30;
const TILT_STEP: usize = 3;

/// Points of each experiment at each tilt: ±.0012 of `wlr`.
const TILT_SAMPLES: u64 = 1 << 14;

/// Scores that are drawn against the tilt.
const TILTED: [&str; 2] = ["wlr", "aset_leak"];

/// Steps that [`html`] reports, for each stone.
pub const STEPS: usize = 3;

/// The page.
///
/// - `requests`: one a stone, in the order of the comparison
/// - `step`: called with what comes next, [`STEPS`] times a stone
pub fn html(
    requests: &[Request],
    comparison: &Comparison,
    plan: &Plan,
    step: &dyn Fn(&'static str),
) -> Result<String, ReportError> {
    let names: Vec<&str> = requests.iter().map(|r| r.stone.as_str()).collect();
    let title = names.join(" and ");
    let mut out = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title} · cutlab</title>\n<style>\n{STYLE}{OWN_STYLE}</style>\n</head>\n<body>\n<main>\n\
         <header>\n<h1>{title}</h1>\n<p class=\"sub\">compared</p>\n</header>\n",
        title = escaped(&title)
    );
    let mut tilted: Vec<Vec<Curve>> = vec![Vec::new(); TILTED.len()];
    out += "<section class=\"beside\">\n";
    for request in requests {
        let solid = request.design.solid()?;
        let stone = Stone::new(solid.clone());
        step("ASET map");
        let aset = aset::picture(&stone, request.material.index_d() as f32, ASET_SIDE)?;
        let picture = table_picture(request, &|_| ())?;
        step("picture");
        let shares: Vec<String> = ["green", "red", "blue", "leak"]
            .iter()
            .zip(aset.shares)
            .map(|(n, s)| format!("{n} {:.1} %", 100.0 * s))
            .collect();
        let _ = writeln!(
            out,
            "<div><h2>{}</h2><p class=\"note\">{}</p>\n<figure><img src=\"{}\" alt=\"on a grey table\"></figure>\n\
             <figure><img src=\"{}\" alt=\"ASET map\"><figcaption>ASET: {}</figcaption></figure>\n\
             <figure>{}</figure>\n<figure>{}</figure></div>",
            escaped(&request.stone),
            escaped(&request.material.name),
            data_uri(&picture),
            data_uri(&aset.png),
            shares.join(", "),
            projection::svg(&solid, View::Crown),
            projection::svg(&solid, View::Side),
        );
        step("tilts");
        for (curves, points) in tilted.iter_mut().zip(tilts(request, &solid, plan)) {
            curves.push(Curve { name: request.stone.clone(), points });
        }
    }
    out += "</section>\n";
    table(&names, comparison, plan, &mut out);
    out += "<section>\n<h2>Tilts</h2>\n<div class=\"beside\">\n";
    for (name, curves) in TILTED.iter().zip(tilted) {
        let svg = Curves {
            title: name.to_string(),
            note: "tilted about the x axis; band: 95 in 100".into(),
            x: "tilt (°)".into(),
            y: name.to_string(),
            curves,
            ..Curves::default()
        }
        .svg();
        // each drawing names its clip `plot`: in one page they need names of their own
        let _ = writeln!(out, "<figure>{}</figure>", svg.replace("plot", &format!("plot-{name}")));
    }
    let command = requests.first().map_or("", |r| r.command.as_str());
    let _ = write!(
        out,
        "</div>\n</section>\n<footer>\n<p>Made by cutlab {} with <code>{}</code></p>\n</footer>\n</main>\n</body>\n</html>\n",
        env!("CARGO_PKG_VERSION"),
        escaped(command)
    );
    Ok(out)
}

/// Points of a curve: the tilt, and value with standard error where the score has one.
type Points = Vec<(f64, Option<(f64, f64)>)>;

/// One curve a score of [`TILTED`].
fn tilts(request: &Request, solid: &crate::solid::Polyhedron, plan: &Plan) -> Vec<Points> {
    let metrics: Vec<&'static Metric> = TILTED.iter().filter_map(|name| Metric::named(name)).collect();
    let plan = Plan { metrics, effort: Effort::Samples(TILT_SAMPLES), exact: false, ..plan.clone() };
    let mut curves = vec![Vec::new(); TILTED.len()];
    for degrees in (-MOST_TILT..=MOST_TILT).step_by(TILT_STEP).map(f64::from) {
        let subject = Subject {
            stone: request.stone.clone(),
            material: request.material.clone(),
            shape: Ok(solid.clone().into()),
            tilt: Some(Tilt { degrees, azimuth: 0.0 }),
        };
        let row = score(&subject, &plan);
        for (curve, value) in curves.iter_mut().zip(row.scores) {
            curve.push((degrees, value.map(|e| (e.value, e.error))));
        }
    }
    curves
}

/// Scores and differences.
fn table(names: &[&str], comparison: &Comparison, plan: &Plan, out: &mut String) {
    *out += "<section>\n<h2>Scores</h2>\n<div class=\"wide\"><table class=\"versus\">\n<thead><tr><th></th>";
    names.iter().for_each(|name| *out += &format!("<th>{}</th>", escaped(name)));
    names[1..]
        .iter()
        .for_each(|name| *out += &format!("<th>{} less {}</th>", escaped(name), escaped(names[0])));
    *out += "</tr></thead>\n<tbody>\n";
    for (m, metric) in plan.metrics.iter().enumerate() {
        let _ = write!(out, "<tr title=\"{}\"><th scope=\"row\">{}</th>", escaped(metric.about), metric.name);
        let cell = |value: Option<crate::math::stats::Estimate>, class: &str| {
            let text = value.map(number).map_or("–".into(), |(value, error)| match error {
                Some(error) => format!("{value} <span class=\"se\">± {error}</span>"),
                None => value,
            });
            format!("<td class=\"{class}\">{text}</td>")
        };
        comparison.rows.iter().for_each(|row| *out += &cell(row.scores[m], "value"));
        for differences in &comparison.differences {
            let d = differences[m];
            *out += &cell(d, if d.is_some_and(is_significant) { "value differs" } else { "value same" });
        }
        *out += "</tr>\n";
    }
    *out += "</tbody></table></div>\n<p class=\"note\">After ± stands one standard error. Differences are of \
             paired runs with the same random numbers; bold ones are beyond three of their errors.</p>\n</section>\n";
}
