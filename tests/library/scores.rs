//! Scores against published figures [P], figures that follow from the definitions [D], and figures
//! of an independent reference tracer [R].
//!
//! [R] and [P] figures are those of the project's physics notes, §3 and §4. An expectation is met
//! within its own tolerance plus 3.3 standard errors of ours (α = 0.001).

use crate::brilliants::{SEED, design, diamond, n2417, named, scores, stone};
use cutlab::advanced::batch::validate::figures::{self, ReferenceFigure};
use cutlab::advanced::design::library;
use cutlab::advanced::estimators::{BatchedEstimate, Hemisphere, TraceOptics, View, hemisphere, view};
use cutlab::advanced::materials::Material;
use cutlab::advanced::sampling::stats::Estimate;
use cutlab::advanced::sampling::tally::Tally;
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

/// [R] two independent tracers gave .2840 and .2832 ± .0001 for the reference stone.
#[test]
fn wlr_of_the_reference_stones() {
    for f in figures::set("light return") {
        let [wlr] = scores(&named(&f.of), n2417(), ["wlr"], 1 << 18);
        assert!(wlr.error < 0.001, "the default effort promises ±.001: {wlr:?}");
        assert_near(&f.of, wlr, f.expected, 0.001);
    }
}

/// [R] by the flux through the girdle disc, and counting rejected directions.
#[test]
fn wlr_by_other_normalisations() {
    let stone = stone(&named("reference"));
    let mut dome = BatchedEstimate::new(
        Hemisphere::new(&stone, &TraceOptics { material: &n2417(), polarised: false }).expect("lit"),
        SEED,
    );
    dome.extend_to(1 << 18);
    let drawn = dome.estimate(|t| t[hemisphere::RETURNED_COS2] / t[hemisphere::DRAWN]);
    let areas = dome.estimator().crown_area / dome.estimator().outline_area;
    let disc = Estimate { value: drawn.value * areas, error: drawn.error * areas };
    let expected = figures::set("normalisation");
    assert_eq!(expected.len(), 2);
    for (f, ours) in expected.into_iter().zip([drawn, disc]) {
        assert_near(&f.quantity, ours, f.expected, f.tolerance());
    }
}

/// [R] by crown angle and by table. The list's own scatter is larger than .001: it has .2838 for the
/// stone that is .2832 above, and at crowns 20 and 45 and table 60 a plain Monte Carlo in `f64` gave
/// .2989, .2206 and .2800 (± .0003), as the lanes do. Hence ± .002.
#[test]
#[ignore = "seventeen stones, half a minute in release"]
fn wlr_by_crown_angle_and_table() {
    for (set, key) in [("crown angle", "crown-angle"), ("table", "table")] {
        for f in figures::set(set) {
            let value = f.at.expect("the set varies it");
            let [wlr] = scores(&design(&[(key, value)]), n2417(), ["wlr"], 1 << 19);
            assert_near(&format!("{key} {value}"), wlr, f.expected, 0.002);
        }
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
    use cutlab::advanced::optics::fresnel;
    use cutlab::advanced::sampling::{random::*, warps};
    use cutlab::advanced::trace::reference;
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

/// [R] ± .5 points: share of the face-up area, by energy, and the map of the strongest path of each point.
#[test]
fn shares_of_the_viewer_s_bands() {
    for set in ["viewer bands", "strongest path"] {
        for f in figures::set(set) {
            let [share] = scores(&named(&f.of), n2417(), [f.quantity.as_str()], 1 << 17);
            assert_near(
                &format!("{} {}", f.of, f.quantity),
                share,
                f.expected / 100.0,
                f.tolerance() / 100.0,
            );
        }
    }
}

/// [P] PriceScope, DiamCalc: crown 35, table 56, lower halves 80: leakage jumps between pavilion
/// 41.15 and 41.25; [R] by how much.
#[test]
fn leakage_jumps_between_two_pavilion_angles() {
    let leakage = |pavilion| {
        let proportions = [("crown-angle", 35.0), ("lower-half", 80.0), ("pavilion-angle", pavilion)];
        scores(&design(&proportions), n2417(), ["leakage_strongest"], 1 << 17)[0]
    };
    for f in figures::set("pavilion angle") {
        let pavilion = f.at.expect("the set varies it");
        assert_near(&pavilion.to_string(), leakage(pavilion), f.expected, f.tolerance());
    }
}

/// [R] ± 3.5 %, threshold 10⁻³: (lit, streak).
#[test]
#[ignore = "six stones in six lines, eight seconds in release"]
fn fire() {
    figures::set("fire").into_iter().for_each(|f| fire_of(f, 1 << 18));
}

fn fire_of(f: &ReferenceFigure, samples: u64) {
    let [ours] = scores(&named(&f.of), diamond(), [f.quantity.as_str()], samples);
    assert_near(&format!("{} {}", f.of, f.quantity), ours, f.expected, f.tolerance());
}

/// The same for the reference stone alone, and [R]: by mean separation a nailhead comes out best.
#[test]
fn fire_of_the_reference_stone_and_the_nailhead_s_separation() {
    figures::set_of("fire", "reference").into_iter().for_each(|f| fire_of(f, 1 << 16));
    let [separation] = scores(&named("reference"), diamond(), ["dispersion_mean"], 1 << 16);
    let [nailhead] = scores(&named("nailhead"), diamond(), ["dispersion_mean"], 1 << 16);
    let expected = figures::set_of("separation", "nailhead");
    assert_eq!(expected.len(), 1);
    assert_near("nailhead", nailhead, expected[0].expected, expected[0].tolerance());
    assert!(nailhead.value > separation.value + 0.3);
}

/// [R] 262,144 quasi-random traces, vertical view, n = 2.417298.
#[test]
fn vertical_view_splits_as_the_reference_tracer_says() {
    let stone = stone(&named("reference"));
    let view =
        View::new(&stone, &TraceOptics { material: &Material::from_index(2.417298), polarised: false })
            .expect("lit");
    let mut seen = BatchedEstimate::new(view, SEED);
    seen.extend_to(1 << 18);
    let share = |of: fn(&Tally) -> f64| seen.estimate(|t| of(t) / t[view::RAYS]);
    let ours = [
        share(|t| t[view::REFLECTED]),
        share(view::up),
        share(|t| t[view::UP_COS2]),
        share(|t| t[view::BELOW]),
    ];
    let expected = figures::set("vertical view");
    assert_eq!(expected.len(), ours.len());
    for ((f, ours), tolerance) in expected.into_iter().zip(ours).zip([1e-6, 2e-4, 2e-4, 2e-4]) {
        assert_near(&f.quantity, ours, f.expected, tolerance);
    }
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
