//! One setting: what is changed, and to what.

use crate::parse::{self, MINUS_SIGNS, NumberError, NumberUnit};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// Crown or pavilion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Above the girdle, table included.
    Crown,
    /// Below the girdle, culet included.
    Pavilion,
}

impl Side {
    fn name(self) -> &'static str {
        match self {
            Side::Crown => "crown",
            Side::Pavilion => "pavilion",
        }
    }
}

/// What a setting is about. A tier is meant by its name, its place in the cutting order of its part of the
/// stone (`P1`, `C2`, `G1`), its number, or a pattern with `*` and `?`.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum EditTarget {
    /// Angle of tiers from the girdle plane, in degrees, without sign.
    Angle(String),
    /// Index of tiers, in teeth: all facets of a tier are turned by so many.
    Index(String),
    /// Depth of tiers: what is added to their distance from the middle, in percent of the width.
    Depth(String),
    /// What the tangents of all angles of a side are multiplied by.
    Scale(Side),
    /// What is added to all angles of a side, in degrees.
    Shift(Side),
    /// Size of the table in percent of the width, as `cutlab show` measures it.
    Table,
    /// Thickness of the girdle at its thick places, in percent of the width.
    Girdle,
    /// Size of the culet in percent of the width.
    Culet,
    /// A parameter of the design's family.
    Parameter(String),
}

/// What a change leaves as it is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Keep {
    /// What met still meets: distances follow, and other angles where the meets ask for that.
    #[default]
    Meets,
    /// What met still meets, by distances alone: no other angle changes.
    Angles,
    /// Distances of all facets from the middle: meets open.
    Depths,
}

/// One setting, as it is typed: `P1.angle=41.5`, `crown.scale=0.95`, `table+=2`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Setting {
    /// What is changed.
    pub target: EditTarget,
    /// Whether the value is added to what there is (`+=`).
    pub is_added: bool,
    /// In the target's unit.
    pub value: f64,
}

/// Text that is no setting.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SettingError {
    /// No `=`.
    #[error("'{0}' sets nothing: write what and its value, as P1.angle=41.5 or table+=2")]
    NoValue(String),
    /// Something that a tier does not have.
    #[error("a tier has angle, index and depth, not '{0}'")]
    NoSuchProperty(String),
    /// A value that is no number.
    #[error("{target}: {why}")]
    Value {
        /// What is set.
        target: String,
        /// Why not.
        why: NumberError,
    },
    /// A shift or a ratio that is set as if there were one before.
    #[error("{target} is relative to the design as it is: write {target}{right}NUMBER")]
    Relative {
        /// What is set.
        target: String,
        /// `=` or `+=`.
        right: &'static str,
    },
}

impl EditTarget {
    /// The unit of its values.
    pub fn unit(&self) -> NumberUnit {
        match self {
            EditTarget::Angle(_) | EditTarget::Shift(_) => NumberUnit::Degrees,
            EditTarget::Index(_) | EditTarget::Scale(_) => NumberUnit::None,
            EditTarget::Depth(_) | EditTarget::Table | EditTarget::Girdle | EditTarget::Culet => {
                NumberUnit::Percent
            }
            EditTarget::Parameter(key) => crate::design::families::parameter_unit(key),
        }
    }
}

impl FromStr for EditTarget {
    type Err = SettingError;

    fn from_str(text: &str) -> Result<EditTarget, SettingError> {
        let text = text.trim();
        let lower = text.to_lowercase();
        Ok(match &*lower {
            "table" => EditTarget::Table,
            "girdle" => EditTarget::Girdle,
            "culet" => EditTarget::Culet,
            "crown.scale" => EditTarget::Scale(Side::Crown),
            "pavilion.scale" => EditTarget::Scale(Side::Pavilion),
            "crown.shift" => EditTarget::Shift(Side::Crown),
            "pavilion.shift" => EditTarget::Shift(Side::Pavilion),
            _ => match text.rsplit_once('.') {
                Some((tier, "angle")) => EditTarget::Angle(tier.trim().into()),
                Some((tier, "index")) => EditTarget::Index(tier.trim().into()),
                Some((tier, "depth")) => EditTarget::Depth(tier.trim().into()),
                Some((_, other)) => return Err(SettingError::NoSuchProperty(other.into())),
                None => EditTarget::Parameter(lower),
            },
        })
    }
}

impl fmt::Display for EditTarget {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            EditTarget::Angle(tier) => write!(f, "{tier}.angle"),
            EditTarget::Index(tier) => write!(f, "{tier}.index"),
            EditTarget::Depth(tier) => write!(f, "{tier}.depth"),
            EditTarget::Scale(side) => write!(f, "{}.scale", side.name()),
            EditTarget::Shift(side) => write!(f, "{}.shift", side.name()),
            EditTarget::Table => f.write_str("table"),
            EditTarget::Girdle => f.write_str("girdle"),
            EditTarget::Culet => f.write_str("culet"),
            EditTarget::Parameter(key) => f.write_str(key),
        }
    }
}

impl FromStr for Setting {
    type Err = SettingError;

    fn from_str(text: &str) -> Result<Setting, SettingError> {
        let (left, right) = text.split_once('=').ok_or_else(|| SettingError::NoValue(text.into()))?;
        let (left, sign) = match left.trim_end() {
            l if l.ends_with('+') => (&l[..l.len() - 1], Some(1.0)),
            l => match MINUS_SIGNS.iter().chain(&['-']).find_map(|m| l.strip_suffix(*m)) {
                Some(left) => (left, Some(-1.0)),
                None => (l, None),
            },
        };
        let target: EditTarget = left.parse()?;
        let value = parse::parse_number(right, target.unit())
            .map_err(|why| SettingError::Value { target: target.to_string(), why })?;
        let relative = |right| Err(SettingError::Relative { target: target.to_string(), right });
        match (&target, sign) {
            (EditTarget::Scale(_) | EditTarget::Shift(_), Some(_)) => relative("="),
            (EditTarget::Index(_) | EditTarget::Depth(_), None) => relative("+="),
            _ => Ok(Setting { target, is_added: sign.is_some(), value: sign.unwrap_or(1.0) * value }),
        }
    }
}

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}{}", self.target, if self.is_added { "+=" } else { "=" }, self.value)
    }
}

impl TryFrom<String> for Setting {
    type Error = SettingError;

    fn try_from(text: String) -> Result<Setting, SettingError> {
        text.parse()
    }
}

impl From<Setting> for String {
    fn from(setting: Setting) -> String {
        setting.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_read_and_written() {
        for (text, written) in [
            ("P1.angle=41.5", "P1.angle=41.5"),
            ("P1.angle += 0.5°", "P1.angle+=0.5"),
            ("C*.angle-=1", "C*.angle+=-1"),
            ("pavilion main.index+=2", "pavilion main.index+=2"),
            ("Crown.Scale = 0.95", "crown.scale=0.95"),
            ("table=57 %", "table=57"),
            ("crown-angle=35", "crown-angle=35"),
            ("C.1.depth+=\u{2212}2", "C.1.depth+=-2"),
        ] {
            let setting: Setting = text.parse().unwrap_or_else(|e| panic!("{text}: {e}"));
            assert_eq!(setting.to_string(), written);
            assert_eq!(written.parse::<Setting>().as_ref(), Ok(&setting));
        }
        for text in ["P1.angle", "P1.tilt=4", "table=x", "crown.scale+=1", "P1.depth=4", "P1.angle=nan"] {
            assert!(text.parse::<Setting>().is_err(), "{text}");
        }
    }
}
