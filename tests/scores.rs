//! Scores against published figures [P], figures that follow from the definitions [D], and figures
//! of an independent reference tracer [R].
//!
//! [R] and [P] figures are those of the project's physics notes, §3 and §4. An expectation is met
//! within its own tolerance plus 3.3 standard errors of ours (α = 0.001).

mod brilliants;

use brilliants::{SEED, design, diamond, n2417, named, scores, stone};
use cutlab::batch::validate::returns::{BY_CROWN, BY_TABLE};
use cutlab::design::library;
use cutlab::estimators::{BatchedEstimate, Hemisphere, TraceOptics, View, hemisphere, view};
use cutlab::materials::Material;
use cutlab::sampling::stats::Estimate;
use cutlab::sampling::tally::Tally;
use std::collections::BTreeMap;

#[track_caller]
fn assert_near(what: &str, e: Estimate, expected: f64, tolerance: f64) {
    println!("{what}: {:.5} ± {:.5}, expected {expected} ± {tolerance}", e.value, e.error);
    assert!(
        (e.value - expected).abs() < tolerance + 3.3 * e.error,
        "{what}: {:.5} ± {:.5}, expected {expected} ± {tolerance}",
        e.value,
        e.error
    );
}

/// [R] .2832 for the reference stone (two independent tracers gave .2840 and .2832 ± .0001).
#[test]
fn wlr_of_the_reference_stone() {
    let [wlr] = scores(&named("reference"), n2417(), ["wlr"], 1 << 18);
    assert!(wlr.error < 0.001, "the default effort promises ±.001: {wlr:?}");
    assert_near("wlr", wlr, 0.2832, 0.001);
}

/// [R] ± .001.
#[test]
fn wlr_of_the_other_stones() {
    for (name, expected) in [
        ("tolkowsky", 0.2864),
        ("57", 0.2816),
        ("steep-deep", 0.2731),
        ("fisheye", 0.2694),
        ("nailhead", 0.2661),
    ] {
        let [wlr] = scores(&named(name), n2417(), ["wlr"], 1 << 18);
        assert_near(name, wlr, expected, 0.001);
    }
}

/// [R] by the flux through the girdle disc .3055, counting rejected directions .264.
#[test]
fn wlr_by_other_normalisations() {
    let stone = stone(&named("reference"));
    let mut dome = BatchedEstimate::new(
        Hemisphere::new(&stone, &TraceOptics { material: &n2417(), polarised: false }).expect("lit"),
        SEED,
    );
    dome.extend_to(1 << 18);
    let drawn = dome.estimate(|t| t[hemisphere::RETURNED_COS2] / t[hemisphere::DRAWN]);
    assert_near("rejected counted", drawn, 0.264, 0.001);
    let areas = dome.estimator().crown_area / dome.estimator().outline_area;
    let disc = Estimate { value: drawn.value * areas, error: drawn.error * areas };
    assert_near("by the girdle disc", disc, 0.3055, 0.001);
}

/// [R] by crown angle and by table. The list's own scatter is larger than .001: it has .2838 for the
/// stone that is .2832 above, and at crowns 20 and 45 and table 60 a plain Monte Carlo in `f64` gave
/// .2989, .2206 and .2800 (± .0003), as the lanes do. Hence ± .002.
#[test]
#[ignore = "seventeen stones, half a minute in release"]
fn wlr_by_crown_angle_and_table() {
    let rows = BY_CROWN.map(|r| ("crown-angle", r)).into_iter().chain(BY_TABLE.map(|r| ("table", r)));
    for (key, (value, expected)) in rows {
        let [wlr] = scores(&design(&[(key, value)]), n2417(), ["wlr"], 1 << 19);
        assert_near(&format!("{key} {value}"), wlr, expected, 0.002);
    }
}

/// [P] JCK's account of Hemphill et al. 1998: no crown at all gives the absolute maximum, the best
/// crown angle from 10° on is 23°, crowns over 34.5° never give a high value.
#[test]
#[ignore = "eleven stones, fifteen seconds in release"]
fn wlr_trends_of_the_1998_paper() {
    let wlr = |crown: f64| scores(&design(&[("crown-angle", crown)]), n2417(), ["wlr"], 1 << 19)[0];
    let angles = [10.0, 15.0, 19.0, 23.0, 27.0, 31.0, 34.0];
    let best = angles.into_iter().max_by(|a, b| wlr(*a).value.total_cmp(&wlr(*b).value));
    assert_eq!(best, Some(23.0));
    let peak = wlr(23.0);
    assert!(wlr(0.0).value > peak.value + 5.0 * peak.error, "no crown is best of all");
    for crown in [35.0, 38.0, 42.0] {
        assert!(wlr(crown).value < wlr(34.0).value, "crown {crown}");
    }
}

/// [D] the lanes with their evenly spread points against a plain Monte Carlo in `f64`: another
/// tracer, another sampling, the same definition.
#[test]
fn wlr_against_a_plain_tracer() {
    use cutlab::optics::fresnel;
    use cutlab::sampling::{random::*, warps};
    use cutlab::trace::reference;
    let stone = stone(&named("nailhead"));
    let up = |facet: usize| stone.planes[facet].normal.z > 1e-3;
    let mut triangles = Vec::new();
    let mut area = 0.0;
    for facet in (0..stone.facet_count()).filter(|f| up(*f)) {
        let corners: Vec<_> = stone.solid.polygon(facet).map(|v| stone.point_from_design(v)).collect();
        for pair in corners[1..].windows(2) {
            area += (pair[0] - corners[0]).cross(pair[1] - corners[0]).length();
            triangles.push((area, facet, [corners[0], pair[0], pair[1]]));
        }
    }
    let (mut s, n, count) = (Stream::new(SEED, Purpose::TEST, 0), 2.417, 40_000);
    let (mut accepted, mut sum, mut squares) = (0, 0.0, 0.0);
    while accepted < count {
        let u = area * s.unit64();
        let (_, facet, [a, b, c]) = triangles[triangles.partition_point(|t| t.0 < u)];
        let weights = warps::uniform_triangle(s.pair()).map(f64::from);
        let sky = warps::to_world(stone.normals[facet], warps::cosine_hemisphere(s.pair())).as_dvec3();
        if sky.z <= 0.0 {
            continue;
        }
        accepted += 1;
        let normal = stone.planes[facet].normal;
        let (reflectance, cos_t) = fresnel::unpolarised(sky.dot(normal).clamp(0.0, 1.0), n);
        let ray = reference::ScalarRay {
            point: a + (b - a) * weights[0] + (c - a) * weights[1],
            direction: (-sky / n + normal * (sky.dot(normal) / n - cos_t)).normalize(),
            power: 1.0 - reflectance,
            index: n,
            absorption: 0.0,
            stokes: None,
        };
        let mut returned = 0.0;
        reference::trace(&stone.planes, ray, 1e-4, |m| {
            returned += if up(m.facet) { m.power * m.direction.z.max(0.0).powi(2) } else { 0.0 };
        });
        sum += returned;
        squares += returned * returned;
    }
    let (mean, count) = (sum / f64::from(count), f64::from(count));
    let error = ((squares / count - mean * mean) / count).sqrt();
    let [wlr] = scores(&named("nailhead"), n2417(), ["wlr"], 1 << 18);
    assert_near("plain tracer", Estimate { value: mean, error: error.hypot(wlr.error) }, wlr.value, 0.0);
}

/// [R] ± .5 points: share of the face-up area, by energy.
#[test]
fn aset_by_energy() {
    for (name, expected) in [
        ("reference", [6.2, 50.1, 18.3, 7.9]),
        ("tolkowsky", [6.1, 51.5, 17.3, 7.6]),
        ("steep-deep", [24.1, 36.0, 9.6, 12.8]),
        ("nailhead", [31.0, 38.7, 2.6, 10.2]),
        ("fisheye", [8.1, 43.0, 23.6, 8.0]),
    ] {
        let metrics = ["aset_green", "aset_red", "aset_blue", "aset_leak"];
        let found = scores(&named(name), n2417(), metrics, 1 << 17);
        for ((metric, e), expected) in metrics.into_iter().zip(found).zip(expected) {
            assert_near(&format!("{name} {metric}"), e, expected / 100.0, 0.005);
        }
    }
}

/// [R] ± .5 points: the map of the strongest path of each point.
#[test]
fn aset_by_the_strongest_path() {
    let metrics = ["aset_green_strongest", "aset_red_strongest", "aset_blue_strongest", "leakage_strongest"];
    let found = scores(&named("reference"), n2417(), metrics, 1 << 17);
    for ((metric, e), expected) in metrics.into_iter().zip(found).zip([6.0, 66.7, 22.8, 4.5]) {
        assert_near(metric, e, expected / 100.0, 0.005);
    }
}

/// [P] PriceScope, DiamCalc: crown 35, table 56, lower halves 80: leakage jumps between pavilion
/// 41.15 and 41.25; [R] from 3.4 % to 12.4 %.
#[test]
fn leakage_jumps_between_two_pavilion_angles() {
    let leakage = |pavilion| {
        let proportions = [("crown-angle", 35.0), ("lower-half", 80.0), ("pavilion-angle", pavilion)];
        scores(&design(&proportions), n2417(), ["leakage_strongest"], 1 << 17)[0]
    };
    assert_near("41.15", leakage(41.15), 0.034, 0.005);
    assert_near("41.25", leakage(41.25), 0.124, 0.005);
}

/// [R] ± 3.5 %, threshold 10⁻³: (lit, streak).
#[test]
#[ignore = "six stones in six lines, eight seconds in release"]
fn fire() {
    for (name, lit, streak) in [
        ("reference", 1.59, 1.25),
        ("tolkowsky", 1.60, 1.27),
        ("57", 1.47, 1.20),
        ("steep-deep", 1.30, 0.92),
        ("nailhead", 1.21, 0.89),
        ("fisheye", 1.58, 0.83),
    ] {
        let found = scores(&named(name), diamond(), ["fire_lit", "fire_streak"], 1 << 18);
        assert_near(&format!("{name} lit"), found[0], lit, 0.035 * lit);
        assert_near(&format!("{name} streak"), found[1], streak, 0.035 * streak);
    }
}

/// The same for the reference stone alone, and [R]: by mean separation a nailhead comes out best.
///
/// The notes give it 1.63° without saying how the mean is weighted; weighted by power over crown
/// exits it is 1.58°, over all exits upward 1.60°.
#[test]
fn fire_of_the_reference_stone_and_the_nailhead_s_separation() {
    let metrics = ["fire_lit", "fire_streak", "dispersion_mean"];
    let [lit, streak, separation] = scores(&named("reference"), diamond(), metrics, 1 << 16);
    assert_near("lit", lit, 1.59, 0.035 * 1.59);
    assert_near("streak", streak, 1.25, 0.035 * 1.25);
    let [nailhead] = scores(&named("nailhead"), diamond(), ["dispersion_mean"], 1 << 16);
    assert_near("nailhead", nailhead, 1.63, 0.05);
    assert!(nailhead.value > separation.value + 0.3);
}

/// [R] 262,144 quasi-random traces, vertical view, n = 2.417298: reflected .174347, up .74693,
/// up × cos² .58104, down .07872.
#[test]
fn vertical_view_splits_as_the_reference_tracer_says() {
    let stone = stone(&named("reference"));
    let view =
        View::new(&stone, &TraceOptics { material: &Material::from_index(2.417298), polarised: false })
            .expect("lit");
    let mut seen = BatchedEstimate::new(view, SEED);
    seen.extend_to(1 << 18);
    let share = |of: fn(&Tally) -> f64| seen.estimate(|t| of(t) / t[view::RAYS]);
    assert_near("reflected", share(|t| t[view::REFLECTED]), 0.174347, 1e-6);
    assert_near("up", share(view::up), 0.74693, 2e-4);
    assert_near("up cos²", share(|t| t[view::UP_COS2]), 0.58104, 2e-4);
    assert_near("down", share(|t| t[view::BELOW]), 0.07872, 2e-4);
    let all = share(|t| t[view::REFLECTED] + view::up(t) + t[view::BELOW] + t[view::LOST]);
    assert!((all.value - 1.0).abs() < 1e-5, "{all:?}");
}

/// [D] what arrives leaves or is counted, in every cut of the library.
#[test]
fn energy_balances() {
    for name in library::names() {
        let design = library::design(name, &BTreeMap::new()).expect("named").expect("builds");
        for material in [n2417(), Material::from_index(1.54)] {
            let parts = scores(&design, material, ["light_return", "glare", "leakage", "lost"], 1 << 12);
            let sum: f64 = parts.iter().map(|e| e.value).sum();
            assert!((sum - 1.0).abs() < 1e-4, "{name}: {parts:?}");
        }
    }
}

/// [D] without refraction nothing happens: no glare, no return, all light from straight above is
/// seen below.
#[test]
fn an_index_of_one_is_air() {
    let metrics = ["light_return", "glare", "leakage", "aset_leak"];
    let found = scores(&named("reference"), Material::from_index(1.0), metrics, 1 << 12);
    for (e, expected) in found.into_iter().zip([0.0, 0.0, 1.0, 1.0]) {
        assert!((e.value - expected).abs() < 1e-5, "{e:?}");
    }
}
