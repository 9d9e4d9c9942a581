//! Plots of a search: the front between objectives, or of one objective the best so far and the variables.

use super::headline;
use super::kept::KeptDesign;
use crate::optimise::{OptimiseRequest, Optimised};
use crate::report::html::svg_uri;
use crate::report::plot::{NamedPoint, PointSet, Scatter};
use crate::scoring::objective::Objective;
use crate::search::front::ranked;
use maud::{Markup, html};

/// The part of the feasible candidates that stands out in plots of variables, and their least number.
const BEST_PART: usize = 10;
const LEAST_BEST: usize = 5;

/// The most plots of variables.
const MOST_PLOTS: usize = 12;

/// What the search found, with its objectives in their units.
struct FoundPoints<'a> {
    request: &'a OptimiseRequest,
    found: &'a Optimised,
    kept: &'a [KeptDesign<'a>],
    /// Numbers of the candidates that keep the bounds.
    feasible: Vec<usize>,
}

/// The section.
pub(super) fn section(request: &OptimiseRequest, found: &Optimised, kept: &[KeptDesign]) -> Markup {
    let is_feasible = |i: &usize| found.candidates[*i].outcome.is_feasible();
    let feasible = (0..found.candidates.len()).filter(is_feasible).collect();
    let points = FoundPoints { request, found, kept, feasible };
    match request.objectives.len() {
        1 => points.of_one(),
        count => points.of_several(count),
    }
}

impl FoundPoints<'_> {
    /// The value of an objective, as the search saw it, in the metric's unit.
    fn objective(&self, candidate: usize, number: usize) -> f64 {
        let signed = self.found.candidates[candidate].outcome.objectives.get(number).copied();
        signed.map_or(f64::NAN, |value| self.request.objectives[number].aim.sign() * value)
    }

    fn value(&self, candidate: usize, variable: usize) -> f64 {
        self.found.candidates[candidate].values[variable]
    }

    /// A scatter plot of two quantities of candidates, with start and kept designs.
    fn scatter(&self, best: &[usize], x: &dyn Fn(usize) -> f64, y: &dyn Fn(usize) -> f64) -> Scatter {
        let at = |candidate: &usize| (x(*candidate), y(*candidate));
        let start = Some(0).filter(|start| self.feasible.contains(start));
        let chosen = |design: &KeptDesign| NamedPoint {
            name: design.mark.clone(),
            at: at(&design.finalist.candidate),
        };
        Scatter {
            all: PointSet { name: "candidates".into(), points: self.feasible.iter().map(at).collect() },
            best: PointSet { name: String::new(), points: best.iter().map(at).collect() },
            start: start.map(|start| NamedPoint { name: "start".into(), at: at(&start) }),
            chosen: self.kept.iter().map(chosen).collect(),
            chosen_name: "kept".into(),
            small: true,
            ..Scatter::default()
        }
    }

    /// The front: a plot for each pair of objectives.
    fn of_several(&self, count: usize) -> Markup {
        let pairs: Vec<(usize, usize)> =
            (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b))).collect();
        let plots: Vec<(String, String)> = pairs
            .iter()
            .map(|&(a, b)| {
                let mut plot = self.scatter(
                    &self.found.front,
                    &|candidate| self.objective(candidate, a),
                    &|candidate| self.objective(candidate, b),
                );
                let [x, y] = [a, b].map(|number| &self.request.objectives[number]);
                plot.title = format!("{} and {}", x.name(), y.name());
                (plot.x, plot.y) = (with_unit(x), with_unit(y));
                plot.best.name = "front".into();
                plot.small = pairs.len() > 1;
                (format!("{} against {}, candidates and front", y.name(), x.name()), plot.svg())
            })
            .collect();
        html! {
            section {
                h2 { "Front" }
                p class="note" {
                    "Each point is a candidate that keeps the bounds, by the scores that the search saw ("
                    (headline::objectives(self.request)) " wanted). The front, " (self.found.front.len())
                    " of them in blue, is what none of the others is better than in every objective"
                    @if count > 2 {
                        ": in a plot of two of the objectives some of it lies behind the rest"
                    }
                    ". Numbers are those of the designs that are kept."
                }
                (figures(&plots, pairs.len() == 1))
            }
            "\n"
        }
    }

    /// Of one objective: the best so far, and its values against each variable.
    fn of_one(&self) -> Markup {
        let of = &self.request.objectives[0];
        let y = |candidate: usize| self.objective(candidate, 0);
        let all = ranked(&self.found.candidates);
        let count = (self.feasible.len() / BEST_PART).max(LEAST_BEST).min(self.feasible.len());
        let best = &all[..count];
        let mut plots = Vec::new();
        let mut plot = self.scatter(&[], &|candidate| candidate as f64, &y);
        plot.title = "The best so far".into();
        plot.x = "candidate".into();
        plot.line = self.best_so_far();
        plot.least_x = Some((0.0, 10.0));
        plots.push((format!("{} of each candidate, and the best so far", of.name()), plot));
        for (i, degree) in self.found.degrees.iter().enumerate().take(MOST_PLOTS) {
            let mut plot = self.scatter(best, &|candidate| self.value(candidate, i), &y);
            plot.title.clone_from(&degree.name);
            plot.x = headline::titled(degree);
            plot.best.name = format!("best {count}");
            plots.push((format!("{} against {}", of.name(), degree.name), plot));
        }
        let drawn = |(alt, plot): (String, Scatter)| (alt, Scatter { y: with_unit(of), ..plot }.svg());
        let plots: Vec<(String, String)> = plots.into_iter().map(drawn).collect();
        let left_out = self.found.degrees.len().saturating_sub(MOST_PLOTS);
        html! {
            section {
                h2 { "Search" }
                p class="note" {
                    "Each point is a candidate that keeps the bounds, with " (of.name()) " as the search saw it; the \
                     line is the best value so far. Against each variable the best " (count) " candidates stand out: \
                     where they lie close together the variable matters, where they are spread it hardly does."
                    @if left_out > 0 { " The last " (left_out) " variables have no plot." }
                }
                (figures(&plots, false))
            }
            "\n"
        }
    }

    /// Corners of the line of the best value up to each candidate.
    fn best_so_far(&self) -> Vec<(f64, f64)> {
        let sign = self.request.objectives[0].aim.sign();
        let mut corners: Vec<(f64, f64)> = Vec::new();
        for &candidate in &self.feasible {
            let (x, value) = (candidate as f64, self.objective(candidate, 0));
            match corners.last() {
                Some((_, best)) if sign * value <= sign * best => {}
                Some((_, best)) => corners.extend([(x, *best), (x, value)]),
                None => corners.push((x, value)),
            }
        }
        let end = self.found.candidates.len().saturating_sub(1) as f64;
        corners.extend(corners.last().map(|(_, best)| (end, *best)));
        corners
    }
}

/// An objective with its unit.
fn with_unit(objective: &Objective) -> String {
    match objective.of.metric.unit {
        "" => objective.name(),
        unit => format!("{} ({unit})", objective.name()),
    }
}

/// Plots with their texts for those who do not see them.
fn figures(plots: &[(String, String)], is_large: bool) -> Markup {
    html! {
        div class=(if is_large { "front" } else { "plots" }) {
            @for (alt, svg) in plots { figure { img src=(svg_uri(svg)) alt=(alt); } "\n" }
        }
    }
}
