//! The catalogue of scores: the tables of all estimators as one list.

use crate::estimators::ESTIMATORS;
pub use crate::estimators::kind::{Better, Metric, MetricSource};
use crate::parse;
pub use crate::sampling::statistic::Statistic;
use serde::{Deserialize, Deserializer};
use std::borrow::Cow;
use std::sync::LazyLock;

/// Metrics whose columns come first, in the order in which published tables have them; the others follow in
/// the order of [`ESTIMATORS`]. New metrics need no row.
const FIRST_COLUMNS: [&str; 35] = [
    "wlr",
    "light_return",
    "leakage",
    "leakage_strongest",
    "glare",
    "absorbed",
    "lost",
    "brightness",
    "aset_green",
    "aset_red",
    "aset_blue",
    "aset_leak",
    "aset_green_strongest",
    "aset_red_strongest",
    "aset_blue_strongest",
    "aset_leak_strongest",
    "ideal_scope_red",
    "ideal_scope_white",
    "ideal_scope_black",
    "fire_lit",
    "fire_streak",
    "dispersion_mean",
    "dispersion_median",
    "contrast",
    "scintillation",
    "iso",
    "cos",
    "sc2",
    "table_iso",
    "table_cos",
    "table_sc2",
    "windowing",
    "extinction",
    "spread",
    "weight_ratio",
];

/// Every metric, in the order of the columns.
///
/// ```
/// use cutlab::METRICS;
///
/// assert_eq!(METRICS[0].name, "wlr");
/// for metric in METRICS.iter().filter(|metric| metric.unit == "%") {
///     println!("{}: {}", metric.name, metric.about_and_better());
/// }
/// ```
pub static METRICS: LazyLock<Vec<&'static Metric>> = LazyLock::new(|| {
    let place = |m: &&Metric| FIRST_COLUMNS.iter().position(|name| *name == m.name);
    let mut all: Vec<&Metric> = ESTIMATORS.iter().flat_map(|e| e.kind.metrics()).collect();
    all.sort_by_key(|m| place(m).unwrap_or(FIRST_COLUMNS.len()));
    all
});

/// A name that no metric has.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("no metric is called '{name}'{} (all: cutlab list metrics)", parse::did_you_mean(*.nearest))]
pub struct NoSuchMetric {
    /// The name.
    pub name: String,
    /// The metric that is probably meant.
    pub nearest: Option<&'static str>,
}

impl Metric {
    /// What it tells, and which values are the better.
    pub fn about_and_better(&self) -> String {
        match self.better.said() {
            "" => self.about.into(),
            said => format!("{}; {said}", self.about),
        }
    }

    /// The metric called `name`; the error has the name that is probably meant.
    pub fn named(name: &str) -> Result<&'static Metric, NoSuchMetric> {
        let nearest = || parse::nearest_name(name, METRICS.iter().map(|m| m.name));
        let none = || NoSuchMetric { name: name.trim().into(), nearest: nearest() };
        Metric::by_name(name).ok_or_else(none)
    }

    /// The metric called `name`, or none.
    pub fn by_name(name: &str) -> Option<&'static Metric> {
        METRICS.iter().copied().find(|m| parse::is_name(m.name, name))
    }
}

/// By its name, which must be in the catalogue.
impl<'de> Deserialize<'de> for &'static Metric {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<&'static Metric, D::Error> {
        let name = Cow::<str>::deserialize(deserializer)?;
        Metric::named(&name).map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::tally::Tally;

    #[test]
    fn every_metric_says_what_it_is_and_has_a_name_of_its_own() {
        for (i, m) in METRICS.iter().enumerate() {
            let definition = m.definition();
            assert!(!m.source.is_empty() && !m.about.is_empty() && m.range.0 < m.range.1, "{}", m.name);
            let light = !matches!(m.read_from, MetricSource::Solid(_));
            for word in ["npolarised", "Fresnel", "D line"].iter().filter(|_| light && !m.needs_dispersion())
            {
                assert!(definition.contains(word), "{} does not state: {word}", m.name);
            }
            assert_eq!(m.observer.is_some(), definition.contains("--observer"), "{}", m.name);
            assert_eq!(m.scale == 100.0, m.unit == "%", "{}", m.name);
            assert!(METRICS[..i].iter().all(|other| other.name != m.name), "{}", m.name);
            assert_eq!(Metric::by_name(m.name).map(|m| m.name), Some(m.name));
        }
        for name in FIRST_COLUMNS {
            assert!(Metric::by_name(name).is_some(), "no metric is called {name}");
        }
    }

    /// A metric reads columns of its own estimator: with a number in each of them it has a value.
    #[test]
    fn every_row_belongs_to_its_table() {
        for estimator in &ESTIMATORS {
            let kind = estimator.kind;
            let same =
                |other: &&crate::estimators::catalogue::CataloguedEstimator| other.kind.name() == kind.name();
            assert_eq!(ESTIMATORS.iter().filter(same).count(), 1, "{}", kind.name());
            let mut tally = Tally::default();
            kind.columns().iter().for_each(|column| tally[*column] = 1.0);
            tally.histogram.insert(1.0, 1.0);
            for metric in kind.metrics() {
                assert!(metric.is_of(kind), "{} stands in the table of {}", metric.name, kind.name());
                if let MetricSource::Sums(of) = metric.read_from {
                    assert!(of.value(&tally).is_finite(), "{} reads a column of no tally", metric.name);
                }
            }
        }
    }
}
