//! The report's pictures against reference figures.

use cutlab::cut::library;
use cutlab::optics::Material;
use cutlab::report::aset;
use cutlab::walk::Stone;
use std::collections::BTreeMap;

fn reference_stone() -> Stone {
    let design =
        library::design("round-brilliant", &BTreeMap::new()).expect("in the library").expect("can be made");
    Stone::new(design.solid().expect("closed"))
}

/// Shares of the strongest path from the project's sources (reference tracer): green 6.0, red 66.7,
/// blue 22.8, leakage 4.5, ±.5 % of the face-up area.
#[test]
fn the_aset_picture_has_the_reference_shares() {
    let index = Material::named("diamond").expect("in the catalogue").index_d() as f32;
    let picture = aset::picture(&reference_stone(), index, 160).expect("can be encoded");
    for (share, expected) in picture.shares.iter().zip([0.060, 0.667, 0.228, 0.045]) {
        assert!((share - expected).abs() < 0.005, "{:?}", picture.shares);
    }
    assert!((picture.shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
}

#[test]
fn the_aset_picture_is_the_same_on_any_number_of_threads() {
    let stone = reference_stone();
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| aset::picture(&stone, 2.417, 48).expect("can be encoded").png)
    };
    let one = on(1);
    assert_eq!(one, on(2));
    assert_eq!(one, on(5));
}
