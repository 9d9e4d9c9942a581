//! Reference figures: what publications and independent programs say of stones and materials, as data. They
//! stand once, in `figures.csv`; the checks of this module and the tests read them there.

use super::check::{Expected, Figure, FigureSource, SourceKind};
use serde::Deserialize;
use std::sync::LazyLock;

/// The figures, one a line.
const TABLE: &str = include_str!("figures.csv");

/// A figure with its source.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReferenceFigure {
    /// The figures that it is compared with together.
    pub set: String,
    /// The stone or the material that it is a figure of.
    pub of: String,
    /// The value of the parameter that the set varies: an angle or a table, an index, a power.
    pub at: Option<f64>,
    /// The metric, or the quantity in a few words.
    pub quantity: String,
    /// The figure, in `unit`.
    pub expected: f64,
    tolerance: Option<f64>,
    relative_tolerance: Option<f64>,
    /// Its unit; empty for a plain number.
    pub unit: String,
    kind: SourceKind,
    source: String,
}

impl ReferenceFigure {
    /// By how much ours may be off besides its error, in `unit`; 0 where the set leaves it to the check.
    pub fn tolerance(&self) -> f64 {
        self.relative_tolerance.map_or(self.tolerance.unwrap_or(0.0), |share| share * self.expected)
    }

    /// Where it is from.
    pub(super) fn source(&'static self) -> FigureSource {
        FigureSource { kind: self.kind, name: &self.source }
    }

    /// What a check expects, in words of its own.
    pub(super) fn named(&'static self, name: impl Into<String>) -> Figure {
        Figure::new(name, self.source(), Expected::Near(self.expected, self.tolerance())).unit(&self.unit)
    }

    /// The same of a figure in percent whose score is a fraction.
    pub(super) fn share_named(&'static self, name: impl Into<String>) -> Figure {
        let expected = Expected::Near(self.expected / 100.0, self.tolerance() / 100.0);
        Figure::new(name, self.source(), expected)
    }
}

static FIGURES: LazyLock<Vec<ReferenceFigure>> = LazyLock::new(|| {
    // that every line can be read is a test of this file
    csv::Reader::from_reader(TABLE.as_bytes()).deserialize().filter_map(Result::ok).collect()
});

/// The figures of a set, in the order of the file; none if there is no such set.
pub fn set(name: &str) -> Vec<&'static ReferenceFigure> {
    FIGURES.iter().filter(|figure| figure.set == name).collect()
}

/// The figures of a set of one stone or material.
pub fn set_of(name: &str, of: &str) -> Vec<&'static ReferenceFigure> {
    set(name).into_iter().filter(|figure| figure.of == of).collect()
}

/// The stones or materials of a set, each once, in the order of the file.
pub fn subjects(name: &str) -> Vec<&'static str> {
    let mut all: Vec<&str> = set(name).iter().map(|figure| figure.of.as_str()).collect();
    all.dedup();
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_can_be_read_and_has_one_tolerance() {
        let read: Result<Vec<ReferenceFigure>, _> =
            csv::Reader::from_reader(TABLE.as_bytes()).deserialize().collect();
        let read = read.expect("every line is a figure");
        assert_eq!(read.len(), FIGURES.len());
        assert!(read.len() > 150);
        for (i, f) in read.iter().enumerate() {
            assert!(f.tolerance.is_none() || f.relative_tolerance.is_none(), "{f:?}");
            let same = |o: &ReferenceFigure| {
                (&o.set, &o.of, o.at, &o.quantity) == (&f.set, &f.of, f.at, &f.quantity)
            };
            assert!(!read[..i].iter().any(same), "{f:?} stands twice");
        }
    }
}
