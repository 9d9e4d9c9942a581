//! Scores along one parameter: lines with their error bands.

use super::BAND;
use super::frame::{DECIMALS, HEIGHT, PlotFrame, SMALL, WIDTH};
use crate::report::raster::text_width;
use crate::report::svg_canvas::{Anchor, Element, PathData};

/// One line.
#[derive(Debug, Clone)]
pub struct PlotCurve {
    /// Its name in the legend; empty if it is alone.
    pub name: String,
    /// x, and value with standard error; none where there is no value: the line is broken.
    pub points: Vec<(f64, Option<(f64, f64)>)>,
}

/// A value that was expected somewhere.
#[derive(Debug, Clone, Copy)]
pub struct Dot {
    /// Where.
    pub x: f64,
    /// The value.
    pub value: f64,
    /// Half the length of its bar.
    pub tolerance: f64,
    /// Whether it is hollow: it was not met.
    pub hollow: bool,
}

/// A plot of lines.
#[derive(Debug, Clone, Default)]
pub struct Curves {
    /// What it shows.
    pub title: String,
    /// One more line, smaller.
    pub note: String,
    /// Title of the axis across.
    pub x: String,
    /// Title of the axis up.
    pub y: String,
    /// The lines.
    pub curves: Vec<PlotCurve>,
    /// Named ranges of x, the narrowest first; the first is shaded.
    pub spans: Vec<(String, (f64, f64))>,
    /// Named places on x.
    pub marks: Vec<(String, f64)>,
    /// Ends of the axes x and y, where they are not those of what is shown.
    pub ends: [Option<(f64, f64)>; 2],
    /// Values that were expected, over the lines.
    pub dots: Vec<Dot>,
    /// Whether it is to be shown small: the drawing has less room, its text stays.
    pub small: bool,
}

/// Colours that stay apart for the colour-blind. Source: M. Okabe, K. Ito, *Color Universal Design*
/// (2008).
const COLOURS: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"];

impl Curves {
    /// The drawing as a document.
    pub fn svg(&self) -> String {
        self.drawing("plot").document()
    }

    /// The drawing.
    ///
    /// - `clip`: name of the region of the plot, another for each drawing of one page
    pub fn drawing(&self, clip: &str) -> Element {
        let points = || self.curves.iter().flat_map(|c| &c.points);
        let reach = |values: &mut dyn Iterator<Item = f64>| {
            let (lo, hi) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
            if lo <= hi { (lo, hi) } else { (0.0, 1.0) }
        };
        let xs = reach(&mut points().map(|p| p.0));
        let shown = || points().filter_map(|p| p.1).filter(|(v, e)| v.is_finite() && e.is_finite());
        let (lo, hi) = reach(
            &mut shown()
                .flat_map(|(v, e)| [v - BAND * e, v + BAND * e])
                .chain(self.dots.iter().flat_map(|d| [d.value - d.tolerance, d.value + d.tolerance])),
        );
        let room = 0.05 * (hi - lo);
        let size = if self.small { SMALL } else { (WIDTH, HEIGHT) };
        // a small drawing has no corner that is surely free of lines: names stand above them
        let names = self.curves.iter().filter(|c| self.small && !c.name.is_empty()).count() as f64;
        let above = 0.09 * names / (1.0 - 0.09 * names).max(0.5) * (hi - lo);
        let ys = self.ends[1].unwrap_or((lo - room, hi + room + above));
        let frame = PlotFrame::new(size, self.ends[0].unwrap_or(xs), ys, 28.0, clip);
        let mut out = frame.open(&self.title, &self.note);
        let (left, top, _, h) = frame.rectangle();
        let mut named_span = None;
        if let Some((name, (from, to))) = self.spans.first() {
            let (from, to) = (from.max(frame.x.from), to.min(frame.x.to));
            if from < to {
                let (a, b) = (frame.x.position(from), frame.x.position(to));
                out.push(Element::rect((a, top), (b - a, h)).fill("#f3eddc"));
                let name = Element::text(((a + b) / 2.0, top + 16.0), &format!("envelope of {name}"));
                named_span =
                    Some(name.font_size(11.0).anchor(Anchor::Middle).fill("#7a6a3a").halo("#fff", 3.0));
            }
        }
        frame.axes(&mut out, &self.x, &self.y, true);
        self.marks(&frame, &mut out);
        named_span.into_iter().for_each(|name| out.push(name));
        for (curve, colour) in self.curves.iter().zip(COLOURS.iter().cycle()) {
            for run in curve.points.split(|p| p.1.is_none()) {
                let run: Vec<(f64, f64, f64)> =
                    run.iter().filter_map(|(x, v)| v.map(|(v, e)| (*x, v, e))).collect();
                line(&frame, &run, colour, &mut out);
            }
        }
        self.dots.iter().for_each(|d| dot(&frame, *d, &mut out));
        let named: Vec<(&PlotCurve, &&str)> =
            self.curves.iter().zip(COLOURS.iter().cycle()).filter(|(c, _)| !c.name.is_empty()).collect();
        for (i, (curve, colour)) in named.iter().enumerate() {
            let y = top + 18.0 + 18.0 * i as f64;
            let sample = PathData::new(DECIMALS).across((left + 12.0, y - 4.5), 22.0);
            out.push(Element::path(sample).stroke(colour, 2.5));
            out.push(Element::text((left + 40.0, y), &curve.name).halo("#fff", 3.0));
        }
        out
    }

    /// Places on x that have names; those that stand at one place share it.
    fn marks(&self, frame: &PlotFrame, out: &mut Element) {
        let (_, top, _, h) = frame.rectangle();
        let mut places: Vec<(f64, String)> = Vec::new();
        let mut sorted: Vec<_> = self.marks.iter().filter(|(_, x)| frame.x.contains(*x)).collect();
        sorted.sort_by(|a, b| a.1.total_cmp(&b.1));
        for (name, x) in sorted {
            let at = frame.x.position(*x);
            match places.last_mut() {
                Some((last, names)) if at - *last < 0.5 => *names += &format!(", {name}"),
                _ => places.push((at, name.clone())),
            }
        }
        let mut written: Vec<(f64, f64)> = Vec::new(); // where a name stands, and how high it reaches
        for (x, names) in places {
            let near = written.iter().filter(|(other, _)| x - other < 13.0).map(|(_, end)| *end);
            let start = near.fold(8.0, f64::max);
            written.push((x, start + 11.0 * text_width(&names, false) + 10.0));
            let line = Element::path(PathData::new(DECIMALS).down((x, top), h));
            out.push(line.stroke("#999", 1.0).attribute("stroke-dasharray", "3 4"));
            let name = Element::turned_text((x - 4.0, top + h - start), -90.0, &names);
            out.push(name.font_size(11.0).fill("#555").halo("#fff", 3.0));
        }
    }
}

/// Decimals of coordinates of curves and their points.
const FINE: usize = DECIMALS + 1;

/// An expected value with its bar.
fn dot(frame: &PlotFrame, d: Dot, out: &mut Element) {
    let (x, y) = (frame.x.position(d.x), frame.y.position(d.value));
    let [low, high] = [d.value - d.tolerance, d.value + d.tolerance].map(|v| frame.y.position(v));
    let colour = COLOURS[1];
    let bar = PathData::new(FINE).across((x - 5.0, low), 10.0).line([(x, low), (x, high)]);
    out.push(Element::path(bar.across((x - 5.0, high), 10.0)).fill("none").stroke(colour, 1.4));
    let fill = if d.hollow { "#fff" } else { colour };
    out.push(Element::circle((x, y), 4.0).decimals(FINE).fill(fill).stroke(colour, 1.6));
}

/// One unbroken line with its band, and dots if there are few.
fn line(frame: &PlotFrame, run: &[(f64, f64, f64)], colour: &str, out: &mut Element) {
    if run.is_empty() {
        return;
    }
    let at = |x: f64, y: f64| (frame.x.position(x), frame.y.position(y));
    let upper = run.iter().map(|(x, v, e)| at(*x, v + BAND * e));
    let lower = run.iter().rev().map(|(x, v, e)| at(*x, v - BAND * e));
    let band = Element::path(PathData::new(FINE).polygon(upper.chain(lower)));
    let middle = Element::path(PathData::new(FINE).line(run.iter().map(|(x, v, _)| at(*x, *v))));
    out.push(
        Element::group()
            .clip(&frame.clip)
            .with(band.fill(colour).number("fill-opacity", 0.22))
            .with(middle.fill("none").stroke(colour, 2.0).round_joins()),
    );
    if run.len() <= 60 {
        for (x, v, _) in run.iter().filter(|(x, v, _)| frame.x.contains(*x) && frame.y.contains(*v)) {
            out.push(Element::circle(at(*x, *v), 2.6).decimals(FINE).fill(colour));
        }
    }
}
