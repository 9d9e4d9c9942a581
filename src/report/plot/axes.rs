//! What a plot shows: a score, its axes, marks.

use super::style::Style;
pub use crate::batch::table_rows::{TILT, TILT_AXIS};
use crate::design::families::Family;
use crate::metrics::Metric;

/// A half-width of 95 in 100, in standard errors.
pub(super) const BAND: f64 = 1.96;

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
    pub fn new(key: &str, family: Option<&Family>) -> Axis {
        if key == TILT {
            return Axis { key: key.into(), title: "tilt (°)".into() };
        }
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
pub struct ScorePlot<'a> {
    /// The score.
    pub metric: &'static Metric,
    /// One axis for a curve, two for a map: the first is drawn across.
    pub axes: &'a [Axis],
    /// The stone that was swept.
    pub stone: &'a str,
    /// Its family.
    pub family: Option<&'static Family>,
    /// Whether it is of diamond, for which alone grading envelopes are published.
    pub is_diamond: bool,
    /// How it is to look.
    pub style: &'a Style,
    /// A stone to be marked above the others: its name and place on the axes.
    pub own: Option<(&'a str, &'a [f64])>,
}

/// A point or a line to be named in a plot.
pub(super) struct ReferenceMark {
    pub(super) name: String,
    pub(super) at: Vec<f64>,
    /// Whether it is the stone that the plot is about.
    pub(super) own: bool,
    /// Parameters that are not on the axes and have another value in this stone than in the plot's.
    pub(super) other: Vec<&'static str>,
}

impl ReferenceMark {
    /// Its name; with a star if it does not belong to the values beside it.
    pub(super) fn label(&self) -> String {
        if self.other.is_empty() { self.name.clone() } else { format!("{} *", self.name) }
    }
}
