//! Estimators on stones that are not convex: convex ones as in lanes, sums, an independent tree of rays.

use super::nonconvex::{N, dented_cube, notched_prism, tree, triangles_of};
use super::stones::*;
use cutlab::advanced::estimators::nonconvex::{NonconvexHemisphere, NonconvexView};
use cutlab::advanced::estimators::view::{ObserverDome, ViewerLighting};
use cutlab::advanced::estimators::{
    BatchedEstimate, Hemisphere, TraceOptics, View, ViewFrame, hemisphere, view,
};
use cutlab::advanced::materials::Material;
use cutlab::advanced::sampling::kronecker::KroneckerPoints;
use cutlab::advanced::sampling::random::Purpose;
use cutlab::advanced::sampling::tally::Tally;
use cutlab::advanced::trace::ConvexStone;
use cutlab::advanced::trace::nonconvex::MeshStone;
use cutlab::advanced::trace::reference;
use glam::DVec3;

/// Sums of the dome that scores read, per power that arrives.
const DOME: [fn(&Tally) -> f64; 6] = [
    |t| t[hemisphere::RETURNED_COS2] / t[hemisphere::ARRIVED],
    |t| t[hemisphere::RETURNED] / t[hemisphere::ARRIVED],
    |t| t[hemisphere::LEAKED] / t[hemisphere::ARRIVED],
    |t| t[hemisphere::GLARE] / t[hemisphere::ARRIVED],
    |t| t[hemisphere::ABSORBED] / t[hemisphere::ARRIVED],
    |t| t[hemisphere::ARRIVED] / t[hemisphere::DRAWN],
];

/// Sums of the view that scores read, per ray.
const SIGHT: [fn(&Tally) -> f64; 9] = [
    |t| t[view::REFLECTED] / t[view::RAYS],
    |t| t[view::GREEN] / t[view::RAYS],
    |t| t[view::RED] / t[view::RAYS],
    |t| t[view::BLUE] / t[view::RAYS],
    |t| t[view::BELOW] / t[view::RAYS],
    |t| t[view::UP_COS2] / t[view::RAYS],
    |t| t[view::ABSORBED] / t[view::RAYS],
    |t| t[view::SCOPE_BRIGHT] / t[view::RAYS],
    |t| t[view::LUMINANCE] / t[view::RAYS],
];

/// Sixty sums, 4.5 errors each: one set of seeds in 2000 would fail.
#[test]
fn a_convex_mesh_scores_as_the_stone_does_in_lanes() {
    let cases = [("diamond", true, ViewFrame::FACE_UP), ("ruby", false, ViewFrame::tilted(25.0, 40.0))];
    for (solid, width) in [(brilliant(), 2.0), (random_stone(40, 7), 2.0)] {
        for (material, polarised, aspect) in cases {
            let material = Material::by_name(material).expect("in the catalogue");
            let medium = TraceOptics { material, polarised };
            let stone = ConvexStone::new(solid.clone());
            let mesh = MeshStone::new(&stone.solid.triangulate()).expect("closed");
            let around = ViewerLighting::default();
            let lanes = (
                Hemisphere::in_frame(&stone, &medium, aspect).expect("lit"),
                View::in_frame(&stone, &medium, aspect, around).expect("seen"),
            );
            let walked = (
                NonconvexHemisphere::new(&mesh, &medium, aspect).expect("lit"),
                NonconvexView::new(&mesh, &medium, aspect, around).expect("seen"),
            );
            let (mut a, mut b) = (BatchedEstimate::new(lanes.0, 1), BatchedEstimate::new(walked.0, 2));
            a.extend_to(1 << 16);
            b.extend_to(1 << 14);
            let close = |what: &str,
                         number: usize,
                         a: cutlab::advanced::sampling::stats::Estimate,
                         b: cutlab::advanced::sampling::stats::Estimate| {
                let within = 4.5 * a.error.hypot(b.error) + 2e-5 * width;
                assert!(
                    (a.value - b.value).abs() < within,
                    "{what} {number} of {}: {a:?} {b:?}",
                    material.name
                );
            };
            for (number, of) in DOME.iter().enumerate() {
                close("dome", number, a.estimate(of), b.estimate(of));
            }
            let (mut a, mut b) = (BatchedEstimate::new(lanes.1, 1), BatchedEstimate::new(walked.1, 2));
            a.extend_to(1 << 16);
            b.extend_to(1 << 14);
            for (number, of) in SIGHT.iter().enumerate() {
                close("view", number, a.estimate(of), b.estimate(of));
            }
        }
    }
}

/// [D] what arrives is mirrored, returned, leaked, absorbed or given up; likewise for lines of sight.
#[test]
fn all_light_of_a_nonconvex_stone_is_accounted_for() {
    let material = Material::by_name("ruby").expect("in the catalogue");
    for mesh in [dented_cube(), notched_prism()] {
        let stone = MeshStone::new(&mesh).expect("closed");
        for (polarised, aspect) in [(true, ViewFrame::FACE_UP), (false, ViewFrame::tilted(20.0, 10.0))] {
            let medium = TraceOptics { material, polarised };
            let mut dome =
                BatchedEstimate::new(NonconvexHemisphere::new(&stone, &medium, aspect).expect("lit"), 3);
            dome.extend_to(1 << 12);
            let t = |of: fn(&Tally) -> f64| dome.estimate(of).value;
            let all = t(|t| {
                (t[hemisphere::RETURNED]
                    + t[hemisphere::LEAKED]
                    + t[hemisphere::GLARE]
                    + t[hemisphere::ABSORBED]
                    + t[hemisphere::LOST])
                    / t[hemisphere::ARRIVED]
            });
            assert!((all - 1.0).abs() < 1e-12, "{all}");
            assert!(
                t(|t| t[hemisphere::LOST] / t[hemisphere::ARRIVED]) < 1e-3
                    && t(|t| t[hemisphere::ARRIVED] / t[hemisphere::DRAWN]) > 0.1
            );
            let around = ViewerLighting::default();
            let mut gaze =
                BatchedEstimate::new(NonconvexView::new(&stone, &medium, aspect, around).expect("seen"), 3);
            gaze.extend_to(1 << 12);
            let all = gaze.estimate(|t| {
                (view::up(t) + t[view::BELOW] + t[view::REFLECTED] + t[view::ABSORBED] + t[view::LOST])
                    / t[view::RAYS]
            });
            assert!((all.value - 1.0).abs() < 1e-12, "{all:?}");
        }
    }
}

/// [D] a stone of index 1 is not there: all light goes straight on, down.
#[test]
fn a_nonconvex_stone_of_index_one_leaks_everything() {
    let stone = MeshStone::new(&dented_cube()).expect("closed");
    let medium = TraceOptics { material: &Material::from_index(1.0), polarised: true };
    let aspect = ViewFrame::tilted(10.0, 70.0);
    let mut dome = BatchedEstimate::new(NonconvexHemisphere::new(&stone, &medium, aspect).expect("lit"), 5);
    dome.extend_to(1 << 12);
    let share = |of: fn(&Tally) -> f64| dome.estimate(of).value;
    assert!(
        share(|t| (t[hemisphere::GLARE] + t[hemisphere::RETURNED] + t[hemisphere::LOST])
            / t[hemisphere::ARRIVED])
            < 1e-12
    );
    assert!((share(|t| t[hemisphere::LEAKED] / t[hemisphere::ARRIVED]) - 1.0).abs() < 1e-12);
}

/// All light that comes from above along lines of sight, beside a tree that follows both parts of
/// every split with no chance and no estimator: 4 errors.
#[test]
fn luminance_of_a_nonconvex_stone_is_that_of_a_tree_of_rays() {
    const SIGHTS: u64 = 3000;
    for (mesh, polarised) in [(dented_cube(), true), (notched_prism(), false)] {
        let stone = MeshStone::new(&mesh).expect("closed");
        let (triangles, material) = (triangles_of(&mesh, &stone), Material::from_index(N));
        let medium = TraceOptics { material: &material, polarised };
        let around = ViewerLighting { dome: ObserverDome::with_observer(0.0), ..ViewerLighting::default() };
        let mut gaze = BatchedEstimate::new(
            NonconvexView::new(&stone, &medium, ViewFrame::FACE_UP, around).expect("seen"),
            7,
        );
        gaze.extend_to(1 << 16);
        let seen = gaze.estimate(|t| t[view::LUMINANCE] / t[view::RAYS]);
        let mut ups = Vec::new();
        let mut open = 0.0;
        for [a, b] in KroneckerPoints::<2>::new(SEED, Purpose::TEST, 930, 0..SIGHTS) {
            let point = DVec3::new(2.0 * a - 1.0, 2.0 * b - 1.0, 3.0);
            let ray = super::nonconvex::falling(point, -DVec3::Z, polarised);
            if stone.next_facet(point, -DVec3::Z, cutlab::advanced::trace::nonconvex::Side::Outside).is_some()
            {
                let [up, cut] = tree(&triangles, reference::ScalarRay { index: N, ..ray }, 1e-5);
                ups.push(up);
                open += cut;
            }
        }
        let n = ups.len() as f64;
        let mean = ups.iter().sum::<f64>() / n;
        let error = (ups.iter().map(|u| (u - mean).powi(2)).sum::<f64>() / (n * (n - 1.0))).sqrt();
        println!("walked {:.4} ± {:.4}, tree {mean:.4} ± {error:.4}", seen.value, seen.error);
        assert!(ups.len() > 500 && open / n < 0.01);
        assert!(
            (seen.value - mean).abs() < 4.0 * error.hypot(seen.error) + open / n,
            "{seen:?} {mean} ± {error}"
        );
    }
}
