//! Round brilliants of the reference figures, and their scores.

#![allow(dead_code)] // each test file uses its part

use cutlab::cut::{Design, families};
use cutlab::math::stats::Estimate;
use cutlab::metrics::Metric;
use cutlab::optics::Material;
use cutlab::study::score::{Effort, Plan, Subject, score};
use cutlab::walk::Stone;
use std::collections::BTreeMap;

/// The only seed of these tests.
pub const SEED: u64 = 1;

/// Names and proportions of the stones of §4; what is not given is star 50, lower half 75, girdle 3.
pub const STONES: [(&str, &[(&str, f64)]); 6] = [
    ("reference", &[]),
    ("tolkowsky", &[("table", 53.0), ("crown-angle", 34.5), ("pavilion-angle", 40.75), ("girdle", 2.0)]),
    ("57", &[("table", 57.0), ("crown-angle", 34.5), ("pavilion-angle", 40.8), ("lower-half", 77.0)]),
    ("steep-deep", &[("table", 58.0), ("crown-angle", 36.0), ("pavilion-angle", 41.8), ("lower-half", 80.0)]),
    ("fisheye", &[("table", 65.0), ("crown-angle", 30.0), ("pavilion-angle", 38.5)]),
    ("nailhead", &[("table", 58.0), ("crown-angle", 36.0), ("pavilion-angle", 43.0)]),
];

pub fn design(proportions: &[(&str, f64)]) -> Design {
    let given: BTreeMap<String, f64> = proportions.iter().map(|(k, v)| (k.to_string(), *v)).collect();
    families::build("round-brilliant", &given).expect("builds")
}

pub fn named(name: &str) -> Design {
    design(STONES.iter().find(|(n, _)| *n == name).expect("a stone of the list").1)
}

pub fn stone(design: &Design) -> Stone {
    Stone::new(design.solid().expect("closed"))
}

/// The stones of §4 have this index at all wavelengths.
pub fn n2417() -> Material {
    Material::of_index(2.417)
}

pub fn diamond() -> Material {
    Material::named("diamond").expect("in the catalogue").clone()
}

pub fn subject(name: &str, design: &Design, material: Material) -> Subject {
    let shape = design.solid().map(Into::into).map_err(|e| e.to_string());
    Subject { stone: name.into(), material, shape, tilt: None }
}

/// Scalar Fresnel, as the reference figures have it.
pub fn plan(metrics: &[&str], samples: u64) -> Plan {
    let metrics = metrics.iter().map(|m| Metric::named(m).expect("in the catalogue")).collect();
    Plan { metrics, effort: Effort::Samples(samples), polarised: false, seed: SEED, ..Plan::default() }
}

pub fn scores<const N: usize>(
    design: &Design,
    material: Material,
    metrics: [&str; N],
    samples: u64,
) -> [Estimate; N] {
    let row = score(&subject("stone", design, material), &plan(&metrics, samples));
    assert_eq!(row.error, None);
    std::array::from_fn(|i| row.scores[i].expect("applies"))
}
