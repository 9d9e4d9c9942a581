//! Thin points that decide trust: grazing light, edges and corners, the critical angle, rays that
//! never leave.

use super::energy::assert_energy;
use super::stones::*;
use cutlab::advanced::design::library;
use cutlab::advanced::optics::fresnel::FresnelCoefficients;
use cutlab::advanced::sampling::{
    random::{Purpose, Stream},
    warps,
};
use cutlab::advanced::trace::{ConvexStone, Isa, LANES, Packet, reference};
use glam::{DMat3, DVec3, Vec3};
use std::collections::BTreeMap;

/// Directions at 10⁻¹ … 10⁻¹⁵ of the horizon, and along it.
#[test]
fn grazing_light_stays_outside_or_is_balanced() {
    let stone = ConvexStone::new(brilliant());
    let table = (0..stone.facet_count()).max_by(|a, b| stone.normals[*a].z.total_cmp(&stone.normals[*b].z));
    let table = table.expect("a table");
    let middle = Vec3::new(0.0, 0.0, stone.planes[table].distance as f32);
    let (mut packet, mut reflected) = (Packet::default(), [1.0; LANES]);
    for (lane, reflected) in reflected.iter_mut().enumerate() {
        let cos = if lane == 0 { 0.0 } else { 10f32.powi(-(lane as i32)) };
        let direction = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, -cos);
        let entry = stone.refract_into(table, direction, DIAMOND);
        assert!(entry.direction.is_finite() && (entry.direction.length() - 1.0).abs() < 1e-6);
        packet.load_refracted(lane, middle, &entry, DIAMOND);
        *reflected = entry.reflectance;
    }
    assert_eq!(reflected[0], 1.0);
    assert_energy(&stone, packet, reflected, 1e-7);
}

#[test]
fn rays_along_edges_and_into_corners_are_balanced() {
    for solid in [brilliant(), random_stone(4, 3), random_stone(500, 4), cube()] {
        let stone = ConvexStone::new(solid);
        let corners: Vec<_> = stone.solid.vertices.iter().map(|v| stone.point_from_design(*v)).collect();
        let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
        let mut rays = Vec::new();
        for face in &stone.solid.faces {
            let (a, b) = (corners[face.corners[0]], corners[face.corners[1]]);
            rays.push((a, b - a)); // from corner to corner along the edge
            rays.push(((a + b) * 0.5, b - a)); // along the edge
            rays.push((middle, a - middle)); // into the corner
            rays.push((middle, (a + b) * 0.5 - middle)); // into the edge
            rays.push((a, middle - a)); // from the corner
        }
        for rays in rays.chunks_exact(LANES) {
            let mut packet = Packet::default();
            for (lane, (point, toward)) in rays.iter().enumerate() {
                packet.load(lane, point.as_vec3(), toward.normalize().as_vec3(), 1.0, DIAMOND);
            }
            assert_energy(&stone, packet, [0.0; LANES], 1e-5);
        }
    }
}

/// [D] in a cube the ray (1, 1, 1) meets every face at 54.7°, beyond the critical 24.4°, for ever.
#[test]
fn a_trapped_ray_ends_and_is_lost() {
    let stone = ConvexStone::new(cube());
    let mut packet = Packet::default();
    packet.load(3, Vec3::new(0.1, 0.03, -0.02), Vec3::ONE.normalize(), 0.7, DIAMOND);
    let mut left = 0.0;
    let lost = stone.trace(&mut packet, 1e-4, |m, _| left += m.power.iter().sum::<f32>());
    assert_eq!((left, lost), (0.0, 0.7));
    assert!(packet.power.iter().all(|p| *p == 0.0));
    // and a direction that is no number, at once
    packet.load(0, Vec3::ZERO, Vec3::NAN, 1.0, DIAMOND);
    assert_eq!(stone.trace(&mut packet, 1e-4, |m, _| assert_eq!(m.power[0], 0.0)), 1.0);
}

/// Rays that meet the table at the critical angle and a few roundings of it: no power is made, the
/// way out is a unit vector, and what passes is the twin's but for what a rounding of cos² does.
#[test]
fn exits_at_the_critical_angle_are_balanced() {
    for isa in Isa::all() {
        let stone = ConvexStone::with_isa(brilliant(), isa);
        let n = f64::from(DIAMOND);
        let critical = (1.0 / n).asin();
        let mut packet = Packet::default();
        let steps: [f64; LANES] =
            std::array::from_fn(|l| if l == 0 { 0.0 } else { 10f64.powi(-(l.div_ceil(2) as i32)) });
        let angle = |l: usize| critical + steps[l] * if l.is_multiple_of(2) { 0.5 } else { -0.5 };
        for l in 0..LANES {
            let direction = DVec3::new(angle(l).sin(), 0.0, angle(l).cos());
            packet.load(l, Vec3::ZERO, direction.as_vec3(), 1.0, DIAMOND);
        }
        let mut bounces = 0;
        stone.trace(&mut packet, 0.0, |m, after| {
            if bounces == 0 {
                for l in 0..LANES {
                    let kept = FresnelCoefficients::new(angle(l).cos(), 1.0 / n);
                    let rounding = (1e-6 / kept.cos_t.max(1e-3)).min(1e-3);
                    assert!((f64::from(m.cos_outside[l]) - kept.cos_t).abs() < rounding, "lane {l}");
                    let passed = 1.0 - kept.unpolarised_reflectance();
                    assert!((f64::from(m.power[l]) - passed).abs() < 12.0 * rounding, "lane {l}");
                    assert!(m.power[l] >= 0.0 && m.power[l] + after.power[l] == 1.0, "lane {l}");
                    if m.power[l] > 0.0 {
                        assert!((m.direction(l).length() - 1.0).abs() < 1e-6, "lane {l}");
                    }
                }
            }
            bounces += 1;
            after.power = [0.0; LANES];
        });
        assert_eq!(bounces, 1);
    }
}

/// A rhombic dodecahedron a tenth of a degree off its symmetry sends some percent of its light within
/// 1e-4 of the horizon, most of it much nearer, where `f32` cannot tell up from down. Power and cosines are right: only
/// on which side of the horizon that light counts is open.
#[test]
fn light_along_the_horizon_is_right_but_for_its_side() {
    let design = library::design("rhombic-dodecahedron", &BTreeMap::new()).expect("there").expect("good");
    let axis = DMat3::from_rotation_z(0.3) * DVec3::X;
    let turned = design.turned(DMat3::from_axis_angle(axis, 0.1f64.to_radians()));
    let stone = ConvexStone::new(turned.solid().expect("closed"));
    let planes = stone.kernel_planes();
    let mut s = Stream::new(SEED, Purpose::TEST, 700);
    let near = |z: f64| z.abs() < 1e-4;
    let (mut lanes, mut twin, mut rays) = ([0.0; 3], [0.0; 3], 0.0);
    let side = |z: f64| if near(z) { 0 } else { 1 + usize::from(z > 0.0) };
    for _ in 0..200 {
        let mut packet = Packet::default();
        for lane in 0..LANES {
            let target = (0.5 * warps::uniform_disc(s.pair())).extend(3.0);
            let hit = stone.intersect(target, Vec3::NEG_Z).expect("over the stone");
            let entry = stone.refract_into(hit.facet, Vec3::NEG_Z, DIAMOND);
            packet.load_refracted(lane, target - Vec3::Z * hit.distance, &entry, DIAMOND);
            let go = |m: &reference::ScalarInteraction| twin[side(m.direction.z)] += m.power;
            reference::trace(&planes, twin_of(&packet, lane), 1e-4, go);
            rays += 1.0;
        }
        stone.trace(&mut packet, 1e-4, |m, _| {
            (0..LANES).for_each(|l| lanes[side(m.dz[l].into())] += f64::from(m.power[l]));
        });
    }
    assert!(lanes[0] > 0.02 * rays, "{lanes:?} of {rays}");
    for (a, b) in lanes.iter().zip(twin) {
        assert!((a - b).abs() < 1e-4 * rays, "{lanes:?} {twin:?} of {rays}");
    }
}
