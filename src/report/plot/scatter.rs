//! Scatter plots: many points, the best of them, and some with names.

use super::frame::{DECIMALS, HEIGHT, PlotFrame, SMALL, WIDTH};
use crate::report::raster::text_width;
use crate::report::svg_canvas::{Anchor, Element, PathData};
use std::collections::BTreeSet;

/// Points that are drawn alike.
#[derive(Debug, Clone, Default)]
pub struct PointSet {
    /// Its name in the legend.
    pub name: String,
    /// Places of the points, in units of the axes.
    pub points: Vec<(f64, f64)>,
}

/// A point with a name beside it.
#[derive(Debug, Clone)]
pub struct NamedPoint {
    /// The name.
    pub name: String,
    /// Its place, in units of the axes.
    pub at: (f64, f64),
}

/// A scatter plot.
#[derive(Debug, Clone, Default)]
pub struct Scatter {
    /// What it shows.
    pub title: String,
    /// Title of the axis across.
    pub x: String,
    /// Title of the axis up.
    pub y: String,
    /// All points, in grey.
    pub all: PointSet,
    /// Points to be seen among them.
    pub best: PointSet,
    /// Corners of a line, in the colour of the best points; may be empty.
    pub line: Vec<(f64, f64)>,
    /// A hollow point: where everything began.
    pub start: Option<NamedPoint>,
    /// Points in a colour of their own, above all others.
    pub chosen: Vec<NamedPoint>,
    /// Name of the chosen points in the legend.
    pub chosen_name: String,
    /// The least range of the axis across that is shown.
    pub least_x: Option<(f64, f64)>,
    /// Whether it is to be shown small: the drawing has less room, its text stays.
    pub small: bool,
}

const GREY: &str = "#aab2b9";
const BEST: &str = "#0072b2";
const CHOSEN: &str = "#d55e00";
const START: &str = "#000";

/// Height of the letters of names and of the legend.
const LETTERS: f64 = 12.0;

impl Scatter {
    /// The drawing as a document.
    pub fn svg(&self) -> String {
        let named = || self.start.iter().chain(&self.chosen).map(|n| n.at);
        let every =
            || self.all.points.iter().chain(&self.best.points).chain(&self.line).copied().chain(named());
        let (xs, ys) = (reach(every().map(|p| p.0).chain(self.ends())), reach(every().map(|p| p.1)));
        let size = if self.small { SMALL } else { (WIDTH, HEIGHT) };
        // no point lies on the border
        let room = |(low, high): (f64, f64)| (low - 0.04 * (high - low), high + 0.04 * (high - low));
        let frame = PlotFrame::new(size, room(xs), room(ys), 28.0, "plot");
        let mut out = frame.open(&self.title, "");
        frame.axes(&mut out, &self.x, &self.y, true);
        let mut inside = Element::group().clip(&frame.clip);
        inside.push(dots(&frame, &self.all.points, GREY, 5.0));
        if !self.line.is_empty() {
            let line = PathData::new(DECIMALS).line(self.line.iter().map(|p| place(&frame, *p)));
            inside.push(Element::path(line).fill("none").stroke(BEST, 1.6).round_joins());
        }
        inside.push(dots(&frame, &self.best.points, BEST, 7.0));
        out.push(inside);
        self.named(&frame, &mut out);
        self.legend(&frame, &mut out);
        out.document()
    }

    fn ends(&self) -> impl Iterator<Item = f64> {
        self.least_x.into_iter().flat_map(|(from, to)| [from, to])
    }

    /// The start and the chosen points with their names, which stand where none stands yet.
    fn named(&self, frame: &PlotFrame, out: &mut Element) {
        let start = self.start.iter().map(|point| (point, false));
        let all: Vec<(&NamedPoint, bool)> = self.chosen.iter().map(|p| (p, true)).chain(start).collect();
        for (point, is_chosen) in &all {
            let at = place(frame, point.at);
            let dot = Element::circle(at, if *is_chosen { 5.0 } else { 6.0 });
            out.push(match is_chosen {
                true => dot.fill(CHOSEN).stroke("#fff", 1.0),
                false => dot.fill("none").stroke(START, 1.8),
            });
        }
        // left, right and base line of what letters must not cover: dots, then names
        let dot = |(x, y): (f64, f64)| (x - 5.0, x + 5.0, y + 0.4 * LETTERS);
        let mut taken: Vec<(f64, f64, f64)> = all.iter().map(|(p, _)| dot(place(frame, p.at))).collect();
        let (left, top, w, h) = frame.rectangle();
        for (point, is_chosen) in all {
            let (x, y) = place(frame, point.at);
            let width = LETTERS * text_width(&point.name, true);
            let beside = [-5.0, 15.0, -19.0, 29.0, -33.0, 43.0];
            let places: Vec<(f64, f64)> =
                beside.into_iter().flat_map(|dy| [(9.0, dy), (-9.0 - width, dy)]).collect();
            let is_free = |(dx, dy): &&(f64, f64)| {
                let (from, to, base) = (x + dx, x + dx + width, y + dy);
                let is_inside = from > left && to < left + w && base - LETTERS > top && base < top + h;
                is_inside && taken.iter().all(|t| to < t.0 || from > t.1 || (base - t.2).abs() > LETTERS)
            };
            let (dx, dy) = places.iter().find(is_free).copied().unwrap_or(places[0]);
            taken.push((x + dx, x + dx + width, y + dy));
            let name = Element::text((x + dx, y + dy), &point.name).font_size(LETTERS).bold();
            out.push(name.fill(if is_chosen { CHOSEN } else { START }).halo("#fff", 3.0).round_joins());
        }
    }

    /// What the colours mean, in a line above the plot.
    fn legend(&self, frame: &PlotFrame, out: &mut Element) {
        let (mut x, y) = (frame.rectangle().0 + 5.0, 48.0);
        let start = self.start.as_ref().map_or("", |start| &start.name);
        let chosen = if self.chosen.is_empty() { "" } else { &self.chosen_name };
        for (name, colour) in
            [(&*self.all.name, GREY), (&*self.best.name, BEST), (start, START), (chosen, CHOSEN)]
        {
            if name.is_empty() {
                continue;
            }
            let dot = Element::circle((x, y - 4.0), 4.0);
            out.push(if colour == START { dot.fill("none").stroke(colour, 1.6) } else { dot.fill(colour) });
            out.push(Element::text((x + 9.0, y), name).font_size(LETTERS).anchor(Anchor::Start).fill("#555"));
            x += 9.0 + LETTERS * text_width(name, false) + 16.0;
        }
    }
}

/// Least and greatest of some numbers; 0 and 1 of none.
fn reach(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values
        .filter(|v| v.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    if low <= high { (low, high) } else { (0.0, 1.0) }
}

fn place(frame: &PlotFrame, at: (f64, f64)) -> (f64, f64) {
    (frame.x.position(at.0), frame.y.position(at.1))
}

/// Points as one path, of which those that would cover each other are drawn once.
fn dots(frame: &PlotFrame, points: &[(f64, f64)], colour: &str, width: f64) -> Element {
    let halves = |(x, y): (f64, f64)| ((2.0 * x).round() as i64, (2.0 * y).round() as i64);
    let is_number = |p: &&(f64, f64)| p.0.is_finite() && p.1.is_finite();
    let places: BTreeSet<(i64, i64)> =
        points.iter().filter(is_number).map(|p| halves(place(frame, *p))).collect();
    let path = places
        .iter()
        .fold(PathData::new(DECIMALS), |path, (x, y)| path.across((0.5 * *x as f64, 0.5 * *y as f64), 0.0));
    Element::path(path).fill("none").stroke(colour, width).attribute("stroke-linecap", "round")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scatter(points: Vec<(f64, f64)>) -> Scatter {
        let all = PointSet { name: "candidate".into(), points };
        let start = Some(NamedPoint { name: "start".into(), at: (0.5, 0.5) });
        Scatter { all, start, small: true, ..Scatter::default() }
    }

    #[test]
    fn each_place_is_drawn_once_and_numbers_that_are_none_never() {
        let count = |plot: &Scatter| plot.svg().matches("h0").count();
        let points = vec![(0.0, 0.0), (0.0, 0.0), (1.0, 1.0), (f64::NAN, 1.0), (0.3, f64::INFINITY)];
        assert_eq!(count(&scatter(points)), 2);
        assert_eq!(count(&scatter(Vec::new())), 0);
    }

    #[test]
    fn names_of_neighbours_do_not_cover_each_other() {
        let mut plot = scatter(vec![(0.0, 0.0), (1.0, 1.0)]);
        plot.chosen = (1..=3).map(|i| NamedPoint { name: i.to_string(), at: (0.5, 0.5) }).collect();
        let svg = plot.svg();
        let document = roxmltree::Document::parse(&svg).expect("is XML");
        let bold = document.descendants().filter(|n| n.attribute("font-size") == Some("12"));
        let at: BTreeSet<(String, String)> = bold
            .filter(|n| n.attribute("font-weight") == Some("bold"))
            .filter_map(|n| Some((n.attribute("x")?.to_owned(), n.attribute("y")?.to_owned())))
            .collect();
        assert_eq!(at.len(), 4, "{svg}");
    }
}
