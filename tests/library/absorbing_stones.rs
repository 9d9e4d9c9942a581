//! Dark and coloured stones: scores by luminance in daylight, against exhaustive traces in f64.

use crate::brilliants;
use crate::brilliants::{SEED, subject};
use cutlab::advanced::color::{Illuminant, cie};
use cutlab::advanced::design::library;
use cutlab::advanced::materials::Material;
use cutlab::advanced::metrics::Metric;
use cutlab::advanced::optics::absorption::{Absorption, Band};
use cutlab::advanced::optics::dispersion::Dispersion;
use cutlab::advanced::optics::fresnel::FresnelCoefficients;
use cutlab::advanced::sampling::random::{Purpose, Stream};
use cutlab::advanced::sampling::stats::{Estimate, ratio};
use cutlab::advanced::scoring::score::{ScoreRequest, Target, score};
use cutlab::advanced::trace::ConvexStone;
use cutlab::advanced::trace::reference::{ScalarInteraction, ScalarRay, trace};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

const NAMES: [&str; 3] = ["light_return", "wlr", "aset_red"];

/// A power far below anything that counts.
const NOTHING: f64 = 1e-14;

fn ruby() -> Material {
    Material::by_name("ruby").expect("in the catalogue").clone()
}

/// Grey glass: a millimetre lets 55 % pass.
fn smoke() -> Material {
    let band =
        Band { name: "all".into(), centre_nm: 555.0, half_widths_per_cm: (1e9, 1e9), peak_per_mm: 0.6 };
    let glass = ruby().with_name("smoke").with_dispersion(Dispersion::Constant(1.77));
    glass.with_absorption(Absorption::from_bands([band], "grey", "this test"))
}

fn stone(name: &str, mm: f64) -> ConvexStone {
    let design = library::design(name, &Default::default()).expect("in the library").expect("solved");
    ConvexStone::new(design.sized(mm).expect("solid").solid().expect("solid"))
}

/// What the tracer of the scores does, written out in f64 with scalar Fresnel, to the last photon.
struct Exhaustive<'a> {
    stone: &'a ConvexStone,
    material: &'a Material,
    crown: Vec<(usize, [DVec3; 3])>,
    upto: Vec<f64>,
}

impl<'a> Exhaustive<'a> {
    fn new(stone: &'a ConvexStone, material: &'a Material) -> Self {
        let mut crown = Vec::new();
        for facet in (0..stone.planes.len()).filter(|f| stone.planes[*f].normal.z > 1e-6) {
            let corners: Vec<DVec3> =
                stone.solid.polygon(facet).map(|v| stone.point_from_design(v)).collect();
            crown.extend((1..corners.len() - 1).map(|i| (facet, [corners[0], corners[i], corners[i + 1]])));
        }
        let area = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).length();
        let upto = crown.iter().scan(0.0, |sum, (_, t)| {
            *sum += area(*t);
            Some(*sum)
        });
        Exhaustive { upto: upto.collect(), stone, material, crown }
    }

    /// A wavelength (nm) and its weight: daylight's luminance per nm.
    fn hue(stream: &mut Stream) -> (f64, f64) {
        let nm = 380.0 + 350.0 * stream.unit64();
        let daylight = Illuminant::daylight().power(nm as f32);
        (nm, f64::from(cie::matching(nm as f32).y) * f64::from(daylight))
    }

    /// Lets light of power 1 into a facet and follows it; nothing is seen of what is mirrored.
    fn follow(
        &self,
        facet: usize,
        point: DVec3,
        direction: DVec3,
        nm: f64,
        visit: impl FnMut(&ScalarInteraction),
    ) {
        let (n, normal) = (self.material.index(nm), self.stone.planes[facet].normal);
        let cos = -direction.dot(normal);
        let facing = FresnelCoefficients::new(cos, n);
        let ray = ScalarRay {
            point,
            direction: (direction / n + normal * (cos / n - facing.cos_t)).normalize(),
            power: 1.0 - facing.unpolarised_reflectance(),
            index: n,
            absorption: self.material.absorption_per_mm(nm) * self.stone.unit,
            stokes: None,
        };
        trace(&self.stone.planes, ray, NOTHING, visit);
    }

    /// Light return and its weighted form from one direction of the dome: sums and weight.
    fn dome(&self, stream: &mut Stream) -> ([f64; 2], f64) {
        let at = stream.unit64() * self.upto.last().expect("a crown");
        let (facet, [a, b, c]) =
            self.crown[self.upto.partition_point(|s| *s <= at).min(self.crown.len() - 1)];
        let (root, along) = (stream.unit64().sqrt(), stream.unit64());
        let point = a + (b - a) * (root * (1.0 - along)) + (c - a) * (root * along);
        let normal = self.stone.planes[facet].normal;
        let u = normal.any_orthonormal_vector();
        let (r, turn) = (stream.unit64().sqrt(), std::f64::consts::TAU * stream.unit64());
        let sky = u * (r * turn.cos()) + normal.cross(u) * (r * turn.sin()) + normal * (1.0 - r * r).sqrt();
        let (nm, weight) = Self::hue(stream);
        if sky.z <= 0.0 {
            return ([0.0; 2], 0.0);
        }
        let mut sums = [0.0; 2];
        self.follow(facet, point, -sky, nm, |m| {
            if m.direction.z > 1e-5 && self.stone.planes[m.facet].normal.z > 1e-6 {
                sums[0] += weight * m.power;
                sums[1] += weight * m.power * m.direction.z.powi(2);
            }
        });
        (sums, weight)
    }

    /// What a line of sight sees from 45 to 75° above the horizon: sum and weight.
    fn view(&self, stream: &mut Stream) -> (f64, f64) {
        let xy = DVec2::new(stream.unit64(), stream.unit64()) * 2.0 - 1.0;
        let (nm, weight) = Self::hue(stream);
        let (mut from, mut to) = ((usize::MAX, f64::INFINITY), f64::NEG_INFINITY);
        for (i, plane) in self.stone.planes.iter().enumerate() {
            let (slope, rest) = (plane.normal.z, plane.distance - plane.normal.truncate().dot(xy));
            match slope {
                z if z > 1e-9 && rest / z < from.1 => from = (i, rest / z),
                z if z < -1e-9 => to = to.max(rest / z),
                z if z.abs() <= 1e-9 && rest < 0.0 => return (0.0, 0.0),
                _ => (),
            }
        }
        if from.1 <= to {
            return (0.0, 0.0);
        }
        let mut sum = 0.0;
        self.follow(from.0, xy.extend(from.1), DVec3::NEG_Z, nm, |m| {
            let red = 45f64.to_radians().sin()..75f64.to_radians().sin();
            sum += if red.contains(&m.direction.z) { weight * m.power } else { 0.0 };
        });
        (sum, weight)
    }

    /// The scores of [`NAMES`].
    fn scores(&self, rays: u64) -> [Estimate; 3] {
        const BATCHES: u64 = 64;
        let batch = |b| {
            let mut stream = Stream::new(SEED, Purpose::TEST, b);
            let mut sums = [(0.0, 0.0); 3];
            for _ in 0..rays / BATCHES {
                let ([all, weighted], weight) = self.dome(&mut stream);
                let (red, seen) = self.view(&mut stream);
                for (sum, (x, w)) in sums.iter_mut().zip([(all, weight), (weighted, weight), (red, seen)]) {
                    sum.0 += x;
                    sum.1 += w;
                }
            }
            sums
        };
        let batches: Vec<_> = (0..BATCHES).into_par_iter().map(batch).collect();
        std::array::from_fn(|k| ratio(batches.iter().map(|sums| sums[k])))
    }
}

/// The scores of [`NAMES`] as the program gives them.
fn scored(name: &str, mm: f64, material: Material, effort: Target) -> [Estimate; 3] {
    let design = library::design(name, &Default::default()).expect("in the library").expect("solved");
    let metrics = NAMES.map(|m| Metric::by_name(m).expect("in the catalogue")).to_vec();
    let plan = ScoreRequest::default().metrics(metrics).target(effort).polarised(false).seed(SEED);
    let row = score(&subject(name, &design.sized(mm).expect("solid"), material), &plan);
    assert_eq!(row.error, None);
    std::array::from_fn(|i| row.scores[i].expect("applies"))
}

fn agrees(name: &str, mm: f64, material: Material, rays: u64) {
    let stone = stone(name, mm);
    let exhaustive = Exhaustive::new(&stone, &material).scores(rays);
    let found = scored(name, mm, material, Target::Samples(1 << 18));
    for ((metric, a), b) in NAMES.iter().zip(found).zip(exhaustive) {
        println!("{name} {mm} mm {metric}: {a:?} exhaustive {b:?}");
        assert!((a.value - b.value).abs() < 4.0 * a.error.hypot(b.error), "{metric}: {a:?} {b:?}");
        assert!(a.error < 0.05 * a.value, "{metric}: {a:?}");
    }
}

/// Where rays ended at 1e-4 of their light, a dark ruby's scores came out 5 to 12 % low, 7 to 45 errors.
#[test]
fn a_dark_stone_has_the_scores_of_an_exhaustive_trace() {
    agrees("round-brilliant", 13.0, ruby(), 1 << 17);
    agrees("round-brilliant", 6.5, smoke(), 1 << 17);
}

#[test]
#[ignore = "a million and a half rays in f64: .ci/run runs it"]
fn dark_stones_have_the_scores_of_exhaustive_traces() {
    for (name, mm, material) in
        [("round-brilliant", 13.0, ruby()), ("oval", 13.0, smoke()), ("round-brilliant", 6.5, ruby())]
    {
        agrees(name, mm, material, 1 << 19);
    }
}

/// An independent audit has .0249 and .0118 for the light that comes back from a ruby, as the eye sees
/// it in daylight; at the D line it is .0026 and .000015.
#[test]
fn a_ruby_returns_what_the_eye_sees() {
    for (mm, expected) in [(6.5, 0.0249), (13.0, 0.0118)] {
        let [light_return, ..] = scored("round-brilliant", mm, ruby(), Target::Error(1e-4));
        assert!((light_return.value / expected - 1.0).abs() < 0.02, "{mm} mm: {light_return:?}");
    }
}

/// What is given up does not stand in the way of a small error: of a cube 4.8e-5 were, and no error
/// said so.
#[test]
fn small_errors_hold_what_is_given_up() {
    let design = library::design("cube", &Default::default()).expect("in the library").expect("solved");
    let metrics = ["leakage", "lost"].map(|m| Metric::by_name(m).expect("in the catalogue")).to_vec();
    let plan = ScoreRequest::default().metrics(metrics).error(5e-6).seed(SEED);
    let row = score(&subject("cube", &design, brilliants::diamond()), &plan);
    assert_eq!(row.error, None);
    let [leakage, lost] = [0, 1].map(|i| row.scores[i].expect("applies"));
    assert!(leakage.error <= 5e-6, "{leakage:?}");
    // by beams (--exact)
    let (truth, error) = (0.671_393_4, 5.8e-6);
    assert!((leakage.value - truth).abs() < 4.0 * leakage.error.hypot(error), "{leakage:?}");
    assert!(lost.value < 5e-6, "{lost:?}");
    // where samples are asked for in place of an error, the error holds what is given up
    let plan = plan.samples(1 << 20);
    let row = score(&subject("cube", &design, brilliants::diamond()), &plan);
    let [leakage, lost] = [0, 1].map(|i| row.scores[i].expect("applies"));
    assert!(lost.value > 1e-5 && leakage.error >= lost.value, "{leakage:?} {lost:?}");
    assert!((leakage.value - truth).abs() < 2.0 * leakage.error, "{leakage:?}");
}
