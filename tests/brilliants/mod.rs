//! Round brilliants of the reference figures, and their scores.

#![allow(dead_code)] // each test file uses its part

use cutlab::cut::Design;
use cutlab::math::stats::Estimate;
use cutlab::metrics::Metric;
use cutlab::optics::Material;
use cutlab::study::score::{Effort, Plan, Subject, score};
use cutlab::study::validate::stones::{self, STONES};
use cutlab::walk::Stone;

/// The only seed of these tests.
pub const SEED: u64 = 1;

pub fn design(proportions: &[(&str, f64)]) -> Design {
    stones::brilliant(proportions).expect("builds")
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
