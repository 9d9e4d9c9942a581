//! `--exact`: what beams give is what photons give, within the errors of both; closed forms have none.

use crate::brilliants::{diamond, named, plan, subject};
use cutlab::advanced::design::library;
use cutlab::advanced::materials::Material;
use cutlab::advanced::metrics::{METRICS, Metric};
use cutlab::advanced::scoring::score::{ScoreInput, Tilt, score};
use cutlab::advanced::stone::Stone;

/// Twenty-seven metrics of two stones, face-up and tilted, with and without polarisation: 4.2 errors.
#[test]
#[ignore = "beams from hundreds of directions, twenty seconds in release"]
fn beams_agree_with_photons() {
    let names: Vec<&str> = METRICS.iter().filter(|m| m.by_beams).map(|m| m.name).collect();
    for (stone, tilt, polarised) in
        [("reference", None, true), ("nailhead", Some(Tilt { degrees: 12.0, azimuth: 20.0 }), false)]
    {
        let subject = ScoreInput { tilt, ..subject(stone, &named(stone), diamond()) };
        let random = plan(&names, 1 << 18).polarised(polarised);
        let exact = random.clone().exact(true).samples(1 << 16);
        let [a, b] = [random, exact].map(|plan| score(&subject, &plan));
        assert_eq!((a.error, b.error), (None, None));
        for ((name, a), b) in names.iter().zip(a.scores).zip(b.scores) {
            let (a, b) = (a.expect("applies"), b.expect("applies"));
            println!(
                "{stone} {name}: photons {:.6} ± {:.6}, beams {:.6} ± {:.6}",
                a.value, a.error, b.value, b.error
            );
            // beyond the errors: what the lanes give up, and the beams' undecided points
            let metric = Metric::by_name(name).expect("in the catalogue");
            let slack = 5e-5 * metric.scale;
            assert!((a.value - b.value).abs() < 4.2 * a.error.hypot(b.error) + slack, "{stone} {name}");
            let faceters = metric.estimator.name() == "iso";
            // a clear stone absorbs nothing
            let closed = name.ends_with("strongest") || faceters || ["windowing", "absorbed"].contains(name);
            assert_eq!(b.error == 0.0, closed, "{name}: {b:?}");
        }
    }
}

/// The errors asked for are reached by directions and by photons.
#[test]
fn exact_scores_reach_an_error_too() {
    let asked = plan(&["aset_red", "wlr", "brightness"], 0);
    let plan = asked.exact(true).error(0.002);
    let row = score(&subject("reference", &named("reference"), diamond()), &plan);
    assert_eq!(row.error, None);
    for e in row.scores {
        let e = e.expect("applies");
        assert!(e.error > 0.0 && e.error <= 0.002, "{e:?}");
    }
}

/// Where photons take the place of the beams that were asked for, the row says so and why.
#[test]
fn photons_in_place_of_beams_are_told() {
    let asked = |metrics: &[&str]| plan(metrics, 256).exact(true);
    let row = |material: Material, metrics: &[&str]| {
        let subject = subject("reference", &named("reference"), material);
        score(&subject, &asked(metrics))
    };
    // light stays in a stone of n = 10 for thousands of facets, and divides at each
    let deep = row(Material::from_index(10.0), &["aset_red_strongest"]);
    assert!(deep.note.is_some_and(|said| said.starts_with("too many beams")), "{deep:?}");
    assert!(deep.left_out.is_empty(), "what photons gave is not left out: {deep:?}");
    assert!(deep.scores[0].is_some_and(|e| e.error > 0.0), "photons have an error: {deep:?}");
    let shares = row(Material::from_index(10.0), &["aset_red"]);
    assert_eq!((shares.note, shares.error), (None, None), "no beam's own path is needed");
    let ruby = Material::by_name("ruby").expect("in the catalogue");
    let coloured = row(ruby.clone(), &["aset_red", "spread"]);
    assert!(coloured.note.is_some_and(|said| said.contains("do not follow absorption")), "{coloured:?}");
    assert_eq!(row(ruby.clone(), &["contrast", "spread"]).note, None, "beams give none of these");
    assert_eq!(row(diamond(), &["aset_red", "aset_red_strongest"]).note, None);

    let (corners, faces) = CUBE_WITH_A_DENT;
    let mesh = corners.iter().map(|v| format!("v {} {} {}\n", v[0], v[1], v[2])).collect::<String>()
        + &faces.iter().map(|f| format!("f {f}\n")).collect::<String>();
    let stone = Stone::from_bytes("dented.obj", mesh.as_bytes(), None).expect("it is closed");
    let subject = ScoreInput::from_stone(&stone.with_material(diamond()), None);
    let row = score(&subject, &asked(&["light_return"]));
    assert!(row.note.is_some_and(|said| said.starts_with("beams need a convex stone")), "{row:?}");
    assert_eq!(score(&subject, &plan(&["light_return"], 256)).note, None);
}

/// Rays that look straight into a cube all go the same way, so nothing but the light that they give up is
/// between photons and beams: the viewer's own share holds it in its error too.
#[test]
fn what_is_given_up_counts_for_every_share_of_a_view() {
    let names: Vec<&str> = METRICS
        .iter()
        .map(|m| m.name)
        .filter(|n| n.starts_with("aset_") || n.starts_with("ideal_"))
        .collect();
    let cube = library::design("cube", &Default::default()).expect("in the library").expect("solved");
    let subject = subject("cube", &cube, diamond());
    let random = plan(&names, 1 << 13);
    let exact = random.clone().exact(true);
    let [a, b] = [random, exact].map(|plan| score(&subject, &plan).scores);
    for ((name, a), b) in names.iter().zip(a).zip(b) {
        let (a, b) = (a.expect("applies"), b.expect("applies"));
        let off = (a.value - b.value).abs();
        assert!(off <= 4.2 * a.error.hypot(b.error) + 1e-7, "{name}: {a:?} {b:?}");
    }
}

/// Corners and faces of a cube with a pit in its top.
const CUBE_WITH_A_DENT: ([[f64; 3]; 9], [&str; 9]) = (
    [
        [-1.0, -1.0, -1.0],
        [1.0, -1.0, -1.0],
        [1.0, 1.0, -1.0],
        [-1.0, 1.0, -1.0],
        [-1.0, -1.0, 1.0],
        [1.0, -1.0, 1.0],
        [1.0, 1.0, 1.0],
        [-1.0, 1.0, 1.0],
        [0.0, 0.0, 0.5],
    ],
    ["4 3 2 1", "1 2 6 5", "2 3 7 6", "3 4 8 7", "4 1 5 8", "5 6 9", "6 7 9", "7 8 9", "8 5 9"],
);
