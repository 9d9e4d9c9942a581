//! Scores along one parameter: lines with their error bands.

use super::frame::{HEIGHT, PlotFrame, SMALL, WIDTH};
use super::{BAND, escaped};
use crate::report::raster::text_width;
use std::fmt::Write;

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
    /// The drawing.
    pub fn svg(&self) -> String {
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
        let frame = PlotFrame::new(size, self.ends[0].unwrap_or(xs), ys, 28.0);
        let mut out = frame.open(&self.title, &self.note);
        let (left, top, _, h) = frame.rectangle();
        let mut named_span = String::new();
        if let Some((name, (from, to))) = self.spans.first() {
            let (from, to) = (from.max(frame.x.from), to.min(frame.x.to));
            if from < to {
                let (a, b) = (frame.x.position(from), frame.x.position(to));
                let _ = writeln!(
                    out,
                    "<rect x=\"{a:.1}\" y=\"{top}\" width=\"{:.1}\" height=\"{h:.1}\" fill=\"#f3eddc\"/>",
                    b - a
                );
                named_span = format!(
                    "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"11\" text-anchor=\"middle\" fill=\"#7a6a3a\" \
                     stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\">envelope of {}</text>\n",
                    (a + b) / 2.0,
                    top + 16.0,
                    escaped(name)
                );
            }
        }
        frame.axes(&mut out, &self.x, &self.y, true);
        self.marks(&frame, &mut out);
        out += &named_span;
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
            let _ = writeln!(
                out,
                "<path d=\"M{:.1} {:.1}h22\" stroke=\"{colour}\" stroke-width=\"2.5\"/>\
                 <text x=\"{:.1}\" y=\"{y:.1}\" stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\">{}</text>",
                left + 12.0,
                y - 4.5,
                left + 40.0,
                escaped(&curve.name)
            );
        }
        out + "</svg>\n"
    }

    /// Places on x that have names; those that stand at one place share it.
    fn marks(&self, frame: &PlotFrame, out: &mut String) {
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
            let _ = writeln!(
                out,
                "<path d=\"M{x:.1} {top}v{h:.1}\" stroke=\"#999\" stroke-dasharray=\"3 4\"/>\
                 <text transform=\"translate({:.1} {:.1})rotate(-90)\" font-size=\"11\" fill=\"#555\" \
                 stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\">{}</text>",
                x - 4.0,
                top + h - start,
                escaped(&names)
            );
        }
    }
}

/// An expected value with its bar.
fn dot(frame: &PlotFrame, d: Dot, out: &mut String) {
    let (x, y) = (frame.x.position(d.x), frame.y.position(d.value));
    let [low, high] = [d.value - d.tolerance, d.value + d.tolerance].map(|v| frame.y.position(v));
    let fill = if d.hollow { "#fff" } else { COLOURS[1] };
    let _ = writeln!(
        out,
        "<path d=\"M{:.2} {low:.2}h10m-5 0V{high:.2}m-5 0h10\" fill=\"none\" stroke=\"{1}\" stroke-width=\"1.4\"/>\
         <circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"4\" fill=\"{fill}\" stroke=\"{1}\" stroke-width=\"1.6\"/>",
        x - 5.0,
        COLOURS[1]
    );
}

/// One unbroken line with its band, and dots if there are few.
fn line(frame: &PlotFrame, run: &[(f64, f64, f64)], colour: &str, out: &mut String) {
    let at = |x: f64, y: f64| format!("{:.2} {:.2}", frame.x.position(x), frame.y.position(y));
    let joined = |points: Vec<String>| points.join("L");
    let upper = run.iter().map(|(x, v, e)| at(*x, v + BAND * e));
    let lower = run.iter().rev().map(|(x, v, e)| at(*x, v - BAND * e));
    let band = joined(upper.chain(lower).collect());
    let middle = joined(run.iter().map(|(x, v, _)| at(*x, *v)).collect());
    let _ = writeln!(
        out,
        "<g clip-path=\"url(#plot)\"><path d=\"M{band}Z\" fill=\"{colour}\" fill-opacity=\"0.22\"/>\
         <path d=\"M{middle}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\" stroke-linejoin=\"round\"/></g>"
    );
    if run.len() <= 60 {
        for (x, v, _) in run.iter().filter(|(x, v, _)| frame.x.contains(*x) && frame.y.contains(*v)) {
            let _ = writeln!(
                out,
                "<circle cx=\"{:.2}\" cy=\"{:.2}\" r=\"2.6\" fill=\"{colour}\"/>",
                frame.x.position(*x),
                frame.y.position(*v)
            );
        }
    }
}
