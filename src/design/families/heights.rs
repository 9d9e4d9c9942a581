//! Heights as a grading report states them, in percent of the girdle width: depth, crown height, pavilion
//! depth. They take the place of angles, table and girdle thickness.
//!
//! A brilliant of table t (0..1), crown angle a, pavilion angle b and culet c has the crown height
//! 50 (1 − t) tan a, the pavilion depth 50 (1 − c) tan b, and the depth is both and the girdle.

use super::{CutError, Family, Parameter};
use std::collections::BTreeMap;

const DEPTH: &str = "depth";
const CROWN_HEIGHT: &str = "crown-height";
const PAVILION_DEPTH: &str = "pavilion-depth";

const fn height(key: &'static str, range: (f64, f64), about: &'static str) -> Parameter {
    Parameter { key, default: f64::NAN, range, unit: "%", about }
}

/// What every brilliant takes.
pub const OF_BRILLIANTS: &[Parameter] = &[
    height(
        CROWN_HEIGHT,
        (0.0, 100.0),
        "crown height at the girdle's thick places; gives the crown angle, or with that the table",
    ),
    height(
        PAVILION_DEPTH,
        (1.0, 300.0),
        "pavilion depth at the girdle's thick places; gives the pavilion angle",
    ),
    height(
        DEPTH,
        (1.0, 400.0),
        "whole depth; gives the girdle, or where that is given the pavilion, or where that is given the crown",
    ),
];

/// The given values with the heights among them replaced by the parameters that give them.
///
/// `depth` sets the first of girdle, pavilion angle and crown angle that is not otherwise given. Errors
/// name what is given twice over, or the sum that leaves nothing.
///
/// - `own`: values in place of the family's defaults, without heights; they are part of what is returned
pub fn resolved(family: &Family, own: &GivenValues, given: &GivenValues) -> Result<GivenValues, CutError> {
    for parameter in family.heights {
        given.get(parameter.key).map_or(Ok(0.0), |value| parameter.checked(*value))?;
    }
    let mut set = given.clone();
    let [depth, crown, pavilion] = [DEPTH, CROWN_HEIGHT, PAVILION_DEPTH].map(|key| match family.heights {
        [] => None,
        _ => set.remove(key),
    });
    let mut values = HeightSolver { family, own, set };
    if let Some(height) = crown {
        values.crown_height(height)?;
    }
    if let Some(height) = pavilion {
        if values.has("pavilion-angle") {
            return Err(over("pavilion-depth and pavilion-angle"));
        }
        values.set_pavilion(height);
    }
    if let Some(depth) = depth {
        values.depth(depth)?;
    }
    let mut all = own.clone();
    all.extend(values.set);
    Ok(all)
}

/// Values by key.
type GivenValues = BTreeMap<String, f64>;

/// The values as far as they are known.
struct HeightSolver<'a> {
    family: &'a Family,
    own: &'a GivenValues,
    set: GivenValues,
}

fn over(keys: &str) -> CutError {
    CutError::Impossible {
        problem: "given twice over",
        bound: format!("of {keys} one follows from the others: leave one out"),
    }
}

impl HeightSolver<'_> {
    /// Whether the parameter is set otherwise than by default.
    fn has(&self, key: &str) -> bool {
        self.set.contains_key(key)
    }

    fn value(&self, key: &str) -> f64 {
        let default = || self.family.parameters.iter().find(|p| p.key == key).map_or(f64::NAN, |p| p.default);
        self.set.get(key).or(self.own.get(key)).copied().unwrap_or_else(default)
    }

    fn tan(&self, key: &str) -> f64 {
        self.value(key).to_radians().tan()
    }

    /// Height of a pavilion of 45°, percent.
    fn level(&self) -> f64 {
        50.0 - 0.5 * self.value("culet")
    }

    fn crown_height(&mut self, height: f64) -> Result<(), CutError> {
        match (self.has("crown-angle"), self.has("table")) {
            (true, true) => return Err(over("crown-height, crown-angle and table")),
            (true, false) => {
                let table = 100.0 - 2.0 * height / self.tan("crown-angle");
                self.set.insert("table".into(), table);
            }
            (false, _) => self.set_crown(height),
        }
        Ok(())
    }

    fn set_crown(&mut self, height: f64) {
        let angle = (2.0 * height / (100.0 - self.value("table"))).atan().to_degrees();
        self.set.insert("crown-angle".into(), angle);
    }

    fn set_pavilion(&mut self, height: f64) {
        self.set.insert("pavilion-angle".into(), (height / self.level()).atan().to_degrees());
    }

    fn depth(&mut self, depth: f64) -> Result<(), CutError> {
        let parts = [
            ("crown", 0.5 * (100.0 - self.value("table")) * self.tan("crown-angle")),
            ("girdle", self.value("girdle")),
            ("pavilion", self.level() * self.tan("pavilion-angle")),
        ];
        let left = |wanted: &str| -> Result<f64, CutError> {
            let others = || parts.iter().filter(|(name, _)| *name != wanted);
            let left = depth - others().map(|(_, height)| height).sum::<f64>();
            if left > 0.0 {
                return Ok(left);
            }
            let said: Vec<String> = others().map(|(name, height)| format!("{name} {height:.2}%")).collect();
            Err(CutError::Impossible {
                problem: "the depth is too small",
                bound: format!("depth = {depth}% less {} leaves no {wanted}", said.join(" and ")),
            })
        };
        if !self.has("girdle") {
            let girdle = left("girdle")?;
            self.set.insert("girdle".into(), girdle);
        } else if !self.has("pavilion-angle") {
            self.set_pavilion(left("pavilion")?);
        } else if !self.has("crown-angle") {
            self.set_crown(left("crown")?);
        } else {
            return Err(over("depth, girdle, pavilion and crown"));
        }
        Ok(())
    }
}
