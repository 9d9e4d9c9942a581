//! The frame of a plot: scales, ticks, titles.

use crate::report::raster::{FONTS, text_width};
use crate::report::svg_canvas::{Anchor, Element, PathData};

/// The whole drawing, in its own units.
pub const WIDTH: f64 = 800.0;
/// See [`WIDTH`].
pub const HEIGHT: f64 = 600.0;

/// Width and height of a drawing that is to be shown small, with text as large as in others.
pub const SMALL: (f64, f64) = (460.0, 345.0);

/// Height of the letters of numbers beside the axes.
const LETTERS: f64 = 13.0;

/// Room above and below the plot.
const TOP: f64 = 64.0;
const BELOW: f64 = 72.0;
const LEFT: f64 = 84.0;

/// Numbers along one direction of the drawing.
#[derive(Debug, Clone, Copy)]
pub struct Scale {
    /// Number at the left or lower end.
    pub from: f64,
    /// Number at the other end.
    pub to: f64,
    start: f64,
    length: f64,
}

impl Scale {
    /// Where a number is.
    pub fn position(&self, x: f64) -> f64 {
        self.start + self.length * (x - self.from) / (self.to - self.from)
    }

    /// Whether a number lies on the scale.
    pub fn contains(&self, x: f64) -> bool {
        let slack = 1e-9 * (self.to - self.from);
        (self.from - slack..=self.to + slack).contains(&x)
    }
}

/// Colour of borders and ticks.
pub const INK: &str = "#222";
/// Colour of lines across the plot.
const GRID: &str = "#e4e4e4";

/// Decimals of coordinates in a plot; its curves have one more.
pub const DECIMALS: usize = 1;

/// The plot's rectangle with its scales.
#[derive(Debug, Clone)]
pub struct PlotFrame {
    /// Across.
    pub x: Scale,
    /// Up.
    pub y: Scale,
    /// Width and height of the whole drawing.
    size: (f64, f64),
    /// Name of the region that what is plotted is cut to.
    pub clip: String,
}

/// A range that is not empty.
pub fn widened((from, to): (f64, f64)) -> (f64, f64) {
    if to - from > 1e-12 * from.abs().max(to.abs()).max(1e-12) {
        (from, to)
    } else {
        let half = (from.abs() * 0.05).max(1e-3);
        (from - half, to + half)
    }
}

impl PlotFrame {
    /// A frame for these ranges.
    ///
    /// - `size`: width and height of the drawing; `right`: room beside the plot
    /// - `clip`: [`PlotFrame::clip`]
    pub fn new(size: (f64, f64), x: (f64, f64), y: (f64, f64), right: f64, clip: &str) -> PlotFrame {
        let bottom = size.1 - BELOW;
        let ((x0, x1), (y0, y1)) = (widened(x), widened(y));
        PlotFrame {
            x: Scale { from: x0, to: x1, start: LEFT, length: size.0 - right - LEFT },
            y: Scale { from: y0, to: y1, start: bottom, length: TOP - bottom },
            size,
            clip: clip.into(),
        }
    }

    /// Left, top, width and height of the plot.
    pub fn rectangle(&self) -> (f64, f64, f64, f64) {
        (LEFT, TOP, self.x.length, -self.y.length)
    }

    /// Begins a drawing: title and note above, the region of the plot.
    pub fn open(&self, title: &str, note: &str) -> Element {
        let (x, y, w, h) = self.rectangle();
        let size = ((self.size.0 - x - 12.0) / text_width(note, false)).min(12.0);
        Element::drawing((0.0, 0.0), self.size)
            .decimals(DECIMALS)
            .attribute("font-family", FONTS)
            .font_size(LETTERS)
            .fill("#222")
            .with(Element::rect((0.0, 0.0), self.size).fill("#fff"))
            .with(Element::clip_region(&self.clip, Element::rect((x, y), (w, h))))
            .with(Element::text((x, 26.0), title).font_size(18.0).bold())
            .with(Element::text((x, 48.0), note).font_size(size).fill("#555"))
    }

    /// Border, ticks and axis titles; `grid`: with lines across the plot.
    pub fn axes(&self, drawing: &mut Element, x_title: &str, y_title: &str, grid: bool) {
        let (left, top, w, h) = self.rectangle();
        let bottom = top + h;
        let line = |path: PathData, colour| Element::path(path).stroke(colour, 1.0);
        let path = || PathData::new(DECIMALS);
        // as many as have room for their numbers
        let across = |parts| ticks(self.x.from, self.x.to, parts);
        let have_room = |ticks: &Vec<(f64, String)>| {
            let widest = ticks.iter().map(|(_, text)| text_width(text, false)).fold(0.0, f64::max);
            let gap = ticks.windows(2).map(|t| self.x.position(t[1].0) - self.x.position(t[0].0));
            gap.fold(f64::INFINITY, f64::min) > LETTERS * widest + 6.0
        };
        for (number, text) in (2..=9).rev().map(across).find(have_room).unwrap_or_else(|| across(2)) {
            let x = self.x.position(number);
            if grid {
                drawing.push(line(path().down((x, top), h), GRID));
            }
            drawing.push(line(path().down((x, bottom), 5.0), INK));
            drawing.push(Element::text((x, bottom + 20.0), &text).anchor(Anchor::Middle));
        }
        for (number, text) in ticks(self.y.from, self.y.to, 9) {
            let y = self.y.position(number);
            if grid {
                drawing.push(line(path().across((left, y), w), GRID));
            }
            drawing.push(line(path().across((left, y), -5.0), INK));
            drawing.push(Element::text((left - 9.0, y + 4.5), &text).anchor(Anchor::End));
        }
        drawing.push(Element::rect((left, top), (w, h)).fill("none").stroke(INK, 1.0));
        let title = |text: Element| text.anchor(Anchor::Middle).font_size(14.0);
        drawing.push(title(Element::text((left + w / 2.0, bottom + 46.0), x_title)));
        drawing.push(title(Element::turned_text((22.0, top + h / 2.0), -90.0, y_title)));
    }
}

/// The step of 1, 2 or 5 times a power of ten that divides a range into about `parts`.
pub fn step(from: f64, to: f64, parts: usize) -> f64 {
    let rough = (to - from) / parts as f64;
    let power = 10f64.powf(rough.log10().floor());
    let of = rough / power;
    power
        * if of < 1.5 {
            1.0
        } else if of < 3.5 {
            2.0
        } else if of < 7.5 {
            5.0
        } else {
            10.0
        }
}

/// Round numbers from `from` to `to`, about `parts` of them, with their text.
pub fn ticks(from: f64, to: f64, parts: usize) -> Vec<(f64, String)> {
    let step = step(from, to, parts);
    let digits = (-step.log10().floor()).max(0.0) as usize;
    let first = (from / step - 1e-6).ceil();
    (0..200)
        .map(|i| (first + f64::from(i)) * step)
        .take_while(|x| *x <= to + 1e-6 * step)
        .map(|x| {
            let text = format!("{x:.digits$}");
            let zero = text.trim_start_matches('-').chars().all(|c| "0.".contains(c));
            (x, if zero { text.trim_start_matches('-').into() } else { text.replace('-', "−") })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        let texts = |from, to, parts| ticks(from, to, parts).into_iter().map(|t| t.1).collect::<Vec<_>>();
        assert_eq!(texts(0.0, 1.0, 5), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(texts(-10.0, 10.0, 4), ["−10", "−5", "0", "5", "10"]);
        assert_eq!(texts(0.2513, 0.2538, 5), ["0.2515", "0.2520", "0.2525", "0.2530", "0.2535"]);
        assert!(ticks(30.0, 38.0, 9).iter().all(|(x, _)| (30.0..=38.0).contains(x)));
    }

    #[test]
    fn numbers_below_the_axis_do_not_touch() {
        for (from, to) in [(0.87, 1.15), (-20.0, 20.0), (0.0, 200.0), (-0.0123, -0.0119), (1e5, 1.00001e5)] {
            let frame = PlotFrame::new(SMALL, (from, to), (0.0, 1.0), 28.0, "plot");
            let mut drawing = frame.open("", "");
            frame.axes(&mut drawing, "x", "y", true);
            let svg = drawing.document();
            let document = roxmltree::Document::parse(&svg).expect("is XML");
            let (_, top, _, h) = frame.rectangle();
            let base = format!("{}", top + h + 20.0);
            let numbers = document.descendants().filter(|n| n.attribute("y") == Some(&base));
            let at = |n: roxmltree::Node| -> Option<(f64, f64)> {
                Some((n.attribute("x")?.parse().ok()?, 13.0 * text_width(n.text()?, false)))
            };
            let spans: Vec<(f64, f64)> = numbers.filter_map(at).collect();
            assert!(spans.len() > 1, "{from} to {to}: {svg}");
            let apart = |w: &[(f64, f64)]| w[1].0 - w[0].0 > 0.5 * (w[0].1 + w[1].1);
            assert!(spans.windows(2).all(apart), "{from} to {to}: {spans:?}");
        }
    }
}
