//! Scores of a caller's own weights, by exact beams: GemRay's ISO, COS and SC2 of `physics.md` §4,
//! followed for nine facets inside as GemRay does.

use cutlab::design::{Design, library};
use cutlab::estimators::weighted_exits::{BeamEffort, integrate_exits};
use cutlab::formats;
use cutlab::trace::ConvexStone;
use cutlab::trace::beams::{Beams, IncidentBeam, StopCriteria};
use glam::DVec3;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// ISO, COS and SC2 in percent, face-up, under a head of this half-angle.
fn averages(design: &Design, index: f64, head_deg: f64) -> [f64; 3] {
    let stone = ConvexStone::new(design.solid().expect("closed"));
    let until = StopCriteria { facets: 9, ..StopCriteria::at_power(1e-7) };
    let effort = BeamEffort { stop: until, photons: 0, seed: 1 };
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
    for (name, cos, iso) in [("classic", 40.6, 46.5), ("first-stone", 82.1, 86.9)] {
        let design = library::design(name, &BTreeMap::new()).expect("there").expect("good");
        let [got_iso, got_cos, _] = averages(&design, 1.54, 0.0);
        println!("{name}: ISO {got_iso:.2}, COS {got_cos:.2}");
        assert!((got_iso - iso).abs() < 4.0 && (got_cos - cos).abs() < 4.0, "{name} {got_iso} {got_cos}");
    }
}

/// [R] With a head of 10°, by 300 × 300 points of an independent tracer (`physics.md` §4).
#[test]
fn averages_are_those_of_an_independent_tracer() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let corpus =
        std::env::var_os("CUTLAB_CORPUS").map_or_else(|| here.join("../shared/corpus"), PathBuf::from);
    for (file, index, expected) in [
        ("SRB", 1.54, [54.19, 49.88, 31.62]),
        ("SRB", 2.417, [69.51, 57.04, 53.73]),
        ("Turkey", 1.76, [70.35, 45.94, 51.34]),
    ] {
        let path = corpus.join("pairs").join(file).with_extension("asc");
        let Ok(imported) = formats::read(&path) else {
            println!("no {}: not checked", path.display());
            continue;
        };
        let got = averages(&imported.design, index, 10.0);
        println!("{file} at {index}: {got:.2?}");
        for (got, expected) in got.iter().zip(expected) {
            assert!((got - expected).abs() < 0.5, "{file} at {index}: {got} for {expected}");
        }
    }
}
