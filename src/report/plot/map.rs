//! A score over two parameters: coloured bands, labelled contours, marks.

use super::frame::{DECIMALS, HEIGHT, INK, PlotFrame, WIDTH, step, ticks};
use super::surface::ScoreSurface;
use super::{Axis, ColourScale, ScorePlot};
use crate::batch::table::NumericColumns;
use crate::report::raster::text_width;
use crate::report::svg_canvas::{Anchor, Element, PathData};
use contour::ContourBuilder;

/// Where the plot ends and the colour scale begins.
const RIGHT: f64 = 660.0;
const BAR: (f64, f64) = (684.0, 18.0);

/// Bands between the least and the greatest value, about.
const BANDS: usize = 12;

/// A closed contour shorter than this has no label.
const SHORT: f64 = 160.0;

/// Name of the region of what is known, where that is not all of the plot.
const KNOWN: &str = "known";

/// A box that text takes up: middle, half width, half height.
type TakenBox = (f64, f64, f64, f64);

/// The map of the drawing's metric over `x` and `y`.
pub fn svg(drawing: &ScorePlot, x: &Axis, y: &Axis, numbers: &NumericColumns, scattered: bool) -> String {
    let (name, se) = (drawing.metric.name, format!("{}_se", drawing.metric.name));
    let points: Vec<(f64, f64, Option<f64>)> = numbers
        .column(&x.key)
        .iter()
        .zip(numbers.column(&y.key))
        .zip(numbers.column(name))
        .filter_map(|((x, y), value)| Some(((*x)?, (*y)?, *value)))
        .collect();
    let surface =
        if scattered { ScoreSurface::from_scattered(&points) } else { ScoreSurface::from_grid(&points) };
    let ends = surface.as_ref().map_or(((0.0, 1.0), (0.0, 1.0)), |s| (s.x, s.y));
    let style = drawing.style;
    let across = style.range(&x.key).unwrap_or(ends.0);
    let up = style.range(&y.key).unwrap_or(ends.1);
    let frame = PlotFrame::new((WIDTH, HEIGHT), across, up, WIDTH - RIGHT, "plot");
    let worst = numbers.column(&se).iter().flatten().copied().fold(0.0, f64::max);
    let how =
        if scattered { format!(", {} points by natural neighbours", points.len()) } else { String::new() };
    let other = drawing.other_note();
    let note = format!("standard error up to {worst:.1e}{how}{other}; {}", drawing.metric.about);
    let mut out = frame.open(&drawing.title(), &note);
    let levels = surface.as_ref().and_then(|s| Some((s, s.value_range()?)));
    match levels {
        Some((surface, reach)) => {
            let scale = Levels::new(style.range(name).unwrap_or(reach), style.colours);
            let contours = scale.draw(&frame, surface, &mut out);
            let covered = cover(&frame, surface, &mut out);
            if scattered {
                let seen = |x: f64, y: f64| frame.x.contains(x) && frame.y.contains(y);
                for (x, y, _) in points.iter().filter(|p| p.2.is_some() && seen(p.0, p.1)) {
                    let at = (frame.x.position(*x), frame.y.position(*y));
                    out.push(Element::circle(at, 1.1).fill("#0008"));
                }
            }
            envelopes(drawing, &frame, &[x.clone(), y.clone()], &mut out);
            let mut taken = marks(drawing, &frame, &mut out);
            taken.extend(covered);
            scale.label(&frame, &contours, &mut taken, &mut out);
            scale.bar(&frame, &drawing.score_title(), &mut out);
        }
        None => out.push(Element::text((370.0, 300.0), "no values to draw").anchor(Anchor::Middle)),
    }
    frame.axes(&mut out, &x.title, &y.title, false);
    out.document()
}

/// The values at which contours run.
struct Levels {
    from: f64,
    to: f64,
    at: Vec<(f64, String)>,
    colours: ColourScale,
}

impl Levels {
    fn new((from, to): (f64, f64), colours: ColourScale) -> Levels {
        let (from, to) = super::frame::widened((from, to));
        let step = step(from, to, BANDS);
        Levels {
            from,
            to,
            at: ticks(from, to, BANDS).into_iter().filter(|(v, _)| *v > from + 0.01 * step).collect(),
            colours,
        }
    }

    fn colour(&self, value: f64) -> String {
        self.colours.colour((value - self.from) / (self.to - self.from))
    }

    /// The middle of the band above level number `i`, counted from −1: below the first.
    fn middle(&self, i: usize) -> f64 {
        let end = |i: usize| self.at.get(i).map_or(self.to, |l| l.0);
        let start = if i == 0 { self.from } else { self.at[i - 1].0 };
        (start + end(i)) / 2.0
    }

    /// Fills the bands and draws the contours; every contour's level and points, in the drawing.
    fn draw(
        &self,
        frame: &PlotFrame,
        surface: &ScoreSurface,
        out: &mut Element,
    ) -> Vec<(usize, Vec<(f64, f64)>)> {
        let (left, top, w, h) = known(frame, surface);
        let ground = || Element::rect((left, top), (w, h));
        let clip = match (left, top, w, h) == frame.rectangle() {
            true => &frame.clip,
            false => {
                out.push(Element::clip_region(KNOWN, ground()));
                KNOWN
            }
        };
        let mut bands = Element::group().clip(clip).with(ground().fill(self.colour(self.middle(0))));
        let (dx, dy) = surface.steps();
        let builder = ContourBuilder::new(surface.size.0, surface.size.1, true)
            .x_origin(surface.x.0 - dx / 2.0) // a value stands in the middle of its cell
            .y_origin(surface.y.0 - dy / 2.0)
            .x_step(dx)
            .y_step(dy);
        let thresholds: Vec<f64> = self.at.iter().map(|l| l.0).collect();
        let areas = builder.contours(&surface.filled(self.from), &thresholds).unwrap_or_default();
        let mut lines = Vec::new();
        for (i, area) in areas.iter().enumerate() {
            let mut path = PathData::new(DECIMALS);
            for polygon in &area.geometry().0 {
                for ring in std::iter::once(polygon.exterior()).chain(polygon.interiors()) {
                    let points: Vec<(f64, f64)> =
                        ring.coords().map(|c| (frame.x.position(c.x), frame.y.position(c.y))).collect();
                    path = path.polygon(points.iter().copied());
                    lines.push((i, points));
                }
            }
            let band = Element::path(path).fill(self.colour(self.middle(i + 1)));
            let band = band.attribute("fill-rule", "evenodd").stroke("#000", 0.8);
            bands.push(band.number("stroke-opacity", 0.55));
        }
        out.push(bands);
        lines
    }

    /// Writes the level along each contour once, where it runs straight and nothing else stands.
    fn label(
        &self,
        frame: &PlotFrame,
        lines: &[(usize, Vec<(f64, f64)>)],
        taken: &mut Vec<TakenBox>,
        out: &mut Element,
    ) {
        let (left, top, w, h) = frame.rectangle();
        for (level, points) in lines {
            let text = &self.at[*level].1;
            let length: f64 = points.windows(2).map(|p| (p[1].0 - p[0].0).hypot(p[1].1 - p[0].1)).sum();
            let half = 5.5 * text_width(text, false) + 2.0;
            let inside = |(x, y): (f64, f64), room: f64| {
                (left + room..left + w - room).contains(&x) && (top + room..top + h - room).contains(&y)
            };
            let mut best: Option<(f64, (f64, f64), f64)> = None;
            if length < SHORT {
                continue;
            }
            for i in 0..points.len() {
                let middle = points[i];
                if !inside(middle, half + 6.0)
                    || taken.iter().any(|t| overlap(*t, (middle.0, middle.1, half, half)))
                {
                    continue;
                }
                let (Some(a), Some(b)) =
                    (point_at_distance(points, i, half, false), point_at_distance(points, i, half, true))
                else {
                    continue;
                };
                let (dx, dy) = (b.0 - a.0, b.1 - a.1);
                let straight = dx.hypot(dy) / (2.0 * half);
                if best.is_none_or(|(s, ..)| straight > s + 0.02) {
                    best = Some((straight, middle, dy.atan2(dx).to_degrees()));
                }
            }
            if let Some((_, (x, y), angle)) = best.filter(|b| b.0 > 0.9) {
                let upright = if angle > 90.0 {
                    angle - 180.0
                } else if angle < -90.0 {
                    angle + 180.0
                } else {
                    angle
                };
                taken.push((x, y, half + 8.0, half.max(8.0)));
                let label = Element::turned_text((x, y), upright, text).length("y", 4.0);
                let label = label.font_size(11.0).anchor(Anchor::Middle).halo("#fff", 3.0);
                out.push(label.number("stroke-opacity", 0.8).round_joins());
            }
        }
    }

    /// The colour scale beside the plot.
    fn bar(&self, frame: &PlotFrame, title: &str, out: &mut Element) {
        let (_, top, _, h) = frame.rectangle();
        let at = |value: f64| top + h * (1.0 - (value - self.from) / (self.to - self.from));
        let (x, w) = BAR;
        for i in 0..=self.at.len() {
            let low = if i == 0 { self.from } else { self.at[i - 1].0 };
            let high = self.at.get(i).map_or(self.to, |l| l.0);
            let band = Element::rect((x, at(high)), (w, at(low) - at(high)));
            out.push(band.fill(self.colour(self.middle(i))));
        }
        for (value, text) in &self.at {
            let y = at(*value);
            let tick = PathData::new(DECIMALS).across((x + w, y), 5.0);
            out.push(Element::path(tick).stroke(INK, 1.0));
            out.push(Element::text((x + w + 9.0, y + 4.5), text));
        }
        out.push(Element::rect((x, top), (w, h)).fill("none").stroke(INK, 1.0));
        let title = Element::turned_text((WIDTH - 24.0, top + h / 2.0), -90.0, title);
        out.push(title.anchor(Anchor::Middle).font_size(14.0));
    }
}

/// Left, top, width and height of what is known of the surface within the plot.
fn known(frame: &PlotFrame, surface: &ScoreSurface) -> (f64, f64, f64, f64) {
    let (left, top, w, h) = frame.rectangle();
    let ends = |at: [f64; 2], from: f64, to: f64| at.map(|x| x.clamp(from, to));
    let [x0, x1] = ends([frame.x.position(surface.x.0), frame.x.position(surface.x.1)], left, left + w);
    let [y1, y0] = ends([frame.y.position(surface.y.0), frame.y.position(surface.y.1)], top, top + h);
    let whole = [x0 - left, y0 - top, left + w - x1, top + h - y1].iter().all(|gap| gap.abs() < 1e-6);
    if whole { (left, top, w, h) } else { (x0, y0, x1 - x0, y1 - y0) }
}

/// The point of a closed line at `distance` from point `i`, forward or backward along it.
fn point_at_distance(points: &[(f64, f64)], i: usize, distance: f64, forward: bool) -> Option<(f64, f64)> {
    let from = points[i];
    (1..points.len())
        .map(|k| points[if forward { i + k } else { i + points.len() - k } % points.len()])
        .find(|p| (p.0 - from.0).hypot(p.1 - from.1) >= distance)
}

fn overlap(a: TakenBox, b: TakenBox) -> bool {
    (a.0 - b.0).abs() < a.2 + b.2 && (a.1 - b.1).abs() < a.3 + b.3
}

/// Greys out the cells without a value; what they take up.
fn cover(frame: &PlotFrame, surface: &ScoreSurface, out: &mut Element) -> Vec<TakenBox> {
    let mut taken = Vec::new();
    let (dx, dy) = surface.steps();
    let (w, h) =
        ((frame.x.position(dx) - frame.x.position(0.0)), (frame.y.position(0.0) - frame.y.position(dy)));
    for (column, row) in surface.holes() {
        let x = frame.x.position(surface.x.0 + dx * column as f64);
        let y = frame.y.position(surface.y.0 + dy * (row + 1) as f64);
        out.push(Element::rect((x, y), (w + 0.3, h + 0.3)).fill("#eee"));
        taken.push((x + w / 2.0, y + h / 2.0, w / 2.0, h / 2.0));
    }
    taken
}

/// The cut-grade envelopes as rectangles, named in a corner.
fn envelopes(drawing: &ScorePlot, frame: &PlotFrame, axes: &[Axis], out: &mut Element) {
    let (left, top, w, h) = frame.rectangle();
    for (name, bounds) in drawing.envelopes(axes) {
        let [(x0, x1), (y0, y1)] = bounds[..] else { continue };
        let (x0, x1, y0, y1) =
            (frame.x.position(x0), frame.x.position(x1), frame.y.position(y1), frame.y.position(y0));
        if x1 <= left || x0 >= left + w || y1 <= top || y0 >= top + h {
            continue;
        }
        let covers = x0 <= left && x1 >= left + w && y0 <= top && y1 >= top + h;
        if covers {
            continue;
        }
        let (tx, ty) = (x0.max(left) + 5.0, y0.max(top) + 14.0);
        let border = Element::rect((x0, y0), (x1 - x0, y1 - y0)).clip(&frame.clip).fill("none");
        out.push(border.stroke("#fff", 2.0).attribute("stroke-dasharray", "7 4"));
        let name = Element::text((tx, ty), &format!("envelope of {name}")).font_size(11.0);
        out.push(name.fill("#fff").halo("#000", 2.5).number("stroke-opacity", 0.6));
    }
}

/// Stones of the library; what their names take up.
fn marks(drawing: &ScorePlot, frame: &PlotFrame, out: &mut Element) -> Vec<TakenBox> {
    let (left, _, w, _) = frame.rectangle();
    let mut taken = Vec::new();
    for mark in drawing.marks() {
        if !frame.x.contains(mark.at[0]) || !frame.y.contains(mark.at[1]) {
            continue;
        }
        let (x, y) = (frame.x.position(mark.at[0]), frame.y.position(mark.at[1]));
        let name = mark.label();
        let width = 11.0 * text_width(&name, true);
        let to_left = x + 10.0 + width > left + w;
        let middle = if to_left { x - 9.0 - width / 2.0 } else { x + 9.0 + width / 2.0 };
        let free = |dy: &&f64| !taken.iter().any(|t| overlap(*t, (middle, y + **dy, width / 2.0, 7.0)));
        let dy = [0.0, -13.0, 13.0, -26.0, 26.0].iter().find(free).copied().unwrap_or(0.0);
        taken.push((middle, y + dy, width / 2.0 + 3.0, 8.0));
        taken.push((x, y, 6.0, 6.0));
        let fill = match (mark.own, mark.other.is_empty()) {
            (true, _) => "#e8352e",
            (false, true) => "#fff",
            (false, false) => "none", // its score is not the map's at this place
        };
        let radius = if mark.own { 6.5 } else { 4.0 };
        out.push(Element::circle((x, y), radius).fill(fill).stroke("#000", 1.2));
        let (start, anchor) = if to_left { (x - 9.0, Anchor::End) } else { (x + 9.0, Anchor::Start) };
        let name = Element::text((start, y + dy + 4.0), &name).font_size(11.0).bold().anchor(anchor);
        let name = name.fill("#fff").halo("#000", 3.0).number("stroke-opacity", 0.7);
        out.push(name.round_joins());
    }
    taken
}
