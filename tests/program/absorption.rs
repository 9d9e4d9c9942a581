//! Absorption along the tracer: energy, the `f64` twin, a plate's closed form, and what size does.

use cutlab::advanced::design::Design;
use cutlab::advanced::estimators::{BatchedEstimate, TraceOptics, View, view};
use cutlab::advanced::geometry::{Plane, Polyhedron};
use cutlab::advanced::integrators::{self, PhotonMaps, Tone};
use cutlab::advanced::materials::Material;
use cutlab::advanced::metrics::METRICS;
use cutlab::advanced::optics::absorption::{Absorption, Band};
use cutlab::advanced::optics::dispersion::lines;
use cutlab::advanced::optics::fresnel::unpolarised;
use cutlab::advanced::optics::stokes::Stokes;
use cutlab::advanced::photons::stone_scattering::{IncidentPhoton, scatter};
use cutlab::advanced::photons::{self, PhotonSets};
use cutlab::advanced::sampling::random::{Purpose, Stream};
use cutlab::advanced::sampling::tally::Tally;
use cutlab::advanced::sampling::warps;
use cutlab::advanced::scene::intersection::StoneHit;
use cutlab::advanced::scene::{PlacedStone, Pose, Scene, SceneOverrides, preset};
use cutlab::advanced::scoring::score::{ScoreInput, ScoreRequest, score};
use cutlab::advanced::trace::{ConvexStone, Isa, LANES, Packet, reference};
use glam::{DMat3, DVec3, Vec3};
use std::collections::BTreeMap;

const SEED: u64 = 29;
const INDEX: f32 = 1.77;

fn brilliant() -> Polyhedron {
    let design =
        cutlab::advanced::design::families::build("round-brilliant", &BTreeMap::new()).expect("builds");
    design.solid().expect("closed")
}

/// A packet of vertical rays on the crown, every lane of another absorption, none in lane 0; and
/// what each reflects.
fn rain(stone: &ConvexStone, stream: &mut Stream, polarised: bool) -> (Packet, [f32; LANES]) {
    let mut packet = Packet { absorbing: true, ..Packet::new(polarised) };
    let mut reflected = [0.0; LANES];
    for (lane, reflected) in reflected.iter_mut().enumerate() {
        let target = (warps::uniform_disc(stream.pair()) * 0.9).extend(2.0);
        let hit = stone.intersect(target, Vec3::NEG_Z).expect("over the stone");
        let entry = stone.refract_into(hit.facet, Vec3::NEG_Z, INDEX);
        packet.load_refracted(lane, target - Vec3::Z * hit.distance, &entry, INDEX);
        packet.absorption[lane] = 0.3 * lane as f32;
        *reflected = entry.reflectance;
    }
    (packet, reflected)
}

/// [D] Reflected + left + absorbed + lost = 1, lane by lane.
#[test]
fn what_enters_leaves_or_is_absorbed_or_counted_as_lost() {
    for isa in Isa::all() {
        let stone = ConvexStone::with_isa(brilliant(), isa);
        let mut stream = Stream::new(SEED, Purpose::TEST, 0);
        for polarised in [false, true] {
            for _ in 0..40 {
                let (mut packet, reflected) = rain(&stone, &mut stream, polarised);
                let (mut sums, mut absorbed) = (reflected.map(f64::from), [0f64; LANES]);
                let lost = stone.trace(&mut packet, 1e-7, |m, _| {
                    for l in 0..LANES {
                        sums[l] += f64::from(m.power[l]) + f64::from(m.absorbed[l]);
                        absorbed[l] += f64::from(m.absorbed[l]);
                    }
                });
                assert!(lost < 1e-5);
                for (lane, sum) in sums.iter().enumerate() {
                    assert!((sum - 1.0).abs() < 1e-5, "{} lane {lane}: {sum}", isa.name());
                }
                assert!(absorbed[0] == 0.0 && absorbed[LANES - 1] > 0.3, "{absorbed:?}");
            }
        }
    }
}

/// Lanes and twin absorb the same and let the same out until a rounding parts them, and the twin
/// keeps energy to twelve digits.
#[test]
fn lanes_absorb_as_their_twin_does() {
    for isa in Isa::all() {
        let stone = ConvexStone::with_isa(brilliant(), isa);
        let planes = stone.kernel_planes();
        let mut stream = Stream::new(SEED, Purpose::TEST, 1);
        let mut compared = 0;
        for _ in 0..20 {
            let (mut packet, _) = rain(&stone, &mut stream, true);
            let start = packet.clone();
            let mut lanes: Vec<Vec<(usize, f64, f64)>> = vec![Vec::new(); LANES];
            stone.trace(&mut packet, 1e-9, |m, _| {
                (0..LANES).for_each(|l| {
                    lanes[l].push((m.facet[l] as usize, m.power[l].into(), m.absorbed[l].into()))
                });
            });
            for (lane, seen) in lanes.iter().enumerate() {
                let axis = Vec3::new(start.ax[lane], start.ay[lane], start.az[lane]).as_dvec3();
                let power = f64::from(start.power[lane]);
                let ray = reference::ScalarRay {
                    point: start.point(lane).as_dvec3(),
                    direction: start.direction(lane).as_dvec3().normalize(),
                    power,
                    index: INDEX.into(),
                    absorption: start.absorption[lane].into(),
                    stokes: Some(Stokes { q: start.q[lane].into(), ..Stokes::unpolarised(power, axis) }),
                };
                let (mut sum, mut together, mut tolerance) = (0.0, true, 2e-5);
                let mut bounces = seen.iter();
                sum += reference::trace(&planes, ray, 1e-14, |m| {
                    sum += m.power + m.absorbed;
                    let Some((facet, left, absorbed)) = bounces.next().filter(|_| together) else { return };
                    together = *facet == m.facet;
                    if together {
                        compared += 1;
                        // beside the critical angle a rounding of 1e-7 shows
                        tolerance += if m.cos_outside > 0.0 { 1e-6 / m.cos_outside.max(1e-3) } else { 0.0 };
                        assert!((left - m.power).abs() < tolerance, "{}: {left} {}", isa.name(), m.power);
                        assert!((absorbed - m.absorbed).abs() < tolerance, "{absorbed} {}", m.absorbed);
                    }
                });
                assert!((sum - power).abs() < 1e-12, "{sum} of {power}");
            }
        }
        assert!(compared > 2000, "{compared}");
    }
}

/// A cube.
fn cube(side: f64) -> Polyhedron {
    let planes = DVec3::AXES.map(|n| [Plane::new(n, side / 2.0), Plane::new(-n, side / 2.0)]).concat();
    Polyhedron::from_planes(&planes).expect("closed")
}

/// A material that absorbs `per_mm` at the D line.
fn grey(per_mm: f64) -> Material {
    let band = Band {
        name: "grey".into(),
        centre_nm: lines::D,
        half_widths_per_cm: (1e9, 1e9),
        peak_per_mm: per_mm,
    };
    let absorption = Absorption::from_bands([band], "a test's", "given");
    Material::from_index(INDEX.into()).with_absorption(absorption)
}

/// [D] A plate looked at straight: with R at each face and x = exp(−aL) of one crossing,
/// (1−R)² x / (1−R²x²) goes through and (1−R)² R x² / (1−R²x²) comes back.
#[test]
fn a_plate_follows_its_closed_form() {
    let side = 3.0;
    let stone = ConvexStone::new(cube(side));
    for per_mm in [0.01, 0.2, 1.0] {
        let material = grey(per_mm);
        let view = View::new(&stone, &TraceOptics { material: &material, polarised: true }).expect("lit");
        let mut traced = BatchedEstimate::new(view, SEED);
        traced.extend_to(64);
        let r = unpolarised(1.0, INDEX.into()).0;
        let x = (-per_mm * side).exp();
        let through = (1.0 - r).powi(2) * x / (1.0 - r * r * x * x);
        let back = through * r * x;
        let share = |of: fn(&Tally) -> f64| traced.estimate(|t| of(t) / t[view::RAYS]).value;
        assert!((share(|t| t[view::BELOW]) - through).abs() < 2e-4, "{per_mm}: {through}");
        assert!((share(view::up) - back).abs() < 2e-4, "{per_mm}: {back}");
        assert!((share(|t| t[view::ABSORBED]) - (1.0 - r - through - back)).abs() < 2e-4, "{per_mm}");
    }
}

#[test]
fn scores_of_a_coloured_stone_add_up_and_depend_on_its_size() {
    let scores = |material: &str, mm: f64| -> BTreeMap<&str, f64> {
        let solid =
            cutlab::advanced::design::families::build("round-brilliant", &BTreeMap::new()).expect("builds");
        let material = Material::by_name(material).expect("in the catalogue").clone();
        let subject = ScoreInput {
            stone: "s".into(),
            material,
            shape: Ok(solid.sized(mm).and_then(|d| d.solid()).expect("closed").into()),
            tilt: None,
        };
        let plan = ScoreRequest::default().samples(1 << 14).seed(SEED);
        let row = score(&subject, &plan);
        assert_eq!(row.error, None);
        METRICS.iter().zip(row.scores).filter_map(|(m, s)| Some((m.name, s?.value))).collect()
    };
    let sum = |s: &BTreeMap<&str, f64>| {
        ["light_return", "glare", "leakage", "absorbed", "lost"].iter().map(|name| s[name]).sum::<f64>()
    };
    let (small, large) = (scores("ruby", 2.0), scores("ruby", 10.0));
    for s in [&small, &large] {
        assert!((sum(s) - 1.0).abs() < 1e-5, "{}", sum(s));
    }
    assert!(large["absorbed"] > small["absorbed"] + 0.05, "{small:?} {large:?}");
    assert!(large["light_return"] < small["light_return"]);
    let (clear, same) = (scores("corundum", 2.0), scores("corundum", 10.0));
    assert_eq!(clear["absorbed"], 0.0);
    assert!((clear["light_return"] - same["light_return"]).abs() < 1e-4, "a clear stone has no size");
}

/// A scene with a stone of the given material, upright on the table.
fn scene(design: Design, material: Material) -> Scene {
    let cast = SceneOverrides {
        designs: vec![design],
        material: Some(material),
        pose: Some(Pose::TableUp),
        ..SceneOverrides::default()
    };
    preset("table").expect("in the catalogue").expect("is sound").build(&cast, 1.0).expect("is set up")
}

/// [D] The plate's closed form again, with photons that each leave by one way.
#[test]
fn photons_through_a_plate_keep_what_it_does_not_absorb() {
    let (side, per_mm) = (3.0, 0.2);
    let stone = ConvexStone::new(cube(side));
    let radius = stone.unit as f32;
    let placed = PlacedStone::resting_on(stone, grey(per_mm), DMat3::IDENTITY, radius, Vec3::ZERO);
    let mut stream = Stream::new(SEED, Purpose::TEST, 2);
    let top = placed.stone.intersect(Vec3::Z * 2.0, Vec3::NEG_Z).expect("above it");
    let arrival =
        StoneHit { facet: top.facet, point: Vec3::Z * (2.0 - top.distance), direction: Vec3::NEG_Z };
    let entering: Vec<IncidentPhoton> =
        (0..20_000).map(|_| IncidentPhoton { hit: arrival, nm: 589.0, choice: stream.unit64() }).collect();
    let departures = scatter(&placed, u32::MAX, &entering);
    let r = unpolarised(1.0, INDEX.into()).0;
    let x = (-per_mm * side).exp();
    let through = (1.0 - r).powi(2) * x / (1.0 - r * r * x * x);
    let all = r + through * (1.0 + r * x);
    // 1e-3 of the power is where a photon is given up
    assert!(departures.iter().all(|d| (f64::from(d.share) - all).abs() < 1.1e-3), "{all}");
    let down = departures.iter().filter(|d| d.direction.z < 0.0).count() as f64 / 20_000.0;
    let sigma = (through / all * (1.0 - through / all) / 20_000.0).sqrt();
    assert!((down - through / all).abs() < 4.0 * sigma + 1e-3, "{down} {}", through / all);
}

/// Pictures: a ruby is red, an emerald green, and a larger ruby deeper.
#[test]
fn pictures_show_the_colour_and_the_size() {
    let mean = |material: &str, mm: f64| -> Vec3 {
        let design =
            cutlab::advanced::design::families::build("round-brilliant", &BTreeMap::new()).expect("builds");
        let scene = scene(
            design.sized(mm).expect("has a width"),
            Material::by_name(material).expect("in the catalogue").clone(),
        );
        let shots =
            PhotonSets::emit(&scene, &photons::PhotonSettings { photons: 2000, nearest: 50, seed: SEED });
        let maps = PhotonMaps::new(&scene, shots, 50);
        let settings = integrators::RenderSettings {
            width: 48,
            height: 48,
            samples_per_pixel: 16,
            round: 0,
            tone: Tone::default(),
            seed: SEED,
        };
        let film = integrators::render(&scene, &scene.camera, &maps, &settings, &|| ());
        // the middle of the picture, which the stone fills
        let middle = (18..30).flat_map(|y| (18..30).map(move |x| y * 48 + x));
        let light = film.linear(None);
        middle.map(|i| light[i].min(Vec3::ONE)).sum::<Vec3>() / 144.0
    };
    let (small, large) = (mean("ruby", 2.0), mean("ruby", 8.0));
    assert!(small.x > 1.3 * small.y && large.x > 1.5 * large.y.max(large.z), "{small} {large}");
    assert!(large.y < small.y && large.z < small.z && large.x < small.x, "{small} {large}");
    let emerald = mean("emerald", 6.0);
    assert!(emerald.y > 1.3 * emerald.x.max(emerald.z), "{emerald}");
    let clear = mean("corundum", 6.0);
    assert!((clear.max_element() - clear.min_element()) < 0.1 * clear.max_element(), "{clear}");
}

/// Standard output and standard error of the program.
fn cutlab(arguments: &str) -> (String, String) {
    let out = std::process::Command::new(env!("CARGO_BIN_EXE_cutlab"))
        .args(arguments.split(' '))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("the program starts");
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    let (said, noted) = (text(out.stdout), text(out.stderr));
    assert!(out.status.success(), "{arguments}: {noted}");
    (said, noted)
}

#[test]
fn the_program_says_what_size_it_took_for_a_coloured_stone_without_one() {
    let stone = "score tests/data/good/square.asc --metrics absorbed --error 0.05 --material";
    let (said, noted) = cutlab(&format!("{stone} ruby"));
    assert!(noted.contains("taken as 6.5 mm wide") && noted.lines().count() == 1, "{noted}");
    let (same, quiet) = cutlab(&format!("{stone} ruby --size 6.5"));
    assert_eq!((said, quiet.as_str()), (same, ""));
    let (clear, quiet) = cutlab(&format!("{stone} corundum"));
    assert!(clear.contains(",0.0,0.0,") && quiet.is_empty(), "{clear} {quiet}");
}

#[test]
fn the_program_notes_once_that_an_index_is_a_guess() {
    let score = |metric| {
        cutlab(&format!("score tolkowsky cube --material moissanite --metrics {metric} --error 1")).1
    };
    assert_eq!(score("fire_lit"), "note: index of moissanite extrapolated below 436 nm\n");
    assert_eq!(score("wlr"), "");
}
