//! Constraints: bounds on metrics and proportions that a design must keep, as data.

use super::objective::{Aim, ObjectiveError, TiltedMetric};
use crate::design::proportion_catalogue::{NamedProportion, PROPORTIONS};
use crate::metrics::METRICS;
use crate::parse::{self, NumberUnit, format_number};
use serde::{Deserialize, Serialize};
use std::fmt;

/// What a bound is set on.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Quantity {
    /// A metric. Of several tilts the mean or the worst counts, as its [`super::objective::Tilts`] say.
    Score(TiltedMetric),
    /// A proportion.
    Proportion(#[serde(with = "by_name")] &'static NamedProportion),
}

/// On which side of a bound values must lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// They are no less.
    AtLeast,
    /// They are no more.
    AtMost,
}

/// A bound.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Bound {
    /// A value of the quantity.
    Value(f64),
    /// So many times what the design has at the start.
    OfStart(f64),
}

/// A bound that a design must keep.
///
/// ```
/// use cutlab::advanced::scoring::constraint::{Bound, Constraint};
///
/// let weight = Constraint::at_least("weight_ratio=0.95")?;
/// assert_eq!(weight.bound, Bound::Value(0.95));
/// let depth = Constraint::at_most("depth_percent=1.05*start")?;
/// assert_eq!(depth.bound, Bound::OfStart(1.05));
/// # Ok::<(), cutlab::advanced::scoring::objective::ObjectiveError>(())
/// ```
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Constraint {
    /// Of what.
    pub of: Quantity,
    /// On which side of the bound values must lie.
    pub side: Side,
    /// The bound.
    pub bound: Bound,
}

impl Quantity {
    /// The metric, with its tilts, or the proportion called so.
    pub fn named(text: &str) -> Result<Quantity, ObjectiveError> {
        if let Some(proportion) = NamedProportion::by_name(text.trim()) {
            return Ok(Quantity::Proportion(proportion));
        }
        match text.parse() {
            Ok(of) => Ok(Quantity::Score(of)),
            Err(ObjectiveError::NoSuchMetric(wrong)) => {
                let names = METRICS.iter().map(|m| m.name).chain(PROPORTIONS.iter().map(|p| p.name));
                let nearest = parse::nearest_name(&wrong.name, names);
                Err(ObjectiveError::NoSuchQuantity { name: wrong.name, nearest })
            }
            Err(other) => Err(other),
        }
    }

    /// Its name, with the tilts of a metric.
    pub fn name(&self) -> String {
        match self {
            Quantity::Score(of) => of.name(),
            Quantity::Proportion(of) => of.name.into(),
        }
    }

    /// What a difference of it is measured against.
    pub(super) fn scale(&self) -> f64 {
        match self {
            Quantity::Score(of) => of.metric.scale,
            Quantity::Proportion(of) => of.scale,
        }
    }
}

impl Constraint {
    /// Values are no less than a bound.
    ///
    /// - `text`: `NAME=NUMBER`, or `NAME=NUMBER*start` for a multiple of what the design has at the start
    pub fn at_least(text: &str) -> Result<Constraint, ObjectiveError> {
        Constraint::parse(Side::AtLeast, text)
    }

    /// Values are no more than a bound; `text` as for [`Constraint::at_least`].
    pub fn at_most(text: &str) -> Result<Constraint, ObjectiveError> {
        Constraint::parse(Side::AtMost, text)
    }

    fn parse(side: Side, text: &str) -> Result<Constraint, ObjectiveError> {
        let wrong = || ObjectiveError::NotABound(text.into());
        let (name, bound) = text.rsplit_once('=').ok_or_else(wrong)?;
        let of = Quantity::named(name)?;
        let unit = match &of {
            Quantity::Score(of) => NumberUnit::from_sign(of.metric.unit),
            Quantity::Proportion(of) if of.name.ends_with("_percent") => NumberUnit::Percent,
            Quantity::Proportion(of) if of.name.ends_with("_deg") => NumberUnit::Degrees,
            Quantity::Proportion(_) => NumberUnit::None,
        };
        let lower = bound.to_lowercase();
        let bound =
            match lower.trim().strip_suffix("start").and_then(|b| b.trim_end().strip_suffix(['*', '×'])) {
                Some(times) => parse::parse_number(times, NumberUnit::None).map(Bound::OfStart),
                None => parse::parse_number(&lower, unit).map(Bound::Value),
            };
        Ok(Constraint { of, side, bound: bound.map_err(|_| wrong())? })
    }

    /// What the worst of several tilts is for it.
    pub(super) fn aim(&self) -> Aim {
        match self.side {
            Side::AtLeast => Aim::Maximise,
            Side::AtMost => Aim::Minimise,
        }
    }

    /// By how much a value misses a bound, per scale of the quantity; 0 if it keeps it.
    ///
    /// - `bound`: in the quantity's unit
    pub(super) fn violation(&self, value: f64, bound: f64) -> f64 {
        let short = match self.side {
            Side::AtLeast => bound - value,
            Side::AtMost => value - bound,
        };
        short.max(0.0) / self.of.scale()
    }
}

/// A bound that the start of a search does not keep.
#[derive(Debug, Clone, PartialEq)]
pub struct BrokenBound {
    /// Of what.
    pub quantity: String,
    /// On which side of the bound it should lie.
    pub side: Side,
    /// What it is.
    pub value: f64,
    /// The bound.
    pub bound: f64,
}

/// `weight_ratio is 0.91, 0.04 less than the 0.95 asked for`.
impl fmt::Display for BrokenBound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let short = |x: f64| format_number((x * 1e4).round() / 1e4);
        let way = if self.side == Side::AtLeast { "less" } else { "more" };
        let by = short((self.value - self.bound).abs());
        write!(
            f,
            "{} is {}, {by} {way} than the {} asked for",
            self.quantity,
            short(self.value),
            short(self.bound)
        )
    }
}

/// A proportion as its name.
mod by_name {
    use crate::design::proportion_catalogue::NamedProportion;
    use crate::scoring::objective::ObjectiveError;
    use serde::{Deserialize, Deserializer, Serializer, de::Error};

    pub fn serialize<S: Serializer>(of: &&'static NamedProportion, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(of.name)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<&'static NamedProportion, D::Error> {
        let name = String::deserialize(deserializer)?;
        let none = || ObjectiveError::NoSuchQuantity { name: name.clone(), nearest: None };
        NamedProportion::by_name(&name).ok_or_else(|| D::Error::custom(none()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_read_as_they_are_typed() {
        let table = Constraint::at_most(" table_percent = 62 % ").expect("a proportion");
        assert!(matches!(table.of, Quantity::Proportion(p) if p.name == "table_percent"));
        assert_eq!((table.bound, table.side), (Bound::Value(62.0), Side::AtMost));
        let iso = Constraint::at_least("iso@0,10 = 0.98 * start").expect("a metric");
        assert_eq!((iso.of.name(), iso.bound), ("iso@0,10".into(), Bound::OfStart(0.98)));
        let wrong = |text: &str| Constraint::at_least(text).expect_err(text).to_string();
        assert_eq!(
            wrong("tabel_percent=5"),
            "no metric or proportion is called 'tabel_percent'; did you mean 'table_percent'?"
        );
        assert_eq!(
            wrong("weigth_ratio=5"),
            "no metric or proportion is called 'weigth_ratio'; did you mean 'weight_ratio'?"
        );
        assert!(
            wrong("weight_ratio").contains("is not a bound") && wrong("iso=a lot").contains("is not a bound")
        );
    }

    #[test]
    fn violations_are_parts_of_the_scale_and_constraints_are_data() {
        let table = Constraint::at_most("table_percent=62").expect("a proportion");
        assert!((table.violation(65.0, 62.0) - 0.03).abs() < 1e-12 && table.violation(61.0, 62.0) == 0.0);
        for given in [table, Constraint::at_least("iso@0,10=0.98*start").expect("a metric")] {
            let text = toml::to_string(&given).expect("is data");
            let back: Constraint = toml::from_str(&text).expect("is read again");
            assert_eq!(format!("{given:?}"), format!("{back:?}"), "{text}");
        }
        let broken =
            BrokenBound { quantity: "weight_ratio".into(), side: Side::AtLeast, value: 0.91, bound: 0.95 };
        assert_eq!(broken.to_string(), "weight_ratio is 0.91, 0.04 less than the 0.95 asked for");
    }
}
