//! Fire by beams is fire by photons.

mod brilliants;

use brilliants::{SEED, diamond, named};
use cutlab::cut::library;
use cutlab::experiments::beam::Needs;
use cutlab::experiments::weigh::Effort;
use cutlab::experiments::{Aspect, Beam, Medium, Traced, fire};
use cutlab::math::stats::jackknife;
use cutlab::walk::Stone;
use cutlab::walk::beams::Beams;

/// Streaks and lit area of three stones, with and without polarisation, upright and tilted, by both:
/// 4 errors.
#[test]
fn beams_and_photons_agree_on_fire() {
    let material = diamond();
    let princess = library::design("princess", &Default::default()).expect("in the library").expect("solved");
    for (design, polarised, aspect) in [
        (named("reference"), true, Aspect::FACE_UP),
        (named("nailhead"), false, Aspect::tilted(9.0, 20.0)),
        (princess, true, Aspect::FACE_UP),
    ] {
        let stone = Stone::new(design.solid().expect("closed"));
        let medium = Medium { material: &material, polarised };
        let mut photons = Traced::new(Beam::seen_from(&stone, &medium, aspect).expect("lit"), SEED);
        photons.extend_to(1 << 17);
        let effort = Effort { photons: 1 << 14, seed: SEED, ..Effort::default() };
        let beams = fire::fire(&Beams::new(&stone), &medium, aspect, Needs::ALL, &effort).expect("lit");
        let pairs = [
            ("lit", photons.estimate(|t| t.lit / t.points), jackknife(&beams, |t| t.lit / t.points)),
            (
                "streak",
                photons.estimate(|t| t.streak_deg / t.points),
                jackknife(&beams, |t| t.streak_deg / t.points),
            ),
        ];
        for (what, a, b) in pairs {
            println!("{what}: photons {a:?} beams {b:?}");
            assert!((a.value - b.value).abs() < 4.0 * a.error.hypot(b.error), "{what}: {a:?} {b:?}");
            assert!(b.error < 4e-3, "{what}: {b:?}");
        }
    }
}

/// What is left out where it is not needed changes nothing of the rest.
#[test]
fn streaks_are_the_same_without_what_cannot_be_seen() {
    let (material, stone) = (diamond(), Stone::new(named("reference").solid().expect("closed")));
    let medium = Medium { material: &material, polarised: true };
    let sum = |needs| {
        let beam = Beam::seen_from(&stone, &medium, Aspect::FACE_UP).expect("lit").for_needs(needs);
        let mut traced = Traced::new(beam, SEED);
        traced.extend_to(1 << 13);
        traced.tallies().iter().map(|t| t.streak_deg).sum::<f64>()
    };
    let (all, seen) = (sum(Needs::ALL), sum(Needs { lit: false, faint: false }));
    assert!(all > 0.0 && (all / seen - 1.0).abs() < 1e-9, "{all} {seen}");
}
