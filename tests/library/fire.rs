//! Fire by beams is fire by photons.

use crate::brilliants::{SEED, diamond, named};
use cutlab::advanced::design::library;
use cutlab::advanced::estimators::point_light::PointLightNeeds;
use cutlab::advanced::estimators::weighted_exits::BeamEffort;
use cutlab::advanced::estimators::{BatchedEstimate, PointLight, TraceOptics, ViewFrame, fire, point_light};
use cutlab::advanced::sampling::stats::jackknife;
use cutlab::advanced::trace::ConvexStone;
use cutlab::advanced::trace::beams::Beams;

/// Streaks and lit area of three stones, with and without polarisation, upright and tilted, by both:
/// 4 errors.
#[test]
fn beams_and_photons_agree_on_fire() {
    let material = diamond();
    let princess = library::design("princess", &Default::default()).expect("in the library").expect("solved");
    for (design, polarised, aspect) in [
        (named("reference"), true, ViewFrame::FACE_UP),
        (named("nailhead"), false, ViewFrame::tilted(9.0, 20.0)),
        (princess, true, ViewFrame::FACE_UP),
    ] {
        let stone = ConvexStone::new(design.solid().expect("closed"));
        let medium = TraceOptics { material: &material, polarised };
        let mut photons =
            BatchedEstimate::new(PointLight::in_frame(&stone, &medium, aspect).expect("lit"), SEED);
        photons.extend_to(1 << 17);
        let effort = BeamEffort { photons: 1 << 14, seed: SEED, ..BeamEffort::default() };
        let beams =
            fire::fire(&Beams::new(&stone), &medium, aspect, PointLightNeeds::ALL, &effort).expect("lit");
        let pairs = [
            (
                "lit",
                photons.estimate(|t| t[point_light::LIT] / t[point_light::POINTS]),
                jackknife(&beams, |t| t[point_light::LIT] / t[point_light::POINTS]),
            ),
            (
                "streak",
                photons.estimate(|t| t[point_light::STREAK_DEG] / t[point_light::POINTS]),
                jackknife(&beams, |t| t[point_light::STREAK_DEG] / t[point_light::POINTS]),
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
    let (material, stone) = (diamond(), ConvexStone::new(named("reference").solid().expect("closed")));
    let medium = TraceOptics { material: &material, polarised: true };
    let sum = |needs| {
        let beam = PointLight::in_frame(&stone, &medium, ViewFrame::FACE_UP).expect("lit").for_needs(needs);
        let mut traced = BatchedEstimate::new(beam, SEED);
        traced.extend_to(1 << 13);
        traced.tallies().iter().map(|t| t[point_light::STREAK_DEG]).sum::<f64>()
    };
    let (all, seen) = (sum(PointLightNeeds::ALL), sum(PointLightNeeds { lit: false, faint: false }));
    assert!(all > 0.0 && (all / seen - 1.0).abs() < 1e-9, "{all} {seen}");
}
