//! Stones with concavities: convex ones as the twin traces them, energy, and chance without bias.

use super::stones::*;
use cutlab::advanced::geometry::triangulation::TriangleMesh;
use cutlab::advanced::optics::fresnel::FresnelCoefficients;
use cutlab::advanced::optics::stokes::Stokes;
use cutlab::advanced::sampling::random::{Purpose, Stream};
use cutlab::advanced::trace::nonconvex::{MeshError, MeshStone, Side};
use cutlab::advanced::trace::{ConvexStone, LANES, reference};
use glam::DVec3;

pub const N: f64 = 2.417;

/// A mesh of faces given by their corners, each cut as a fan.
fn mesh(vertices: &[[f64; 3]], faces: &[&[usize]]) -> TriangleMesh {
    let mut mesh = TriangleMesh {
        vertices: vertices.iter().map(|v| DVec3::from_array(*v)).collect(),
        ..TriangleMesh::default()
    };
    for (number, face) in faces.iter().enumerate() {
        for i in 1..face.len() - 1 {
            mesh.triangles.push([face[0], face[i], face[i + 1]]);
            mesh.faces.push(number);
        }
    }
    mesh
}

/// A cube whose top is a pyramid pressed in to half its depth.
pub fn dented_cube() -> TriangleMesh {
    let [a, b] = [-1.0, 1.0];
    let corners = [
        [a, a, a],
        [b, a, a],
        [b, b, a],
        [a, b, a],
        [a, a, b],
        [b, a, b],
        [b, b, b],
        [a, b, b],
        [0.1, -0.05, 0.0],
    ];
    let sides: [&[usize]; 5] = [&[3, 2, 1, 0], &[0, 1, 5, 4], &[1, 2, 6, 5], &[2, 3, 7, 6], &[3, 0, 4, 7]];
    let dent: [&[usize]; 4] = [&[4, 5, 8], &[5, 6, 8], &[6, 7, 8], &[7, 4, 8]];
    mesh(&corners, &[&sides[..], &dent[..]].concat())
}

/// A prism with a notch: an L seen from above.
pub fn notched_prism() -> TriangleMesh {
    let outline = [[0.0, 0.0], [2.0, 0.1], [2.0, 1.0], [0.9, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let corners: Vec<_> = [-0.7, 0.7].iter().flat_map(|z| outline.map(|[x, y]| [x, y, *z])).collect();
    let walls: Vec<[usize; 4]> = (0..6).map(|i| [i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6]).collect();
    // an L from its inner corner is a fan
    let (floor, roof): (&[usize], &[usize]) = (&[3, 2, 1, 0, 5, 4], &[9, 10, 11, 6, 7, 8]);
    let faces: Vec<&[usize]> = walls.iter().map(|w| &w[..]).chain([floor, roof]).collect();
    mesh(&corners, &faces)
}

/// A ray of unpolarised light from outside onto the middle of the stone's box or near it; whether its
/// polarisation is followed.
fn aimed(s: &mut Stream, polarised: bool) -> reference::ScalarRay {
    let direction = random_direction(s).as_dvec3().normalize();
    let target = random_direction(s).as_dvec3() * 0.4 * s.unit64();
    falling(target - direction * 3.0, direction, polarised)
}

/// A ray of unpolarised light of power 1; whether its polarisation is followed.
pub fn falling(point: DVec3, direction: DVec3, polarised: bool) -> reference::ScalarRay {
    let stokes = polarised.then(|| Stokes::unpolarised(1.0, direction.any_orthonormal_vector()));
    reference::ScalarRay { point, direction, power: 1.0, index: N, absorption: 0.0, stokes }
}

/// [D] facet by facet, until two are equally near.
#[test]
fn convex_stones_are_traced_as_the_twin_traces_them() {
    for (number, solid) in
        [brilliant(), random_stone(4, 11), random_stone(100, 12), cube()].into_iter().enumerate()
    {
        let stone = ConvexStone::new(solid);
        let mesh = MeshStone::new(&stone.solid.triangulate()).expect("closed");
        assert!(mesh.centre.distance(stone.centre) < 1e-12 && (mesh.unit - stone.unit).abs() < 1e-12);
        let mut s = Stream::new(SEED, Purpose::TEST, 900 + number as u64);
        let (mut bounces, mut parted) = (0, 0);
        for _ in 0..20 {
            let (packet, _) = entering(&stone, &mut s, DIAMOND);
            for lane in 0..LANES {
                let mut ray = twin_of(&packet, lane);
                if lane % 2 == 0 {
                    // any state of polarisation
                    let axis = ray.direction.any_orthonormal_vector();
                    let [q, u, v] = [0.3, -0.5, 0.6].map(|part| part * ray.power);
                    ray.stokes = Some(Stokes { i: ray.power, q, u, v, axis });
                }
                let mut twin = Vec::new();
                reference::trace(&stone.planes, ray, 1e-3, |m| twin.push(*m));
                let mut twin = twin.into_iter();
                let mut together = true;
                mesh.trace(ray, Side::Inside, 1e-3, &mut s.clone(), |m, _| {
                    let Some(t) = twin.next().filter(|_| together) else { return };
                    together = t.facet == m.facet;
                    bounces += 1;
                    parted += usize::from(!together);
                    if together {
                        assert!(m.point.distance(t.point) < 1e-6, "{} {}", m.point, t.point);
                        assert!((m.power - t.power).abs() < 1e-6, "{} {}", m.power, t.power);
                    }
                });
            }
        }
        assert!(bounces > 1000 && parted * 1000 <= bounces, "{parted} of {bounces}");
    }
}

/// [D] whatever chance chooses: a lossless stone in uniform radiance 1 returns 1 along every ray.
#[test]
fn uniform_light_comes_back_whole() {
    for (number, mesh) in [dented_cube(), notched_prism()].iter().enumerate() {
        let stone = MeshStone::new(mesh).expect("closed");
        let mut s = Stream::new(SEED, Purpose::TEST, 910 + number as u64);
        let (mut rays, mut again, mut leaked) = (0, 0, 0.0);
        for number in 0..2000 {
            let ray = aimed(&mut s, number % 2 == 0);
            if stone.next_facet(ray.point, ray.direction, Side::Outside).is_none() {
                continue;
            }
            let (mut left, mut returns) = (0.0, 0);
            let lost = stone.trace(ray, Side::Outside, 1e-9, &mut s, |m, _| {
                left += m.power;
                returns += i32::from(m.power == 0.0 && m.cos_outside > 0.0);
            });
            assert!((left + lost - 1.0).abs() < 1e-12, "{left} {lost}");
            leaked += lost;
            rays += 1;
            again += i32::from(returns > 0);
        }
        println!(
            "{again} of {rays} rays met the stone again, {:.2e} of their light is kept",
            leaked / f64::from(rays)
        );
        assert!(rays > 1000 && again > rays / 20, "{again} of {rays}");
    }
}

/// Corners and normal of every triangle, trace frame.
pub fn triangles_of(mesh: &TriangleMesh, stone: &MeshStone) -> Vec<([DVec3; 3], DVec3)> {
    let corner = |c: usize| (mesh.vertices[c] - stone.centre) / stone.unit;
    let triangle = |t: &[usize; 3]| {
        let [a, b, c] = t.map(corner);
        ([a, b, c], (b - a).cross(c - a).normalize())
    };
    mesh.triangles.iter().map(triangle).collect()
}

/// The nearest crossing of a ray with any triangle, by brute force (Möller and Trumbore).
fn nearest(stone: &[([DVec3; 3], DVec3)], point: DVec3, direction: DVec3) -> Option<(f64, DVec3)> {
    let mut best: Option<(f64, DVec3)> = None;
    for ([a, b, c], normal) in stone {
        let (e1, e2) = (*b - *a, *c - *a);
        let p = direction.cross(e2);
        let det = e1.dot(p);
        let from = point - *a;
        let u = from.dot(p) / det;
        let q = from.cross(e1);
        let (v, t) = (direction.dot(q) / det, e2.dot(q) / det);
        if u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 1e-9 && best.is_none_or(|(d, _)| t < d) {
            best = Some((t, *normal));
        }
    }
    best
}

/// Power that leaves upward if both parts of every split are followed, with or without their
/// polarisation; what is below `least` is left out and counted.
pub fn tree(stone: &[([DVec3; 3], DVec3)], ray: reference::ScalarRay, least: f64) -> [f64; 2] {
    let reference::ScalarRay { point, direction, power, stokes, .. } = ray;
    if power < least {
        return [0.0, power];
    }
    let Some((t, normal)) = nearest(stone, point, direction) else {
        return [if direction.z > 0.0 { power } else { 0.0 }, 0.0];
    };
    let along = direction.dot(normal);
    let eta = if along > 0.0 { 1.0 / N } else { N };
    let facing = FresnelCoefficients::new(along.abs(), eta);
    let light = stokes.map(|light| light.about_incidence(direction, normal));
    let go = |direction: DVec3, part: Option<Stokes>, share: f64| {
        let power = part.map_or(share * power, |light| light.i);
        let direction = direction.normalize();
        tree(
            stone,
            reference::ScalarRay { point: point + ray.direction * t, direction, power, stokes: part, ..ray },
            least,
        )
    };
    let mirrored = direction - 2.0 * along * normal;
    let through = direction / eta + normal * along.signum() * (facing.cos_t - along.abs() / eta);
    let [a, lost_a] = go(mirrored, light.map(|l| l.reflected(&facing)), facing.unpolarised_reflectance());
    let [b, lost_b] = if facing.unpolarised_reflectance() < 1.0 {
        go(through, light.map(|l| l.transmitted(&facing)), 1.0 - facing.unpolarised_reflectance())
    } else {
        [0.0; 2]
    };
    [a + b, lost_a + lost_b]
}

/// The mean of what chance sends upward is what all branches together send there: 120 rays, four
/// errors each (one seed in 130 would fail by chance; this one was the first).
#[test]
fn chance_is_without_bias() {
    const WALKS: usize = 1000;
    for (number, mesh) in [dented_cube(), notched_prism()].iter().enumerate() {
        let stone = MeshStone::new(mesh).expect("closed");
        let triangles = triangles_of(mesh, &stone);
        let mut s = Stream::new(SEED, Purpose::TEST, 920 + number as u64);
        let (mut compared, mut chances) = (0, 0);
        while compared < 60 {
            let ray = aimed(&mut s, compared % 2 == 0);
            if stone.next_facet(ray.point, ray.direction, Side::Outside).is_none() {
                continue;
            }
            let [up, cut] = tree(&triangles, ray, 1e-6);
            let walks = (0..WALKS).map(|_| {
                let mut sent = 0.0;
                let upward = |m: &reference::ScalarInteraction, _| {
                    sent += if m.direction.z > 0.0 { m.power } else { 0.0 }
                };
                let lost = stone.trace(ray, Side::Outside, 1e-6, &mut s, upward);
                [sent, lost]
            });
            let walks: Vec<_> = walks.collect();
            let mean = |of: &dyn Fn(&[f64; 2]) -> f64| walks.iter().map(of).sum::<f64>() / WALKS as f64;
            let sent = mean(&|w| w[0]);
            let error = (mean(&|w| (w[0] - sent).powi(2)) / (WALKS - 1) as f64).sqrt();
            let open = cut + mean(&|w| w[1]);
            assert!((sent - up).abs() < 4.0 * error + open + 1e-9, "{sent} ± {error} for {up}, {open} open");
            compared += 1;
            chances += i32::from(error > 1e-4);
        }
        assert!(chances >= 5, "only {chances} rays leave anything to chance");
    }
}

#[test]
fn what_is_no_stone_is_refused() {
    let mut open = dented_cube();
    open.triangles.pop();
    open.faces.pop();
    assert!(matches!(MeshStone::new(&open), Err(MeshError::Open(..))));
    let mut bent = dented_cube();
    bent.vertices[0].z -= 0.01;
    assert!(matches!(MeshStone::new(&bent), Err(MeshError::NotFlat(_))));
    assert!(MeshStone::new(&TriangleMesh::default()).is_ok_and(|s| s.planes.is_empty()));
}
