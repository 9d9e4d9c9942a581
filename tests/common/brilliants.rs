//! Round brilliants of the reference figures, and their scores.

#![allow(dead_code)] // each test file uses its part

use cutlab::advanced::batch::validate::stones;
use cutlab::advanced::batch::validate::stones::STONES;
use cutlab::advanced::design::Design;
use cutlab::advanced::materials::Material;
use cutlab::advanced::metrics::Metric;
use cutlab::advanced::sampling::stats::Estimate;
use cutlab::advanced::scoring::score::{ScoreInput, ScoreRequest, score};
use cutlab::advanced::trace::ConvexStone;

/// The only seed of these tests.
pub const SEED: u64 = 1;

pub fn design(proportions: &[(&str, f64)]) -> Design {
    stones::brilliant(proportions).expect("builds")
}

pub fn named(name: &str) -> Design {
    design(STONES.iter().find(|(n, _)| *n == name).expect("a stone of the list").1)
}

pub fn stone(design: &Design) -> ConvexStone {
    ConvexStone::new(design.solid().expect("closed"))
}

/// The stones of §4 have this index at all wavelengths.
pub fn n2417() -> Material {
    Material::from_index(2.417)
}

pub fn diamond() -> Material {
    Material::by_name("diamond").expect("in the catalogue").clone()
}

pub fn subject(name: &str, design: &Design, material: Material) -> ScoreInput {
    let shape = design.solid().map(Into::into).map_err(|e| e.to_string());
    ScoreInput { stone: name.into(), material, shape, tilt: None }
}

/// Scalar Fresnel, as the reference figures have it.
pub fn plan(metrics: &[&str], samples: u64) -> ScoreRequest {
    let metrics = metrics.iter().map(|m| Metric::by_name(m).expect("in the catalogue"));
    ScoreRequest::default().metrics(metrics).samples(samples).polarised(false).seed(SEED)
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
