//! Reciprocity: light sent back returns, and power between two directions is the same both ways, with
//! the square of the index for a direction inside.

use super::stones::*;
use cutlab::advanced::optics::stokes::Stokes;
use cutlab::advanced::sampling::{
    random::{Purpose, Stream},
    warps,
};
use cutlab::advanced::trace::{ConvexStone, LANES, Packet, reference};
use glam::{DVec3, Vec3};

/// A way through the stone: where it starts and ends outside, and the share of power that takes it.
#[derive(Debug, Clone, Copy)]
struct Way {
    from: (DVec3, DVec3),
    to: (DVec3, DVec3),
    share: f64,
}

/// The ways of an unpolarised ray onto a facet by the twin: one for each exit of more than a
/// thousandth.
fn ways_of_twin(stone: &ConvexStone, point: DVec3, toward: DVec3, facet: usize, polarised: bool) -> Vec<Way> {
    let n = f64::from(DIAMOND);
    let normal = stone.planes[facet].normal;
    let cos = -toward.dot(normal);
    let facing = cutlab::advanced::optics::fresnel::FresnelCoefficients::new(cos, n);
    let inside = (toward / n + normal * (cos / n - facing.cos_t)).normalize();
    let power = 1.0 - facing.unpolarised_reflectance();
    let light = Stokes::unpolarised(1.0, toward.any_orthonormal_vector());
    let light = light.about_incidence(toward, normal).transmitted(&facing);
    let stokes = polarised.then_some(light);
    let ray = reference::ScalarRay { point, direction: inside, power, index: n, absorption: 0.0, stokes };
    let mut ways = Vec::new();
    reference::trace(&stone.planes, ray, 1e-3, |m| {
        if m.power > 1e-3 {
            ways.push(Way { from: (point, toward), to: (m.point, m.direction), share: m.power });
        }
    });
    ways
}

/// The same in lanes, in the first lane of a packet.
fn ways_of_lanes(
    stone: &ConvexStone,
    point: DVec3,
    toward: DVec3,
    facet: usize,
    polarised: bool,
) -> Vec<Way> {
    let entry = stone.refract_into(facet, toward.as_vec3(), DIAMOND);
    let mut packet = Packet::new(polarised);
    packet.load_refracted(0, point.as_vec3(), &entry, DIAMOND);
    let mut ways = Vec::new();
    stone.trace(&mut packet, 1e-3, |m, packet| {
        if m.power[0] > 1e-3 {
            let to = (packet.point(0).as_dvec3(), m.direction(0).as_dvec3());
            ways.push(Way { from: (point, toward), to, share: m.power[0].into() });
        }
    });
    ways
}

/// Facet that a point of the surface lies on.
fn facet_at(stone: &ConvexStone, point: DVec3) -> usize {
    let height = |f: &usize| stone.planes[*f].signed_distance(point).abs();
    (0..stone.facet_count()).min_by(|a, b| height(a).total_cmp(&height(b))).expect("has facets")
}

type Ways = fn(&ConvexStone, DVec3, DVec3, usize, bool) -> Vec<Way>;

/// Every exit sent back comes out where the ray came from, with the same share, whether its
/// polarisation is followed or not.
fn assert_returns(ways: Ways, within: f64, most_lost: usize) {
    let stone = ConvexStone::new(brilliant());
    let mut s = Stream::new(SEED, Purpose::TEST, 800);
    let (mut tried, mut lost) = (0, 0);
    for number in 0..200 {
        let polarised = number % 2 == 0;
        let toward = -warps::uniform_cone(s.pair(), 0.5);
        let origin = (0.9 * warps::uniform_disc(s.pair())).extend(0.0) - 3.0 * toward;
        let Some(hit) = stone.intersect(origin, toward) else { continue };
        let (origin, toward) = (origin.as_dvec3(), toward.as_dvec3().normalize());
        let plane = stone.planes[hit.facet];
        let point = origin - toward * (plane.signed_distance(origin) / plane.normal.dot(toward));
        for way in ways(&stone, point, toward, hit.facet, polarised) {
            let (start, back) = (way.to.0, -way.to.1);
            if back.dot(stone.planes[facet_at(&stone, start)].normal) > -0.02 {
                continue; // along the facet: the way back hangs on the last digits
            }
            tried += 1;
            let found = ways(&stone, start, back, facet_at(&stone, start), polarised).into_iter().any(|w| {
                w.to.0.distance(way.from.0) < 100.0 * within
                    && w.to.1.distance(-way.from.1) < 100.0 * within
                    && (w.share - way.share).abs() < within
            });
            lost += usize::from(!found);
        }
    }
    println!("{lost} of {tried} ways do not return");
    assert!(tried > 500 && lost <= tried * most_lost / 1000, "{lost} of {tried}");
}

#[test]
fn light_sent_back_returns_in_the_twin() {
    assert_returns(ways_of_twin, 1e-9, 0);
}

/// One way in a hundred passes an edge within a rounding of `f32`.
#[test]
fn light_sent_back_returns_in_lanes() {
    assert_returns(ways_of_lanes, 1e-4, 10);
}

/// A point of the surface, uniform by area: its facet and place.
fn on_surface(stone: &ConvexStone, areas: &[f64], s: &mut Stream) -> (usize, Vec3) {
    let mut left = s.unit64() * areas.iter().sum::<f64>();
    let facet = areas.iter().position(|a| {
        left -= a;
        left < 0.0
    });
    let facet = facet.unwrap_or(areas.len() - 1);
    (facet, on_facet(stone, facet, s))
}

fn on_facet(stone: &ConvexStone, facet: usize, s: &mut Stream) -> Vec3 {
    let corners: Vec<_> = stone.solid.polygon(facet).map(|v| stone.point_from_design(v)).collect();
    let twice = |i: usize| (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]).length();
    let mut left = s.unit64() * (1..corners.len() - 1).map(twice).sum::<f64>();
    let i = (1..corners.len() - 1).find(|i| {
        left -= twice(*i);
        left < 0.0
    });
    let i = i.unwrap_or(1);
    let [b, c] = warps::uniform_triangle(s.pair()).map(f64::from);
    (corners[0] + (corners[i] - corners[0]) * b + (corners[i + 1] - corners[0]) * c).as_vec3()
}

/// Power from the sky above 45° to a cone about the table's normal inside, and back. Both are
/// étendue × mean share, the étendue inside with the square of the index; three errors of each.
#[test]
fn power_into_a_cone_inside_is_the_power_out_of_it() {
    const SKY: f32 = std::f32::consts::FRAC_1_SQRT_2;
    const CONE: f32 = 0.95;
    const PACKETS: usize = 12_000;
    let stone = ConvexStone::new(brilliant());
    let areas: Vec<f64> =
        (0..stone.facet_count()).map(|f| stone.solid.area(f) / (stone.unit * stone.unit)).collect();
    let surface: f64 = areas.iter().sum();
    let table = (0..areas.len()).max_by(|a, b| stone.normals[*a].z.total_cmp(&stone.normals[*b].z));
    let table = table.expect("a table");
    let mut s = Stream::new(SEED, Purpose::TEST, 801);
    let (mut into, mut out) = (Vec::new(), Vec::new());
    for _ in 0..PACKETS {
        // from the sky: what arrives at the table from inside, within the cone
        let mut packet = Packet::default();
        for lane in 0..LANES {
            let (facet, point) = on_surface(&stone, &areas, &mut s);
            let sky = warps::to_world(stone.normals[facet], warps::cosine_hemisphere(s.pair()));
            if sky.z > SKY {
                packet.load_refracted(lane, point, &stone.refract_into(facet, -sky, DIAMOND), DIAMOND);
            }
        }
        let mut arrived = 0.0;
        stone.trace(&mut packet, 1e-4, |m, after| {
            for l in 0..LANES {
                let counts = m.facet[l] as usize == table && m.cos_inside[l] > CONE;
                arrived += if counts { f64::from(m.power[l] + after.power[l]) } else { 0.0 };
            }
        });
        into.push(surface * arrived / LANES as f64);
        // from the cone: what leaves into the sky
        for lane in 0..LANES {
            let down = warps::to_world(-stone.normals[table], warps::cosine_hemisphere(s.pair()));
            let cos = -down.dot(stone.normals[table]);
            let power = if cos > CONE { 1.0 } else { 0.0 };
            packet.load(lane, on_facet(&stone, table, &mut s), down, power, DIAMOND);
        }
        let mut left = 0.0;
        stone.trace(&mut packet, 1e-4, |m, _| {
            (0..LANES).for_each(|l| left += if m.dz[l] > SKY { f64::from(m.power[l]) } else { 0.0 });
        });
        let n2 = f64::from(DIAMOND).powi(2);
        out.push(n2 * areas[table] * left / LANES as f64);
    }
    let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len() as f64;
    let error2 = |of: &[f64]| {
        let m = mean(of);
        of.iter().map(|x| (x - m).powi(2)).sum::<f64>() / (of.len() * (of.len() - 1)) as f64
    };
    let (a, b, error) = (mean(&into), mean(&out), (error2(&into) + error2(&out)).sqrt());
    println!("into the cone {a:.4}, out of it {b:.4}, error of the difference {error:.4}");
    assert!(error < 0.02 * a && (a - b).abs() < 3.0 * error, "{a} {b} ± {error}");
}
