//! Plots of sweeps as SVG: a score along one parameter, or over two.

mod curve;
mod frame;
mod map;
mod surface;

pub use curve::{Curve, Curves, Dot};

use super::page::escaped;
use crate::cut::brilliant;
use crate::cut::families::Family;
use crate::cut::library;
use crate::metrics::Metric;
use crate::study::table::Numbers;

/// Pixels across a plot that becomes a picture.
pub const PIXELS: u32 = 1600;

/// A half-width of 95 in 100, in standard errors.
const BAND: f64 = 1.96;

/// A parameter along an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Its key: the column of the table.
    pub key: String,
    /// What stands along the axis, with the unit.
    pub title: String,
}

impl Axis {
    /// The axis of the parameter `key`, of a family or of every stone.
    pub fn of(key: &str, family: Option<&Family>) -> Axis {
        let parameter = family.and_then(|f| f.parameters.iter().find(|p| p.key == key));
        let name = if key == "ri" { "refractive index".into() } else { key.replace('-', " ") };
        let unit = match (parameter.map(|p| p.unit.trim()), key) {
            (Some(""), _) | (None, "ri") => String::new(),
            (None, "size") => " (mm)".into(),
            (unit, _) => unit.map_or(String::new(), |u| format!(" ({u})")),
        };
        Axis { key: key.into(), title: format!("{name}{unit}") }
    }
}

/// What is to be drawn.
#[derive(Clone, Copy)]
pub struct Drawing<'a> {
    /// The score.
    pub metric: &'static Metric,
    /// One axis for a curve, two for a map: the first is drawn across.
    pub axes: &'a [Axis],
    /// The stone that was swept.
    pub stone: &'a str,
    /// Its family.
    pub family: Option<&'static Family>,
    /// A stone to be marked above the others: its name and place on the axes.
    pub own: Option<(&'a str, &'a [f64])>,
}

/// A point or a line to be named in a plot.
struct Mark {
    name: String,
    at: Vec<f64>,
    /// Whether it is the stone that the plot is about.
    own: bool,
}

impl Drawing<'_> {
    /// The plot of a sweep's table.
    ///
    /// - `scattered`: the points are no grid
    ///
    /// Points whose stone failed are left out. Looked at in `reports/sweeps/`.
    pub fn svg(&self, numbers: &Numbers, scattered: bool) -> String {
        match self.axes {
            [x, y] => map::svg(self, x, y, numbers, scattered),
            [x, ..] => self.curve(x, numbers),
            [] => String::new(),
        }
    }

    fn curve(&self, x: &Axis, numbers: &Numbers) -> String {
        let se = format!("{}_se", self.metric.name);
        let columns = numbers.column(&x.key).iter().zip(numbers.column(self.metric.name));
        let mut points: Vec<(f64, Option<(f64, f64)>)> = columns
            .zip(numbers.column(&se))
            .filter_map(|((x, value), error)| Some(((*x)?, value.zip(*error))))
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Curves {
            title: format!("{} of {}", self.metric.name, self.stone),
            note: format!("{}; band: 95 in 100", self.metric.about),
            x: x.title.clone(),
            y: self.score_title(),
            curves: vec![Curve { name: String::new(), points }],
            spans: self
                .envelopes(std::slice::from_ref(x))
                .into_iter()
                .map(|(name, b)| (name, b[0]))
                .collect(),
            marks: self.marks().into_iter().map(|m| (m.name, m.at[0])).collect(),
            dots: Vec::new(),
            small: false,
        }
        .svg()
    }

    /// The score's name with its unit.
    fn score_title(&self) -> String {
        let unit = self.metric.unit;
        if unit.is_empty() { self.metric.name.into() } else { format!("{} ({unit})", self.metric.name) }
    }

    /// Stones of the library that the swept stone's family makes, where their parameters put them.
    /// Other parameters of theirs may differ from the swept stone's.
    fn marks(&self) -> Vec<Mark> {
        let Some(family) = self.family else { return Vec::new() };
        let mark = |name: &'static str| {
            let document = library::document(name)?.ok()?;
            if document.family.as_deref() != Some(family.name) {
                return None;
            }
            let value = |axis: &Axis| {
                let default = || family.parameters.iter().find(|p| p.key == axis.key).map(|p| p.default);
                document.parameters.get(&axis.key).copied().or_else(default)
            };
            let at = self.axes.iter().map(value).collect::<Option<_>>()?;
            Some(Mark {
                name: if name == family.name { "reference".into() } else { name.into() },
                at,
                own: false,
            })
        };
        let own = self.own.map(|(name, at)| Mark { name: name.into(), at: at.to_vec(), own: true });
        let near = |a: &Mark, b: &Mark| a.at.iter().zip(&b.at).all(|(a, b)| (a - b).abs() < 0.005);
        let mut marks: Vec<Mark> = Vec::new();
        for mark in own.into_iter().chain(library::names().filter_map(mark)) {
            match marks.iter_mut().find(|m| near(m, &mark)) {
                Some(same) => same.name += &format!(", {}", mark.name),
                None => marks.push(mark),
            }
        }
        marks
    }

    /// The cut-grade envelopes of the round brilliant that bound every axis, the narrowest first.
    fn envelopes(&self, axes: &[Axis]) -> Vec<(String, Vec<(f64, f64)>)> {
        if self.family.is_none_or(|f| f.name != "round-brilliant") {
            return Vec::new();
        }
        let mut found: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
        for axis in axes {
            for (name, from, to) in brilliant::bounds(&axis.key) {
                match found.iter_mut().find(|(n, _)| n == name) {
                    Some((_, bounds)) => bounds.push((from, to)),
                    None => found.push((name.into(), vec![(from, to)])),
                }
            }
        }
        found.retain(|(_, bounds)| bounds.len() == axes.len());
        found
    }
}
