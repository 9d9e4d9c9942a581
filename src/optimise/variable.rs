//! Variables of an optimisation: what of a design may change, and how far.

use crate::design::edit::{EditError, EditTarget, EditableTier, Editor, Setting, SettingError, Side};
use crate::design::tiers::Zone;
use crate::parse::{self, format_number};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;

/// What may change, as it is typed: `P*.angle`, `C1.angle=28:36`, `table=50:62`. A pattern is a variable for
/// each tier that it fits.
///
/// ```
/// use cutlab::Variable;
///
/// let variable: Variable = "C1.angle=28:36".parse()?;
/// assert_eq!(variable.range, Some((28.0, 36.0)));
/// assert_eq!(variable.to_string(), "C1.angle=28:36");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Variable {
    /// What changes.
    pub target: EditTarget,
    /// The least and the greatest value, in the target's unit; none for the usual range.
    pub range: Option<(f64, f64)>,
}

/// Text that is no variable.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum VariableError {
    /// What is to vary is not understood.
    #[error(transparent)]
    EditTarget(#[from] SettingError),
    /// A range that is none.
    #[error("{target}={found} is no range: write {target}=FROM:TO, the smaller first")]
    Range {
        /// What varies.
        target: String,
        /// What was written.
        found: String,
    },
}

impl FromStr for Variable {
    type Err = VariableError;

    fn from_str(text: &str) -> Result<Variable, VariableError> {
        let (target, range) = match text.split_once('=') {
            Some((target, range)) => (target.parse::<EditTarget>()?, Some(range)),
            None => (text.parse::<EditTarget>()?, None),
        };
        let Some(found) = range else { return Ok(Variable { target, range: None }) };
        let wrong = || VariableError::Range { target: target.to_string(), found: found.trim().into() };
        let (from, to) = found.split_once(':').ok_or_else(wrong)?;
        let number = |text: &str| parse::parse_number(text, target.unit()).map_err(|_| wrong());
        let range = (number(from)?, number(to)?);
        if range.0 >= range.1 {
            return Err(wrong());
        }
        Ok(Variable { target, range: Some(range) })
    }
}

impl fmt::Display for Variable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.range {
            None => write!(f, "{}", self.target),
            Some((from, to)) => {
                write!(f, "{}={}:{}", self.target, format_number(from), format_number(to))
            }
        }
    }
}

impl TryFrom<String> for Variable {
    type Error = VariableError;

    fn try_from(text: String) -> Result<Variable, VariableError> {
        text.parse()
    }
}

impl From<Variable> for String {
    fn from(variable: Variable) -> String {
        variable.to_string()
    }
}

/// A variable of one design: one number.
#[derive(Debug, Clone, PartialEq)]
pub struct Degree {
    /// What changes: of tiers one, by its place.
    pub target: EditTarget,
    /// What people call it: `P1.angle`, `crown.scale`.
    pub name: String,
    /// Its value in the design as it is, in the target's unit.
    pub start: f64,
    /// Its least and greatest value.
    pub range: RangeInclusive<f64>,
}

impl Degree {
    /// The setting that gives it a value.
    pub fn setting(&self, value: f64) -> Setting {
        let is_added = matches!(self.target, EditTarget::Index(_) | EditTarget::Depth(_));
        Setting { target: self.target.clone(), is_added, value }
    }
}

/// Degrees that an angle may move up or down, if nobody says how far.
const ANGLE: f64 = 5.0;
/// Percent of the width that a depth may.
const DEPTH: f64 = 4.0;
/// Percent of the width that a table may.
const TABLE: f64 = 10.0;
/// Teeth that an index may.
const INDEX: f64 = 1.0;
/// Ratios of tangents: a crown may become half or half again as steep, a pavilion of 41° 37° to 45°.
const CROWN: RangeInclusive<f64> = 0.5..=1.5;
const PAVILION: RangeInclusive<f64> = 0.87..=1.15;

/// The variables that there are if none is named: the two tangent ratios.
pub fn usual() -> Vec<Variable> {
    [Side::Crown, Side::Pavilion]
        .map(|side| Variable { target: EditTarget::Scale(side), range: None })
        .to_vec()
}

/// The degrees of freedom that variables are for a design; of several for one thing the last counts.
///
/// Errors name a tier or a parameter that the design does not have, and a tier that has no angle to vary.
pub fn resolved(variables: &[Variable], editor: &Editor) -> Result<Vec<Degree>, EditError> {
    let mut degrees: Vec<Degree> = Vec::new();
    for variable in variables {
        for degree in of_variable(variable, editor)? {
            match degrees.iter_mut().find(|d| d.target == degree.target) {
                Some(known) => *known = degree,
                None => degrees.push(degree),
            }
        }
    }
    Ok(degrees)
}

fn of_variable(variable: &Variable, editor: &Editor) -> Result<Vec<Degree>, EditError> {
    let around =
        |start: f64, by: f64, least: f64, most: f64| (start - by).max(least)..=(start + by).min(most);
    let degree = |target: EditTarget, name: String, start: f64, usual: RangeInclusive<f64>| Degree {
        target,
        name,
        start,
        range: variable.range.map_or(usual, |(from, to)| from..=to),
    };
    let tiers = |asked: &str, property: &str| -> Result<Vec<(EditableTier, String)>, EditError> {
        let all = editor.tiers.named(asked)?.into_iter();
        Ok(all.map(|t| (t.clone(), format!("{}.{property}", t.label()))).collect())
    };
    Ok(match &variable.target {
        EditTarget::Angle(asked) => {
            let is_pattern = asked.contains(['*', '?']);
            let slanted = |t: &EditableTier| matches!(t.zone, Zone::Crown | Zone::Pavilion);
            let all = tiers(asked, "angle")?;
            if let Some((fixed, _)) = all.iter().find(|(t, _)| !slanted(t)).filter(|_| !is_pattern) {
                return Err(EditError::FixedAngle { tier: fixed.label().into(), zone: fixed.zone.name() });
            }
            let of = |(tier, name): (EditableTier, String)| {
                let start = editor.angle_deg(&tier);
                degree(EditTarget::Angle(tier.place.clone()), name, start, around(start, ANGLE, 0.5, 89.5))
            };
            all.into_iter().filter(|(t, _)| slanted(t)).map(of).collect()
        }
        EditTarget::Index(asked) => {
            let of = |(tier, name): (EditableTier, String)| {
                degree(EditTarget::Index(tier.place), name, 0.0, -INDEX..=INDEX)
            };
            tiers(asked, "index")?.into_iter().map(of).collect()
        }
        EditTarget::Depth(asked) => {
            let of = |(tier, name): (EditableTier, String)| {
                degree(EditTarget::Depth(tier.place), name, 0.0, -DEPTH..=DEPTH)
            };
            tiers(asked, "depth")?.into_iter().map(of).collect()
        }
        EditTarget::Scale(Side::Crown) => {
            vec![degree(variable.target.clone(), variable.target.to_string(), 1.0, CROWN)]
        }
        EditTarget::Scale(Side::Pavilion) => {
            vec![degree(variable.target.clone(), variable.target.to_string(), 1.0, PAVILION)]
        }
        EditTarget::Shift(_) => {
            vec![degree(variable.target.clone(), variable.target.to_string(), 0.0, -ANGLE..=ANGLE)]
        }
        EditTarget::Table | EditTarget::Girdle | EditTarget::Culet | EditTarget::Parameter(_) => {
            let start = editor.value_of(&variable.target)?;
            let usual = match &variable.target {
                EditTarget::Table => around(start, TABLE, 1.0, 99.0),
                EditTarget::Girdle | EditTarget::Culet => 0.5 * start..=2.0 * start,
                target => editor.parameter_range(target).unwrap_or(0.8 * start..=1.2 * start),
            };
            vec![degree(variable.target.clone(), variable.target.to_string(), start, usual)]
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::library;
    use std::collections::BTreeMap;

    #[test]
    fn variables_are_read_and_resolved() {
        for text in ["P*.angle", "C1.angle=28:36", "table=50:62", "crown.scale=0.8:1.2", "star=40:60"] {
            let variable: Variable = text.parse().unwrap_or_else(|e| panic!("{text}: {e}"));
            assert_eq!(variable.to_string(), text);
        }
        for text in ["C1.angle=36:28", "C1.angle=36", "table=a:b", "P1.tilt", "P1.angle=3:nan"] {
            assert!(text.parse::<Variable>().is_err(), "{text}");
        }
        let design = library::design("tolkowsky", &BTreeMap::new()).expect("a cut").expect("solved");
        let editor = Editor::new(&design).expect("closed");
        let degrees = |texts: &[&str]| {
            let variables: Vec<Variable> = texts.iter().map(|t| t.parse().expect("a variable")).collect();
            resolved(&variables, &editor)
        };
        let all = degrees(&["P*.angle", "P1.angle=40:42", "star=40:60", "table"]).expect("there");
        let names: Vec<&str> = all.iter().map(|d| d.name.as_str()).collect();
        assert_eq!(names, ["pavilion main.angle", "lower half.angle", "star", "table"]);
        assert_eq!((all[0].start, all[0].range.clone()), (40.75, 40.0..=42.0));
        assert_eq!((all[2].start, all[3].start), (50.0, 53.0));
        assert!(matches!(degrees(&["T1.angle"]), Err(EditError::FixedAngle { .. })));
        assert!(matches!(degrees(&["Q1.angle"]), Err(EditError::NoSuchTier { .. })));
        assert!(matches!(degrees(&["stars"]), Err(EditError::NoSuchKey { .. })));
    }
}
