//! Exact beams: an independent tracer's figures, the sum of all light, photons.

use cutlab::advanced::batch::validate::figures;
use cutlab::advanced::design::{families, library};
use cutlab::advanced::estimators::beam_view;
use cutlab::advanced::estimators::colour_separation;
use cutlab::advanced::estimators::weighted_exits::{BeamEffort, WeightedSums, integrate_exits};
use cutlab::advanced::estimators::{BatchedEstimate, PointLight, TraceOptics, View, point_light, view};
use cutlab::advanced::geometry::{Plane, Polyhedron};
use cutlab::advanced::materials::Material;
use cutlab::advanced::sampling::random::{Purpose, Stream};
use cutlab::advanced::trace::beams::{
    BeamExit, BeamLight, BeamVisitor, Beams, EnergyBudget, IncidentBeam, StopCriteria, UnpolarisedLight,
};
use cutlab::advanced::trace::{ConvexStone, Isa};
use glam::{DMat3, DVec3};
use std::collections::BTreeMap;

/// The only seed of this file.
const SEED: u64 = 1;

/// Index of the reference figures.
const DIAMOND: f64 = 2.417298;

fn brilliant(overrides: &[(&str, f64)]) -> Polyhedron {
    let proportions = [("table", 56.0), ("crown-angle", 34.0), ("pavilion-angle", 40.5)];
    let given = proportions.iter().chain(overrides).map(|(k, v)| (k.to_string(), *v));
    let design = families::build("round-brilliant", &given.collect::<BTreeMap<_, _>>()).expect("builds");
    design.solid().expect("closed")
}

/// Exits added up: up, down, up weighted by cos² from zenith.
#[derive(Default)]
struct Sums([f64; 3]);

impl<L> BeamVisitor<L, 1> for Sums {
    fn exit(&mut self, exit: &BeamExit<L, 1>) {
        let z = exit.direction.z;
        self.0[usize::from(z <= 0.0)] += exit.power;
        self.0[2] += exit.power * z.max(0.0).powi(2);
    }
}

fn follow<L: BeamLight>(
    stone: &ConvexStone,
    direction: DVec3,
    light: L,
    until: StopCriteria,
) -> (EnergyBudget, [f64; 3]) {
    let mut sums = Sums::default();
    let lit = IncidentBeam { direction, indices: [DIAMOND] };
    let totals = Beams::new(stone).trace(&lit, light, until, &mut sums);
    (totals, sums.0)
}

/// The figures of `physics.md` §3: [beams, up, down, up·cos², not followed] down to 1e-5, 1e-6 and
/// 1e-7. The tracer that they are from gave every beam up after 201 facets, which tells at 1e-7
/// alone; followed on, there are 439,441 beams and .001947 is not followed.
#[test]
fn the_figures_of_an_independent_tracer_come_out() {
    let stone = ConvexStone::new(brilliant(&[]));
    assert_eq!(stone.facet_count(), 153);
    for rows in figures::set("beams").chunk_by(|a, b| a.at == b.at) {
        let stop = rows[0].at.expect("the set varies it");
        let until = StopCriteria { facets: 201, ..StopCriteria::at_power(stop) };
        let (t, [up, down, cos2]) = follow(&stone, DVec3::NEG_Z, UnpolarisedLight(1.0), until);
        let ours = [t.beams as f64, up, down, cos2, t.not_followed, t.reflected];
        assert_eq!(rows.len(), ours.len());
        for (f, ours) in rows.iter().zip(ours) {
            assert!((ours - f.expected).abs() <= f.tolerance(), "{f:?}: {ours}");
        }
        assert!((t.sum() - 1.0).abs() < 1e-9, "{}", t.sum());
    }
    let (t, _) = follow(&stone, DVec3::NEG_Z, UnpolarisedLight(1.0), StopCriteria::at_power(1e-7));
    assert_eq!(t.beams, 439_441);
    assert!((t.not_followed - 0.001947).abs() < 0.6e-6, "{}", t.not_followed);
}

/// The limit of the same figures, by 262,144 quasi-random traces; their own error is some 1e-5.
#[test]
fn photons_finish_what_beams_leave_over() {
    let stone = ConvexStone::new(brilliant(&[]));
    let beams = Beams::new(&stone);
    for stop_power in [1e-4, 1e-5, 1e-6] {
        let effort = BeamEffort {
            stop: StopCriteria::at_power(stop_power),
            photons: 32_768,
            seed: SEED,
            ..BeamEffort::default()
        };
        let gaze = beam_view::beam_view(&beams, DVec3::NEG_Z, DIAMOND, false, &effort).expect("lit");
        let ours = [gaze.reflected, gaze.up, gaze.up_cos2, gaze.down];
        for (got, f) in ours.into_iter().zip(figures::set("vertical view")) {
            let limit = f.expected;
            assert!(
                (got.value - limit).abs() < 3.0 * got.error + 2e-5,
                "{got:?} for {limit} at {stop_power}"
            );
            assert!(got.error < gaze.by_photons * 0.01, "{got:?} at {stop_power}");
        }
        assert!(gaze.lost.value < 1e-6, "{:?}", gaze.lost);
        let sum = gaze.reflected.value + gaze.up.value + gaze.down.value + gaze.lost.value;
        assert!((sum - 1.0).abs() < 5e-4 * gaze.by_photons.max(1e-3) / 0.023 + 1e-6, "{sum} at {stop_power}");
    }
}

/// Stones with corners that are hard on the geometry.
fn hard_stones() -> Vec<(String, Polyhedron)> {
    let cut = |name: &str| library::design(name, &BTreeMap::new()).expect("there").expect("good");
    let mut stones: Vec<_> =
        library::names().map(|n| (n.to_string(), cut(n).solid().expect("closed"))).collect();
    for (culet, girdle) in [(0.0, 16.0), (0.0, 448.0), (2.0, 96.0)] {
        let name = format!("brilliant, culet {culet}, girdle {girdle}");
        stones.push((name, brilliant(&[("culet", culet), ("girdle-facets", girdle)])));
    }
    let cube = DVec3::AXES.map(|n| [Plane::new(n, 1.0), Plane::new(-n, 1.0)]).concat();
    stones.push(("cube".into(), Polyhedron::from_planes(&cube).expect("closed")));
    // thirty-two planes through an apex that rounding has moved
    let mut stream = Stream::new(SEED, Purpose::TEST, 99);
    let mut planes = vec![Plane::new(DVec3::Z, 0.2)];
    for i in 0..32 {
        let (s, c) = (std::f64::consts::TAU * f64::from(i) / 32.0).sin_cos();
        let jolt = 1e-11 * (stream.unit64() - 0.5);
        planes.push(Plane::new(DVec3::new(s, c, -0.9), 0.5 + jolt));
        planes.push(Plane::new(DVec3::new(s, c, 1.1), 0.6 + jolt));
    }
    stones.push(("cone".into(), Polyhedron::from_planes(&planes).expect("closed")));
    stones
}

/// A dead edge or a corner torn apart clips light away, and only the sum shows it.
#[test]
fn no_light_is_clipped_away() {
    for (name, solid) in hard_stones() {
        let stone = ConvexStone::new(solid);
        let mut stream = Stream::new(SEED, Purpose::TEST, 0);
        let mut toward = || {
            let (z, phi) = (2.0 * stream.unit64() - 1.0, std::f64::consts::TAU * stream.unit64());
            DVec3::new((1.0 - z * z).sqrt() * phi.cos(), (1.0 - z * z).sqrt() * phi.sin(), z)
        };
        let grazing = |f: usize| {
            let n = stone.planes[f].normal;
            (n.any_orthonormal_vector() - n * 1e-7).normalize()
        };
        let mut directions = vec![DVec3::NEG_Z, DVec3::Z, DVec3::X, DVec3::new(0.6, 0.0, -0.8)];
        directions.extend((0..8).map(|_| toward()));
        directions.extend([0, stone.facet_count() / 2].map(grazing));
        for direction in directions {
            let (t, _) = follow(&stone, direction, UnpolarisedLight(1.0), StopCriteria::at_power(1e-4));
            assert!((t.sum() - 1.0).abs() < 1e-9, "{name} along {direction}: {:e}", t.sum() - 1.0);
        }
    }
}

/// Turning the stone against the light is turning the light against the stone.
#[test]
fn a_turned_stone_in_turned_light_is_the_same() {
    let design = library::design("round-brilliant", &BTreeMap::new()).expect("there").expect("good");
    let turn = DMat3::from_rotation_z(0.3) * DMat3::from_rotation_x(0.4);
    let plain = ConvexStone::new(design.solid().expect("closed"));
    let turned = ConvexStone::new(design.turned(turn).solid().expect("closed"));
    let (a, _) = follow(&turned, DVec3::NEG_Z, UnpolarisedLight(1.0), StopCriteria::at_power(1e-5));
    let (b, _) =
        follow(&plain, turn.transpose() * DVec3::NEG_Z, UnpolarisedLight(1.0), StopCriteria::at_power(1e-5));
    assert!(a.beams.abs_diff(b.beams) <= 2, "{} {}", a.beams, b.beams);
    assert!((a.reflected - b.reflected).abs() < 1e-12 && (a.exited - b.exited).abs() < 2e-5);
}

/// Beams against the view estimator, whose lanes know nothing of polygons: every other cut of the library,
/// nearly face-up or tilted, unpolarised or polarised in turn, so that each of the six cases has a sixth of them
/// (all cuts: `horizon.rs`). Nearly: in a stone of cubic symmetry light that comes straight down leaves along the horizon and along facets, where up or down, and how much passes, is a matter
/// of the last bits of f32 (a tenth of a degree off, the rhombic dodecahedron sends a tenth of its
/// light out within 3e-5 of the horizon, four percent of that on the wrong side of it: up is off by
/// 1 %; tests/library/trace/hard_cases.rs).
/// Of some two hundred comparisons none may be off by more than five errors (of 64 batches, α = .001 for
/// all together); of 25 views .4 are expected off by more than three.
/// Measured once over the first 39 cuts, unpolarised, six seeds a view: 6 of 4164 comparisons and 5 of
/// 702 views were; root mean square 0.898 errors, kurtosis 3.23: no bias, no heavy tail.
#[test]
#[ignore = "half a minute: .ci/run runs it"]
fn beams_agree_with_photons_face_up_or_tilted() {
    let material = Material::by_name("diamond").expect("in the catalogue");
    let (mut compared, mut beyond_three) = (0, 0);
    let tilts = [1.0f64, 10.0, 25.0].into_iter().cycle();
    let polarised = [false, false, false, true, true, true].into_iter().cycle();
    for ((name, tilt), polarised) in library::names().step_by(2).zip(tilts).zip(polarised) {
        let design = library::design(name, &BTreeMap::new()).expect("there").expect("good");
        // about an axis that no symmetry has
        let axis = DMat3::from_rotation_z(0.3) * DVec3::X;
        let turned = design.turned(DMat3::from_axis_angle(axis, tilt.to_radians()));
        let stone = ConvexStone::new(turned.solid().expect("closed"));
        let mut view =
            BatchedEstimate::new(View::new(&stone, &TraceOptics { material, polarised }).expect("lit"), SEED);
        view.extend_to(50_000);
        let effort = BeamEffort { seed: SEED, ..BeamEffort::default() };
        let (beams, index) = (Beams::new(&stone), material.index_d());
        let gaze = beam_view::beam_view(&beams, DVec3::NEG_Z, index, polarised, &effort).expect("lit");
        let mut pairs = vec![
            (view.estimate(|t| t[view::REFLECTED] / t[view::RAYS]), gaze.reflected),
            (view.estimate(|t| view::up(t) / t[view::RAYS]), gaze.up),
            (view.estimate(|t| t[view::UP_COS2] / t[view::RAYS]), gaze.up_cos2),
        ];
        pairs.extend((0..4).map(|b| (view.estimate(|t| t[view::BANDS[b]] / t[view::RAYS]), gaze.bands[b])));
        // photons are given up at 1e-4 of their power, and trace in f32
        let given_up = view.estimate(|t| t[view::LOST] / t[view::RAYS]).value + 1e-6;
        let mut worst = 0.0f64;
        for (i, (photons, beams)) in pairs.into_iter().enumerate() {
            let off = (photons.value - beams.value).abs() - given_up;
            let error = photons.error.hypot(beams.error);
            assert!(off <= 5.0 * error, "{name} at {tilt}°, {i}: {photons:?} {beams:?}");
            worst = worst.max(off / error.max(f64::MIN_POSITIVE));
        }
        // the shares of one view add up to 1: it counts once
        beyond_three += i32::from(worst > 3.0);
        compared += 1;
    }
    println!("{beyond_three} of {compared} views are off by more than three errors somewhere");
    let expected = f64::from(compared) * 0.0155;
    assert!(f64::from(beyond_three) <= expected + 4.0 * expected.sqrt(), "{beyond_three} of {compared}");
}

/// [R] With polarisation, what a vertical view of the reference sends up changes by .0007; photons
/// finish both kinds of light, so that the difference is of the whole.
#[test]
fn polarisation_changes_the_light_that_returns_by_as_much_as_is_known() {
    let stone = ConvexStone::new(brilliant(&[]));
    let beams = Beams::new(&stone);
    let effort = BeamEffort {
        stop: StopCriteria::at_power(1e-6),
        photons: 32_768,
        seed: SEED,
        ..BeamEffort::default()
    };
    let gaze =
        |polarised| beam_view::beam_view(&beams, DVec3::NEG_Z, DIAMOND, polarised, &effort).expect("lit");
    let (with, without) = (gaze(true), gaze(false));
    let change = with.up.value - without.up.value;
    println!("{change:+.6} ± {:.1e}", with.up.error.hypot(without.up.error));
    assert!((change.abs() - 0.0007).abs() < 0.0001 + 3.0 * with.up.error.hypot(without.up.error), "{change}");
    assert!((with.reflected.value - without.reflected.value).abs() < 1e-12);
    let sum = with.reflected.value + with.up.value + with.down.value + with.lost.value;
    assert!((sum - 1.0).abs() < 2e-4, "{sum}");
}

/// A Stokes vector's beams add up to 1 as numbers do, and every instruction set follows the same.
#[test]
fn all_instruction_sets_follow_the_same_beams() {
    let direction = DVec3::new(0.5, 0.2, -0.8).normalize();
    let stokes =
        cutlab::advanced::optics::stokes::Stokes::unpolarised(1.0, direction.any_orthonormal_vector());
    let until = StopCriteria::at_power(1e-5);
    let runs = Isa::all().into_iter().map(|isa| {
        let stone = ConvexStone::with_isa(brilliant(&[]), isa);
        [follow(&stone, direction, UnpolarisedLight(1.0), until), follow(&stone, direction, stokes, until)]
    });
    let runs: Vec<_> = runs.collect();
    for [scalar, polarised] in &runs {
        for ((t, sums), (portable, portable_sums)) in [scalar, polarised].into_iter().zip(&runs[0]) {
            assert!((t.sum() - 1.0).abs() < 1e-9, "{}", t.sum());
            assert!(t.beams.abs_diff(portable.beams) <= 2, "{} {}", t.beams, portable.beams);
            // a beam at the threshold may be followed here and not there
            for (got, expected) in sums.iter().zip(portable_sums) {
                assert!((got - expected).abs() < 3e-5, "{got} {expected}");
            }
        }
    }
}

/// What is left is the target, from any direction; the strongest first takes hardly more beams than
/// the power threshold that leaves as much.
#[test]
fn beams_stop_when_little_enough_is_left() {
    let stone = ConvexStone::new(brilliant(&[]));
    for direction in [DVec3::NEG_Z, DVec3::new(0.3, 0.1, -0.9).normalize()] {
        let (t, _) = follow(&stone, direction, UnpolarisedLight(1.0), StopCriteria::at_residual(0.04));
        assert!(t.not_followed <= 0.04 && t.not_followed > 0.0395, "{}", t.not_followed);
        assert!((t.sum() - 1.0).abs() < 1e-9);
        let least = (1..400).map(|i| 1e-4 * 0.98f64.powi(i)).find_map(|stop| {
            let (by_power, _) =
                follow(&stone, direction, UnpolarisedLight(1.0), StopCriteria::at_power(stop));
            (by_power.not_followed <= 0.04).then_some(by_power.beams)
        });
        let least = least.expect("some power") as f64;
        assert!((t.beams as f64) < 1.25 * least, "{} {least}", t.beams);
    }
}

/// Any weights: elevation bands as the gaze has them, reflection at entry, all light once.
#[test]
fn weights_of_a_caller_add_up_to_what_the_gaze_has() {
    let stone = ConvexStone::new(brilliant(&[]));
    let beams = Beams::new(&stone);
    let direction = DVec3::new(0.2, 0.1, -0.9).normalize();
    let effort = BeamEffort { seed: SEED, ..BeamEffort::default() };
    let lit = IncidentBeam { direction, indices: [DIAMOND] };
    let gaze = beam_view::beam_view(&beams, direction, DIAMOND, true, &effort).expect("lit");
    let limits = beam_view::between([-90.0, 0.0, 45.0, 75.0]);
    let bands = integrate_exits(&beams, &lit, true, &effort, &limits).expect("lit");
    for (i, band) in [gaze.bands[3], gaze.bands[0], gaze.bands[1], gaze.bands[2]].iter().enumerate() {
        assert!((bands.sum(i).value - band.value).abs() < 1e-12, "{i}");
    }
    assert!((bands.glare.iter().sum::<f64>() - bands.reflected).abs() < 1e-12);
    // light from straight above that the table mirrors goes straight up
    let flat = IncidentBeam { direction: DVec3::NEG_Z, indices: [DIAMOND] };
    let up: WeightedSums<1> =
        integrate_exits(&beams, &flat, false, &effort, |l| [f64::from(l.up > 1.0 - 1e-12)]).expect("lit");
    let table = beams.facets().planes.iter().position(|p| p.normal.z > 0.999).expect("a table");
    let share = beams.facets().area(table)
        / follow(&stone, DVec3::NEG_Z, UnpolarisedLight(1.0), StopCriteria::at_power(1.0)).0.outline;
    let reflectance = ((DIAMOND - 1.0) / (DIAMOND + 1.0)).powi(2);
    assert!((up.glare[0] - share * reflectance).abs() < 1e-12, "{:?}", up.glare);
}

/// ASET areas by the strongest path (`physics.md` §4, ±.5 %).
#[test]
fn areas_of_the_strongest_path_are_those_of_the_reference() {
    let stone = ConvexStone::new(brilliant(&[]));
    let shares = beam_view::strongest(&Beams::new(&stone), DVec3::NEG_Z, DIAMOND, false, 1e-7).expect("lit");
    for (got, expected) in shares.bands.iter().zip([0.060, 0.667, 0.228, 0.045]) {
        assert!((got - expected).abs() < 0.005, "{shares:?}");
    }
    assert!((shares.bands.iter().sum::<f64>() + shares.dark - 1.0).abs() < 1e-9, "{shares:?}");
    assert!(shares.undecided < 1e-3, "{shares:?}");
}

/// The mean angle between B and G against the beam estimator's photons, whose lanes are compared
/// facet by facet.
#[test]
fn the_separation_of_colours_agrees_with_photons() {
    for (material, overrides) in [
        ("diamond", &[][..]),
        ("diamond", &[("pavilion-angle", 43.0)]),
        ("moissanite", &[("girdle-facets", 16.0)]),
    ] {
        let material = Material::by_name(material).expect("in the catalogue");
        let stone = ConvexStone::new(brilliant(overrides));
        let medium = TraceOptics { material, polarised: false };
        let mut photons = BatchedEstimate::new(PointLight::new(&stone, &medium).expect("lit"), SEED);
        photons.extend_to(100_000);
        let photons = photons.estimate(|t| t[point_light::POWER_ANGLE_DEG] / t[point_light::PAIRED_POWER]);
        for stop_power in [1e-4, 1e-5] {
            let effort =
                BeamEffort { stop: StopCriteria::at_power(stop_power), seed: SEED, ..BeamEffort::default() };
            let beams =
                colour_separation::colour_separation(&Beams::new(&stone), DVec3::NEG_Z, &medium, &effort)
                    .expect("lit")
                    .angle_deg;
            let off = (photons.value - beams.value).abs();
            assert!(off < 3.5 * photons.error.hypot(beams.error), "{photons:?} {beams:?}");
            println!("{}: {photons:?} {beams:?}", material.name);
        }
    }
}
