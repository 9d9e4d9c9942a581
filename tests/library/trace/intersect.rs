//! The next facet and the first one against brute force in `f64`, on random convex stones.

use super::stones::*;
use cutlab::advanced::geometry::{Plane, Polyhedron};
use cutlab::advanced::sampling::random::{Purpose, Stream};
use cutlab::advanced::trace::{ConvexStone, Isa, LANES, NO_FACET, Packet, reference};
use glam::DVec3;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// Asserts that a lane met the nearest facet, or one that rounding cannot tell from it.
fn assert_nearest(planes: &[Plane], before: &Packet, lane: usize, met: usize) {
    let (point, direction) = (before.point(lane).as_dvec3(), before.direction(lane).as_dvec3());
    let (nearest, least) = reference::next_facet(planes, point, direction).expect("a direction");
    if met != nearest {
        let toward = planes[met].normal.dot(direction).min(planes[nearest].normal.dot(direction));
        let behind = distance_to(&planes[met], point, direction).map(|d| (d - least) * toward.min(1.0));
        assert!(behind.is_some_and(|b| b < 1e-6), "met {met}, {behind:?} behind {nearest} at {least}");
    }
}

/// Random slopes above and below a girdle of flats.
fn random_girdled(flats: usize, slopes: usize, stretch: f64, number: u64) -> Polyhedron {
    let mut s = Stream::new(SEED, Purpose::TEST, number);
    let mut planes: Vec<Plane> = (0..flats)
        .map(|i| {
            let turn = (i as f64 + 0.3 * s.unit64()) * std::f64::consts::TAU / flats as f64;
            let normal = DVec3::new(turn.cos(), turn.sin() * stretch, 0.0);
            Plane::new(normal, 1.0 / normal.length())
        })
        .collect();
    planes.extend([DVec3::Z, DVec3::NEG_Z].map(|n| Plane::new(n, 0.6)));
    for i in 0..slopes {
        let up = if i % 2 == 0 { 1.0 } else { -1.0 };
        let normal = random_direction(&mut s).as_dvec3();
        let normal = DVec3::new(normal.x, normal.y, up * (0.2 + normal.z.abs()));
        planes.push(Plane::new(normal, 0.6 + 0.3 * s.unit64()));
    }
    Polyhedron::from_planes(&planes).expect("a prism is closed")
}

/// Asserts of every instruction set that it finds the facets that brute force finds, from where
/// rays enter and at some bounces of each.
fn assert_all_nearest(solid: Polyhedron, number: u64) {
    let stones: Vec<_> =
        Isa::all().into_iter().map(|isa| ConvexStone::with_isa(solid.clone(), isa)).collect();
    let planes = stones[0].kernel_planes();
    let mut s = Stream::new(SEED + 1, Purpose::TEST, number);
    let (mut packet, _) = entering(&stones[0], &mut s, DIAMOND);
    let mut bounces = 0;
    stones[0].trace(&mut packet.clone(), 0.0, |_, after| {
        for stone in &stones {
            let next = stone.next_facets(&packet);
            for lane in (0..LANES).filter(|l| packet.power[*l] > 0.0) {
                assert_nearest(&planes, &packet, lane, next.facet[lane] as usize);
            }
        }
        bounces += 1;
        packet = after.clone();
        if bounces == 20 {
            after.power = [0.0; LANES];
        }
    });
}

/// A direction that is no number meets nothing, and its neighbours are none the worse.
#[test]
fn no_direction_meets_no_facet() {
    for isa in Isa::all() {
        let stone = ConvexStone::with_isa(brilliant(), isa);
        let (mut packet, _) = entering(&stone, &mut Stream::new(SEED, Purpose::TEST, 7), DIAMOND);
        let before = stone.next_facets(&packet);
        packet.dx[5] = f32::NAN;
        let after = stone.next_facets(&packet);
        assert_eq!(after.facet[5], NO_FACET, "{}", isa.name());
        assert!((0..LANES).all(|l| l == 5 || before.facet[l] == after.facet[l]), "{}", isa.name());
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 48,
        rng_seed: RngSeed::Fixed(SEED),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    /// Every lane of every instruction set finds the facet that brute force in `f64` finds nearest,
    /// for a few bounces from inside random stones.
    #[test]
    fn the_next_facet_is_the_nearest_one(count in 4usize..=500, number in 0u64..1 << 40) {
        assert_all_nearest(random_stone(count, number), number);
    }

    /// The same of stones with upright facets, which are sought apart: outlines round and drawn out.
    #[test]
    fn the_next_facet_of_a_stone_with_a_girdle_is_the_nearest_one(
        flats in 8usize..=200, slopes in 2usize..=100, stretch in 1.0..3.0, number in 0u64..1 << 40,
    ) {
        assert_all_nearest(random_girdled(flats, slopes, stretch, number), number);
    }

    /// [`ConvexStone::intersect`] against clipping the ray by every plane in `f64`.
    #[test]
    fn the_first_hit_is_what_clipping_finds(count in 4usize..=500, number in 0u64..1 << 40) {
        let solid = random_stone(count, number);
        let stones: Vec<_> = Isa::all().into_iter().map(|isa| ConvexStone::with_isa(solid.clone(), isa)).collect();
        let planes = stones[0].kernel_planes();
        let mut s = Stream::new(SEED + 2, Purpose::TEST, number);
        for _ in 0..64 {
            let origin = random_direction(&mut s) * (1.0 + 3.0 * s.unit());
            let target = random_direction(&mut s) * s.unit();
            let direction = (target - origin).normalize();
            let (mut enter, mut leave) = ((0, f64::NEG_INFINITY), f64::INFINITY);
            for (i, plane) in planes.iter().enumerate() {
                let toward = plane.normal.dot(direction.as_dvec3());
                let t = -plane.signed_distance(origin.as_dvec3()) / toward;
                if toward < 0.0 && t > enter.1 {
                    enter = (i, t);
                } else if toward > 0.0 {
                    leave = leave.min(t);
                }
            }
            let inside = leave - enter.1;
            for stone in &stones {
                match stone.intersect(origin, direction) {
                    Some(hit) => {
                        prop_assert!(inside > -1e-5 && (f64::from(hit.distance) - enter.1).abs() < 1e-4);
                        let plane = &planes[hit.facet];
                        let at = origin.as_dvec3() + direction.as_dvec3() * enter.1;
                        prop_assert!(hit.facet == enter.0 || plane.signed_distance(at).abs() < 1e-5);
                    }
                    None => prop_assert!(inside < 1e-5 || enter.1 < 1e-5, "missed {} of stone", inside),
                }
            }
        }
    }
}
