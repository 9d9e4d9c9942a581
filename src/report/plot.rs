//! Plots as SVG: of sweeps a score along one parameter, or over two; of searches their candidates.

mod axes;
mod curve;
mod frame;
mod map;
mod scatter;
mod style;
mod surface;

use crate::design::gia_envelopes;
pub use axes::{Axis, ScorePlot, TILT, TILT_AXIS};
use axes::{BAND, ReferenceMark};
pub use curve::{Curves, Dot, PlotCurve};
pub use scatter::{NamedPoint, PointSet, Scatter};
pub use style::{ColourScale, Style};

use crate::batch::table::NumericColumns;
use crate::design::library;
use crate::stone::grammar;

/// Pixels across a plot that becomes a picture.
pub const PIXELS: u32 = 1600;

/// Parameters that say how large a stone is, or how many facets its girdle has: no score of a clear
/// stone follows them by more than a hundredth.
const MINOR: [&str; 3] = ["size", "facets", "girdle-facets"];

impl ScorePlot<'_> {
    /// The plot of a sweep's table.
    ///
    /// - `scattered`: the points are no grid
    /// - `curves`: columns that tell the curves of one parameter apart
    ///
    /// Points whose stone failed are left out. Looked at in `reports/sweeps/`.
    pub fn svg(&self, numbers: &NumericColumns, scattered: bool, curves: &[String]) -> String {
        match self.axes {
            [x, y] => map::svg(self, x, y, numbers, scattered),
            [x, ..] => self.curve(x, numbers, curves),
            [] => String::new(),
        }
    }

    fn curve(&self, x: &Axis, numbers: &NumericColumns, curves: &[String]) -> String {
        let se = format!("{}_se", self.metric.name);
        let mut lines: Vec<PlotCurve> = Vec::new();
        let columns = numbers.column(&x.key).iter().zip(numbers.column(self.metric.name));
        for (row, ((at, value), error)) in columns.zip(numbers.column(&se)).enumerate() {
            let Some(at) = *at else { continue };
            let called = |column: &String| {
                let cell = numbers.texts(column).get(row).map_or("", String::as_str);
                if column == TILT_AXIS {
                    format!("axis at {}°", cell.trim_end_matches(".0"))
                } else {
                    cell.into()
                }
            };
            let name = curves.iter().map(called).collect::<Vec<_>>().join(", ");
            let point = (at, value.zip(*error));
            match lines.iter_mut().find(|line| line.name == name) {
                Some(line) => line.points.push(point),
                None => lines.push(PlotCurve { name, points: vec![point] }),
            }
        }
        lines.iter_mut().for_each(|line| line.points.sort_by(|a, b| a.0.total_cmp(&b.0)));
        Curves {
            title: self.title(),
            note: format!("{}; band: 95 in 100{}", self.metric.about, self.other_note()),
            x: x.title.clone(),
            y: self.score_title(),
            curves: lines,
            spans: self
                .envelopes(std::slice::from_ref(x))
                .into_iter()
                .map(|(name, b)| (name, b[0]))
                .collect(),
            marks: self.marks().into_iter().map(|m| (m.label(), m.at[0])).collect(),
            ends: [self.style.range(&x.key), self.style.range(self.metric.name)],
            dots: Vec::new(),
            small: false,
        }
        .svg()
    }

    /// The title asked for, or the names of score and stone.
    fn title(&self) -> String {
        let of = if self.stone.is_empty() { String::new() } else { format!(" of {}", self.stone) };
        self.style.title.clone().unwrap_or_else(|| format!("{}{of}", self.metric.name))
    }

    /// The score's name with its unit.
    fn score_title(&self) -> String {
        let unit = self.metric.unit;
        if unit.is_empty() { self.metric.name.into() } else { format!("{} ({unit})", self.metric.name) }
    }

    /// The value of a parameter in the stone that the plot is about.
    fn held(&self, key: &str) -> Option<f64> {
        let (name, items) = self.stone.split_once(':').unwrap_or((self.stone, ""));
        let given = grammar::parameters_of(items).ok()?.get(key).copied();
        let document = library::document(name).and_then(Result::ok);
        given.or_else(|| document?.parameters.get(key).copied()).or_else(|| self.default_of(key))
    }

    fn default_of(&self, key: &str) -> Option<f64> {
        self.family?.parameters.iter().find(|p| p.key == key).map(|p| p.default)
    }

    /// What is said below the title of stones whose other parameters differ.
    fn other_note(&self) -> String {
        let mut keys: Vec<&str> = self.marks().iter().flat_map(|m| m.other.clone()).collect();
        keys.sort_unstable();
        keys.dedup();
        if keys.is_empty() { String::new() } else { format!("; * with another {}", keys.join(", ")) }
    }

    /// Stones of the library that the swept stone's family makes, where their parameters put them.
    fn marks(&self) -> Vec<ReferenceMark> {
        let Some(family) = self.family else { return Vec::new() };
        let mark = |name: &'static str| {
            let document = library::document(name)?.ok()?;
            if document.family.as_deref() != Some(family.name) {
                return None;
            }
            let value = |key: &str| document.parameters.get(key).copied().or_else(|| self.default_of(key));
            let at = self.axes.iter().map(|axis| value(&axis.key)).collect::<Option<_>>()?;
            let is_axis = |key: &str| self.axes.iter().any(|axis| axis.key == key);
            let differs =
                |key: &str| value(key).zip(self.held(key)).is_some_and(|(a, b)| (a - b).abs() > 1e-6);
            let other = family.parameters.iter().map(|p| p.key);
            Some(ReferenceMark {
                name: if name == family.name { "reference".into() } else { name.into() },
                at,
                own: false,
                other: other.filter(|key| !MINOR.contains(key) && !is_axis(key) && differs(key)).collect(),
            })
        };
        let own = self.own.map(|(name, at)| ReferenceMark {
            name: name.into(),
            at: at.to_vec(),
            own: true,
            other: vec![],
        });
        let near = |a: &ReferenceMark, b: &ReferenceMark| {
            let same_place = a.at.iter().zip(&b.at).all(|(a, b)| (a - b).abs() < 0.005);
            same_place && a.other.is_empty() == b.other.is_empty()
        };
        let mut marks: Vec<ReferenceMark> = Vec::new();
        for mark in own.into_iter().chain(library::names().filter_map(mark)) {
            match marks.iter_mut().find(|m| near(m, &mark)) {
                Some(same) => {
                    same.name += &format!(", {}", mark.name);
                    same.other.extend(mark.other);
                }
                None => marks.push(mark),
            }
        }
        marks
    }

    /// The cut-grade envelopes that bound every axis, the narrowest first; none but for round brilliants of
    /// diamond.
    fn envelopes(&self, axes: &[Axis]) -> Vec<(String, Vec<(f64, f64)>)> {
        if !self.is_diamond || self.family.is_none_or(|f| f.name != "round-brilliant") {
            return Vec::new();
        }
        let mut found: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
        for axis in axes {
            for (name, from, to) in gia_envelopes::bounds(&axis.key) {
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
