//! Sweeps: the values that parameters run through, and the stone at each point.

use super::table::rounded;
use crate::design::families;
use crate::parse;
use crate::parse::{NumberError, NumberUnit, format_number};
use crate::sampling::kronecker::KroneckerPoints;
use crate::sampling::random::Purpose;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// Scattered points of a sweep, one stream.
const SCATTER_STREAM: Purpose = Purpose::named("scatter");

/// Values at equal steps.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(into = "StatedSteps", try_from = "StatedSteps")]
pub struct Steps {
    /// The first.
    pub from: f64,
    /// No value lies beyond it.
    pub to: f64,
    step: f64,
    /// How many there are.
    pub count: u64,
}

/// As a request says it.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct StatedSteps {
    from: f64,
    to: f64,
    step: f64,
}

impl From<Steps> for StatedSteps {
    fn from(Steps { from, to, step, .. }: Steps) -> StatedSteps {
        StatedSteps { from, to, step }
    }
}

impl TryFrom<StatedSteps> for Steps {
    type Error = String;

    fn try_from(StatedSteps { from, to, step }: StatedSteps) -> Result<Steps, String> {
        Steps::new(from, to, step)
    }
}

/// The key of a stone's size, which every stone has.
pub const SIZE: &str = "size";
/// The key of its refractive index.
pub const INDEX: &str = "ri";

/// No range has more values.
const MOST: f64 = 1e9;
/// No value is greater.
const GREATEST: f64 = 1e9;

impl Steps {
    /// Value number `i`, from 0; decimal steps give decimal values.
    pub fn value(&self, i: u64) -> f64 {
        rounded(self.from + i as f64 * self.step)
    }

    /// All values.
    pub fn values(self) -> impl Iterator<Item = f64> {
        (0..self.count).map(move |i| self.value(i))
    }
}

impl Steps {
    /// `FROM:TO:STEP`, or one number.
    ///
    /// - `unit`: what the numbers are taken in
    pub fn parse(text: &str, unit: NumberUnit) -> Result<Steps, String> {
        let wrong =
            || format!("'{text}' is not a range (expected FROM:TO:STEP, e.g. 30:38:0.5, or one number)");
        let mut numbers = Vec::new();
        for part in text.split(':') {
            numbers.push(match parse::parse_number(part, unit) {
                Ok(x) => x,
                Err(NumberError::NotANumber | NumberError::Infinite) => return Err(wrong()),
                Err(error) => return Err(error.to_string()),
            });
        }
        let (from, to, step) = match numbers[..] {
            [at] => (at, at, 1.0),
            [from, to, step] => (from, to, step),
            _ => return Err(wrong()),
        };
        if ![from, to, step].iter().all(|x| x.abs() < GREATEST) {
            return Err(wrong());
        }
        Steps::new(from, to, step)
    }

    /// The values from `from` on, at steps of `step`, up to `to`.
    pub fn new(from: f64, to: f64, step: f64) -> Result<Steps, String> {
        let text = format!("{from}:{to}:{step}");
        if ![from, to, step].iter().all(|x| x.abs() < GREATEST) {
            return Err(format!("'{text}' is not a range of numbers"));
        }
        let steps = (to - from) / step;
        if step == 0.0 {
            return Err(format!(
                "'{text}': the step is 0; for one value give it alone, as {}",
                format_number(from)
            ));
        }
        if steps < 0.0 {
            return Err(format!("'{text}': the step leads away from {to}"));
        }
        let mut count = (steps + 1e-6).floor() + 1.0;
        // a step of few digits may reach the end but for rounding: it must not go beyond
        let beyond = (from + (count - 1.0) * step - to) * step.signum();
        if beyond > 1e-9 * to.abs().max(1.0) {
            count -= 1.0;
        }
        if count > MOST {
            return Err(format!("'{text}' has more than a thousand million values"));
        }
        Ok(Steps { from, to, step, count: count as u64 })
    }
}

impl fmt::Display for Steps {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}:{}:{}", self.from, self.to, self.step)
    }
}

/// A parameter and what it runs through.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SweptParameter {
    /// The parameter's key.
    pub key: String,
    /// Its values.
    pub steps: Steps,
}

impl FromStr for SweptParameter {
    type Err = String;

    /// `KEY=FROM:TO:STEP`.
    fn from_str(text: &str) -> Result<SweptParameter, String> {
        let (key, steps) =
            text.split_once('=').ok_or("expected KEY=FROM:TO:STEP, e.g. crown-angle=30:38:0.5")?;
        let key = key.trim().to_lowercase();
        Ok(SweptParameter { steps: Steps::parse(steps, families::parameter_unit(&key))?, key })
    }
}

/// The points of a sweep.
#[derive(Debug, Clone)]
pub struct Sweep {
    /// What is varied, the first slowest.
    pub varied: Vec<SweptParameter>,
    /// So many points spread evenly over the box of the ranges, in place of the grid.
    pub scatter: Option<u64>,
    /// Seed of the scattered points.
    pub seed: u64,
}

/// Most parameters that can be scattered together.
pub const MOST_SCATTERED: usize = 6;

impl Sweep {
    /// How many points there are; none if they cannot be counted.
    pub fn count(&self) -> Option<u64> {
        match self.scatter {
            Some(n) => Some(n),
            None => self.varied.iter().try_fold(1u64, |n, v| n.checked_mul(v.steps.count)),
        }
    }

    /// The values at point number `i`, in the order of what is varied.
    ///
    /// A pure function of the sweep and `i`: scattered points are a Kronecker sequence, so more of
    /// them include the fewer.
    pub fn point(&self, i: u64) -> Vec<f64> {
        if self.scatter.is_some() {
            let at = self.spread(i);
            let value = |(v, u): (&SweptParameter, f64)| {
                let (from, to) = (v.steps.from, v.steps.to);
                ((from + (to - from) * u) * 1e6).round() / 1e6
            };
            return self.varied.iter().zip(at).map(value).collect();
        }
        let mut rest = i;
        let mut values: Vec<f64> = self
            .varied
            .iter()
            .rev()
            .map(|v| {
                let value = v.steps.value(rest % v.steps.count);
                rest /= v.steps.count;
                value
            })
            .collect();
        values.reverse();
        values
    }

    /// Scattered point number `i` of the unit cube.
    fn spread(&self, i: u64) -> Vec<f64> {
        fn at<const D: usize>(seed: u64, i: u64) -> Vec<f64> {
            KroneckerPoints::<D>::new(seed, SCATTER_STREAM, 0, i..i + 1).flatten().collect()
        }
        match self.varied.len() {
            1 => at::<1>(self.seed, i),
            2 => at::<2>(self.seed, i),
            3 => at::<3>(self.seed, i),
            4 => at::<4>(self.seed, i),
            5 => at::<5>(self.seed, i),
            _ => at::<MOST_SCATTERED>(self.seed, i),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_hold_their_ends_and_decimal_values() {
        let values =
            |text: &str| Steps::parse(text, NumberUnit::None).expect("a range").values().collect::<Vec<_>>();
        assert_eq!(values("40:42:0.1").len(), 21);
        assert_eq!(values("40:42:0.1")[3], 40.3);
        assert_eq!(values("30:38:0.5").last(), Some(&38.0));
        assert_eq!(values("0:1:0.3"), [0.0, 0.3, 0.6, 0.9]);
        assert_eq!(values("2:0:-1"), [2.0, 1.0, 0.0]);
        assert_eq!(values("7"), [7.0]);
        assert_eq!(values("0:1:0.3333333").last(), Some(&0.9999999));
        for text in ["0:89.999999:10", "0:1:0.3333334", "1:0:-0.3333334", "-30:30:7", "0:0.3:0.1", "5:5:1"] {
            let steps = Steps::parse(text, NumberUnit::None).expect("a range");
            let (low, high) = (steps.from.min(steps.to), steps.from.max(steps.to));
            let is_within = |v: f64| (low - 1e-9..=high + 1e-9).contains(&v);
            assert!(steps.count > 0 && steps.values().all(is_within), "{text}: {:?}", values(text));
        }
        for bad in ["", "1:2", "1:2:0", "2:1:1", "a:b:c", "0:inf:1", "0:1:1e-12", "1:2:3:4"] {
            assert!(Steps::parse(bad, NumberUnit::None).is_err(), "{bad}");
        }
    }

    #[test]
    fn grids_run_through_every_point_and_scattered_points_fill_the_box() {
        let varied = ["a=0:1:1", "b=0:4:2"].map(|v| v.parse().expect("parses")).to_vec();
        let mut sweep = Sweep { varied, scatter: None, seed: 1 };
        let points: Vec<_> = (0..6).map(|i| sweep.point(i)).collect();
        assert_eq!(sweep.count(), Some(6));
        assert_eq!(points, [[0., 0.], [0., 2.], [0., 4.], [1., 0.], [1., 2.], [1., 4.]]);
        sweep.scatter = Some(100);
        let quarter = (0..100).map(|i| sweep.point(i)).filter(|p| p[0] < 0.5 && p[1] < 2.0).count();
        assert!((23..=27).contains(&quarter), "{quarter}");
    }
}
