//! The six round brilliants that reference figures are given for.

use crate::design::families;
use crate::design::{CutError, Design};
use std::collections::BTreeMap;

/// Index of the reference figures, at every wavelength.
pub const INDEX: f64 = 2.417;

/// A parameter and its value.
pub type GivenParameter = (&'static str, f64);

/// Names and proportions; what is not given is table 56, crown 34, pavilion 40.5, star 50, lower half
/// 75, girdle 3, 96 girdle facets.
pub const STONES: [(&str, &[GivenParameter]); 6] = [
    ("reference", &[]),
    ("tolkowsky", &[("table", 53.0), ("crown-angle", 34.5), ("pavilion-angle", 40.75), ("girdle", 2.0)]),
    ("57", &[("table", 57.0), ("crown-angle", 34.5), ("pavilion-angle", 40.8), ("lower-half", 77.0)]),
    ("steep-deep", &[("table", 58.0), ("crown-angle", 36.0), ("pavilion-angle", 41.8), ("lower-half", 80.0)]),
    ("fisheye", &[("table", 65.0), ("crown-angle", 30.0), ("pavilion-angle", 38.5)]),
    ("nailhead", &[("table", 58.0), ("crown-angle", 36.0), ("pavilion-angle", 43.0)]),
];

/// A round brilliant.
pub fn brilliant(given: &[(&str, f64)]) -> Result<Design, CutError> {
    let given: BTreeMap<String, f64> = given.iter().map(|(k, v)| (k.to_string(), *v)).collect();
    families::build("round-brilliant", &given)
}

/// A stone of the six by its name; another name gives the reference.
pub fn brilliant_by_name(name: &str) -> Result<Design, CutError> {
    brilliant(STONES.iter().find(|(n, _)| *n == name).map_or(&[], |s| s.1))
}
