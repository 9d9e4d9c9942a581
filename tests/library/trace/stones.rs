//! Stones and rays that the tests of the tracer share.

use cutlab::advanced::design::families;
use cutlab::advanced::geometry::{Plane, Polyhedron};
use cutlab::advanced::optics::stokes::Stokes;
use cutlab::advanced::sampling::{
    random::{Purpose, Stream},
    warps,
};
use cutlab::advanced::trace::{ConvexStone, LANES, Packet, reference};
use glam::{DVec3, Vec3};
use std::collections::BTreeMap;

/// The only seed of these tests.
pub const SEED: u64 = 1;

pub const DIAMOND: f32 = 2.417;

pub fn brilliant() -> Polyhedron {
    let design = families::build("round-brilliant", &BTreeMap::new()).expect("builds");
    design.solid().expect("closed")
}

/// A cube of half side 1.
pub fn cube() -> Polyhedron {
    let planes = DVec3::AXES.map(|n| [Plane::new(n, 1.0), Plane::new(-n, 1.0)]).concat();
    Polyhedron::from_planes(&planes).expect("closed")
}

pub fn random_direction(s: &mut Stream) -> Vec3 {
    let [z, phi] = [1.0 - 2.0 * s.unit(), std::f32::consts::TAU * s.unit()];
    let r = (1.0 - z * z).sqrt();
    Vec3::new(r * phi.cos(), r * phi.sin(), z)
}

/// A closed stone of `count` planes: a tetrahedron knocked about, and planes near the unit sphere.
pub fn random_stone(count: usize, number: u64) -> Polyhedron {
    let mut s = Stream::new(SEED, Purpose::TEST, number);
    let tetrahedron =
        [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]].map(Vec3::from_array);
    let mut planes: Vec<Plane> = tetrahedron
        .map(|n| {
            let knocked = n.normalize() + 0.3 * random_direction(&mut s);
            Plane::new(knocked.as_dvec3(), 1.0 + 0.1 * s.unit64())
        })
        .into();
    while planes.len() < count {
        planes.push(Plane::new(random_direction(&mut s).as_dvec3(), 1.0 + 0.02 * s.unit64()));
    }
    Polyhedron::from_planes(&planes).expect("a knocked tetrahedron is closed")
}

/// A packet of rays that enter anywhere from anywhere, and what each reflects.
pub fn entering(stone: &ConvexStone, s: &mut Stream, index: f32) -> (Packet, [f32; LANES]) {
    let mut packet = Packet::default();
    let mut reflected = [0.0; LANES];
    for (lane, reflected) in reflected.iter_mut().enumerate() {
        let facet = ((s.unit64() * stone.facet_count() as f64) as usize).min(stone.facet_count() - 1);
        let corners: Vec<_> = stone.solid.polygon(facet).map(|v| stone.point_from_design(v)).collect();
        let i = 1 + (s.unit64() * (corners.len() - 2) as f64) as usize;
        let [b, c] = warps::uniform_triangle(s.pair()).map(f64::from);
        let point = corners[0] + (corners[i] - corners[0]) * b + (corners[i + 1] - corners[0]) * c;
        let direction = -warps::to_world(stone.normals[facet], warps::cosine_hemisphere(s.pair()));
        let entry = stone.refract_into(facet, direction, index);
        packet.load_refracted(lane, point.as_vec3(), &entry, index);
        *reflected = entry.reflectance;
    }
    (packet, reflected)
}

/// The same ray for the `f64` twin, which follows polarisation if the packet does.
pub fn twin_of(packet: &Packet, lane: usize) -> reference::ScalarRay {
    let [q, u, v] = [packet.q, packet.u, packet.v].map(|part| f64::from(part[lane]));
    let axis = DVec3::new(packet.ax[lane].into(), packet.ay[lane].into(), packet.az[lane].into());
    let stokes = Stokes { i: packet.power[lane].into(), q, u, v, axis: axis.normalize() };
    reference::ScalarRay {
        point: packet.point(lane).as_dvec3(),
        direction: packet.direction(lane).as_dvec3().normalize(),
        power: packet.power[lane].into(),
        index: packet.index[lane].into(),
        absorption: 0.0,
        stokes: packet.polarised.then_some(stokes),
    }
}

/// Distance at which a ray meets the plane of one facet; none if it does not head for it.
pub fn distance_to(plane: &Plane, point: DVec3, direction: DVec3) -> Option<f64> {
    let toward = plane.normal.dot(direction);
    (toward > 0.0).then(|| (-plane.signed_distance(point)).max(0.0) / toward)
}
