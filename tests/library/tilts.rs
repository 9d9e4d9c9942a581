//! Tilted stones: the viewer who turns about a stone sees what a viewer before a turned stone sees.

use crate::brilliants::{SEED, diamond, n2417, named, plan, subject};
use cutlab::advanced::estimators::view::ViewerLighting;
use cutlab::advanced::estimators::{
    BatchedEstimate, FaceterView, TraceOptics, View, ViewFrame, faceter_view, view,
};
use cutlab::advanced::sampling::stats::Estimate;
use cutlab::advanced::scoring::score::{ScoreInput, Tilt, score};
use cutlab::advanced::trace::ConvexStone;
use glam::{DMat3, DVec3};

#[track_caller]
fn assert_same(what: &str, a: Estimate, b: Estimate) {
    let off = (a.value - b.value).abs();
    assert!(off < 4.2 * a.error.hypot(b.error) + 1e-6, "{what}: {a:?} and {b:?}");
}

#[test]
fn a_turned_viewer_sees_a_turned_stone() {
    let design = named("steep-deep");
    let axle = DVec3::new(40f64.to_radians().cos(), 40f64.to_radians().sin(), 0.0);
    let turned = design.clone().turned(DMat3::from_axis_angle(axle, 17f64.to_radians()));
    let [still, turned] = [design, turned].map(|d| ConvexStone::new(d.solid().expect("closed")));
    let material = n2417();
    let medium = TraceOptics { material: &material, polarised: true };
    let aspect = ViewFrame::tilted(17.0, 40.0);
    let view = |stone, aspect| {
        let view = View::in_frame(stone, &medium, aspect, ViewerLighting::default()).expect("lit");
        let mut seen = BatchedEstimate::new(view, SEED);
        seen.extend_to(1 << 16);
        let bands = (0..4).map(|b| seen.estimate(|t| t[view::BANDS[b]] / t[view::RAYS])).collect::<Vec<_>>();
        (
            bands,
            [
                seen.estimate(|t| t[view::LUMINANCE] / t[view::RAYS]),
                seen.estimate(|t| t[view::SCOPE_BRIGHT] / t[view::RAYS]),
            ],
        )
    };
    let (a, b) = (view(&still, aspect), view(&turned, ViewFrame::FACE_UP));
    for (a, b) in a.0.into_iter().chain(a.1).zip(b.0.into_iter().chain(b.1)) {
        assert_same("view", a, b);
    }
    let iso = |stone, aspect| {
        let sky = cutlab::advanced::estimators::view::ObserverDome::with_observer(
            faceter_view::GEMRAY_OBSERVER_DEG,
        );
        let mut seen =
            BatchedEstimate::new(FaceterView::in_frame(stone, &medium, aspect, sky).expect("lit"), SEED);
        seen.extend_to(1 << 16);
        seen.estimate(|t| 100.0 * t[faceter_view::SC2] / t[faceter_view::RAYS])
    };
    assert_same("sc2", iso(&still, aspect), iso(&turned, ViewFrame::FACE_UP));
}

/// [D] what arrives leaves or is counted whatever the tilt, and a quarter turn of an eightfold stone
/// changes nothing.
#[test]
fn tilts_keep_energy_and_symmetry() {
    let metrics = ["light_return", "glare", "leakage", "lost", "wlr", "fire_lit", "contrast", "iso"];
    let tilted = |degrees, azimuth| {
        let tilt = Some(Tilt { degrees, azimuth });
        let subject = ScoreInput { tilt, ..subject("reference", &named("reference"), diamond()) };
        let row = score(&subject, &plan(&metrics, 1 << 16));
        assert_eq!(row.error, None);
        row.scores.into_iter().map(|s| s.expect("applies")).collect::<Vec<_>>()
    };
    let (one, other) = (tilted(20.0, 10.0), tilted(20.0, 100.0));
    let sum: f64 = one[..4].iter().map(|e| e.value).sum();
    assert!((sum - 1.0).abs() < 1e-4, "{sum}");
    for (name, (a, b)) in metrics.into_iter().zip(one.iter().zip(&other)) {
        assert_same(name, *a, *b);
    }
    let face_up = tilted(0.0, 0.0);
    assert!(face_up[4].value > one[4].value + 0.01, "a tilted brilliant returns less: {one:?}");
}
