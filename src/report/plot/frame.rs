//! The frame of a plot: scales, ticks, titles.

use super::escaped;
use crate::report::raster::{FONTS, text_width};
use std::fmt::Write;

/// The whole drawing, in its own units.
pub const WIDTH: f64 = 800.0;
/// See [`WIDTH`].
pub const HEIGHT: f64 = 600.0;

/// Width and height of a drawing that is to be shown small, with text as large as in others.
pub const SMALL: (f64, f64) = (460.0, 345.0);

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

/// The plot's rectangle with its scales.
#[derive(Debug, Clone, Copy)]
pub struct PlotFrame {
    /// Across.
    pub x: Scale,
    /// Up.
    pub y: Scale,
    /// Width and height of the whole drawing.
    size: (f64, f64),
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
    pub fn new(size: (f64, f64), x: (f64, f64), y: (f64, f64), right: f64) -> PlotFrame {
        let bottom = size.1 - BELOW;
        let ((x0, x1), (y0, y1)) = (widened(x), widened(y));
        PlotFrame {
            x: Scale { from: x0, to: x1, start: LEFT, length: size.0 - right - LEFT },
            y: Scale { from: y0, to: y1, start: bottom, length: TOP - bottom },
            size,
        }
    }

    /// Left, top, width and height of the plot.
    pub fn rectangle(&self) -> (f64, f64, f64, f64) {
        (LEFT, TOP, self.x.length, -self.y.length)
    }

    /// Begins a drawing: title and note above, a clip called `plot`.
    pub fn open(&self, title: &str, note: &str) -> String {
        let (x, y, w, h) = self.rectangle();
        let (width, height) = self.size;
        let size = ((width - x - 12.0) / text_width(note, false)).min(12.0);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             font-family=\"{}\" font-size=\"13\" fill=\"#222\">\n<rect width=\"{width}\" height=\"{height}\" \
             fill=\"#fff\"/>\n<clipPath id=\"plot\"><rect x=\"{x}\" y=\"{y}\" width=\"{w:.1}\" height=\"{h:.1}\"/>\
             </clipPath>\n<text x=\"{x}\" y=\"26\" font-size=\"18\" font-weight=\"bold\">{}</text>\n\
             <text x=\"{x}\" y=\"48\" font-size=\"{size:.1}\" fill=\"#555\">{}</text>\n",
            escaped(FONTS),
            escaped(title),
            escaped(note),
        )
    }

    /// Border, ticks and axis titles; `grid`: with lines across the plot.
    pub fn axes(&self, out: &mut String, x_title: &str, y_title: &str, grid: bool) {
        let (left, top, w, h) = self.rectangle();
        let bottom = top + h;
        for (number, text) in ticks(self.x.from, self.x.to, 9) {
            let x = self.x.position(number);
            if grid {
                let _ = writeln!(out, "<path d=\"M{x:.1} {top}V{bottom}\" stroke=\"#e4e4e4\"/>");
            }
            let _ = writeln!(
                out,
                "<path d=\"M{x:.1} {bottom}v5\" stroke=\"#222\"/>\
                 <text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{text}</text>",
                bottom + 20.0
            );
        }
        for (number, text) in ticks(self.y.from, self.y.to, 9) {
            let y = self.y.position(number);
            if grid {
                let _ = writeln!(out, "<path d=\"M{left} {y:.1}h{w:.1}\" stroke=\"#e4e4e4\"/>");
            }
            let _ = writeln!(
                out,
                "<path d=\"M{left} {y:.1}h-5\" stroke=\"#222\"/>\
                 <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{text}</text>",
                left - 9.0,
                y + 4.5
            );
        }
        let _ = writeln!(
            out,
            "<rect x=\"{left}\" y=\"{top}\" width=\"{w:.1}\" height=\"{h:.1}\" fill=\"none\" stroke=\"#222\"/>\n\
             <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-size=\"14\">{}</text>\n\
             <text transform=\"translate(22 {:.1})rotate(-90)\" text-anchor=\"middle\" font-size=\"14\">{}</text>",
            left + w / 2.0,
            bottom + 46.0,
            escaped(x_title),
            top + h / 2.0,
            escaped(y_title)
        );
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
}
