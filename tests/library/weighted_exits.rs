//! Scores of a caller's own weights, by exact beams: GemRay's ISO, COS and SC2 of `physics.md` §4,
//! followed for nine facets inside as GemRay does.

use crate::corpus_folder::corpus;
use cutlab::advanced::batch::validate::figures;
use cutlab::advanced::design::{Design, library};
use cutlab::advanced::estimators::weighted_exits::{BeamEffort, integrate_exits};
use cutlab::advanced::formats;
use cutlab::advanced::trace::ConvexStone;
use cutlab::advanced::trace::beams::{Beams, IncidentBeam, StopCriteria};
use glam::DVec3;
use std::collections::BTreeMap;

/// ISO, COS and SC2 in percent, face-up, under a head of this half-angle.
fn averages(design: &Design, index: f64, head_deg: f64) -> [f64; 3] {
    let stone = ConvexStone::new(design.solid().expect("closed"));
    let until = StopCriteria { facets: 9, ..StopCriteria::at_power(1e-7) };
    let effort = BeamEffort { stop: until, photons: 0, seed: 1, ..BeamEffort::default() };
    let lit = IncidentBeam { direction: DVec3::NEG_Z, indices: [index] };
    let head = head_deg.to_radians().cos();
    let weighed = integrate_exits(&Beams::new(&stone), &lit, false, &effort, |l| {
        let bright = l.up > 0.0 && l.up < head && stone.planes[l.facet].normal.z > 1e-4;
        let sc2 = 2.0 * l.up * (1.0 - l.up * l.up).max(0.0).sqrt();
        if bright { [1.0, l.up, sc2] } else { [0.0; 3] }
    });
    let weighed = weighed.expect("lit");
    std::array::from_fn(|k| 100.0 * (weighed.sum(k).value + weighed.glare[k]))
}

/// [P] COS and ISO that the US Faceters Guild prints for two of its designs, without a head, to the
/// ±4 points that its grid and rounding leave open.
#[test]
fn averages_are_those_that_the_faceters_guild_prints() {
    for f in figures::set("no head shadow") {
        let design = library::design(&f.of, &BTreeMap::new()).expect("there").expect("good");
        let [iso, cos, _] = averages(&design, 1.54, 0.0);
        let got = if f.quantity == "iso" { iso } else { cos };
        println!("{} {}: {got:.2}", f.of, f.quantity);
        assert!((got - f.expected).abs() < f.tolerance(), "{f:?}: {got}");
    }
}

/// [R] With a head of 10°, by 300 × 300 points of an independent tracer (`physics.md` §4).
#[test]
fn averages_are_those_of_an_independent_tracer() {
    let Some(corpus) = corpus() else { return };
    let weights = ["iso", "cos", "sc2"];
    for f in figures::set("head of 10°") {
        let Some(weight) = weights.iter().position(|w| *w == f.quantity) else { continue };
        let path = corpus.join("pairs").join(&f.of);
        let imported = formats::read(&path).expect("reads");
        let got = averages(&imported.design, f.at.expect("the set varies it"), 10.0)[weight];
        println!("{} {}: {got:.2}", f.of, f.quantity);
        assert!((got - f.expected).abs() < 0.5, "{f:?}: {got}");
    }
}
