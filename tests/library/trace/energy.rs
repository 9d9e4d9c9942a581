//! Energy: what enters leaves or is counted as lost, in lanes and in the twin.

use super::stones::*;
use cutlab::advanced::design::library;
use cutlab::advanced::materials;
use cutlab::advanced::sampling::random::{Purpose, Stream};
use cutlab::advanced::trace::{ConvexStone, LANES, Packet, reference};
use std::collections::BTreeMap;

/// Entered = left + given up, lane by lane, and the tracer's own total of what it gave up; with
/// polarisation and without. Returns the larger loss of a ray.
pub fn assert_energy(stone: &ConvexStone, packet: Packet, reflected: [f32; LANES], stop: f32) -> f64 {
    let lost = [false, true].map(|polarised| {
        let packet = Packet { polarised, ..packet.clone() };
        assert_energy_of(stone, packet, reflected, stop)
    });
    lost[0].max(lost[1])
}

/// A lane's own loss is what it last held: lanes are put to rest between bounces.
fn assert_energy_of(stone: &ConvexStone, mut packet: Packet, reflected: [f32; LANES], stop: f32) -> f64 {
    let entered = packet.power;
    let (mut left, mut held) = ([0f64; LANES], packet.power);
    let lost = stone.trace(&mut packet, stop, |m, p| {
        for l in 0..LANES {
            left[l] += f64::from(m.power[l]);
            held[l] = if p.power[l] > 0.0 || m.power[l] > 0.0 { p.power[l] } else { held[l] };
        }
    });
    for l in 0..LANES {
        let sum = left[l] + f64::from(held[l]);
        assert!((sum - f64::from(entered[l])).abs() < 1e-5, "lane {l}: {} became {sum}", entered[l]);
        // a lossless stone in uniform radiance 1 returns 1 along every ray
        let radiance = f64::from(reflected[l]) + sum;
        assert!((radiance - 1.0).abs() < 1e-5, "lane {l} returns {radiance}");
    }
    let total = left.iter().sum::<f64>() + f64::from(lost);
    let all: f64 = entered.iter().map(|p| f64::from(*p)).sum();
    assert!((total - all).abs() < 1e-5 * LANES as f64, "{all} became {total}");
    f64::from(lost) / LANES as f64
}

#[test]
fn what_enters_leaves_or_is_counted_as_lost() {
    for (number, solid) in
        [brilliant(), random_stone(4, 0), random_stone(500, 1), cube()].into_iter().enumerate()
    {
        let stone = ConvexStone::new(solid);
        let mut s = Stream::new(SEED, Purpose::TEST, 100 + number as u64);
        for index in [1.0, 1.54, DIAMOND] {
            for _ in 0..20 {
                let (packet, reflected) = entering(&stone, &mut s, index);
                assert_energy(&stone, packet, reflected, 1e-4);
            }
        }
    }
}

/// [D] by energy: followed to 1e-7, next to nothing is given up in a brilliant.
#[test]
fn a_brilliant_in_uniform_light_gives_all_of_it_back() {
    let stone = ConvexStone::new(brilliant());
    let mut s = Stream::new(SEED, Purpose::TEST, 200);
    for _ in 0..50 {
        let (packet, reflected) = entering(&stone, &mut s, DIAMOND);
        assert!(assert_energy(&stone, packet, reflected, 1e-7) < 1e-6);
    }
}

/// [D] the same of the `f64` twin, to 1e-12.
#[test]
fn the_twin_keeps_energy_to_twelve_digits() {
    for (number, solid) in [brilliant(), random_stone(4, 0), random_stone(500, 1)].into_iter().enumerate() {
        let stone = ConvexStone::new(solid);
        let mut s = Stream::new(SEED, Purpose::TEST, 300 + number as u64);
        for _ in 0..10 {
            let (mut packet, _) = entering(&stone, &mut s, DIAMOND);
            for lane in 0..LANES {
                packet.polarised = lane % 2 == 0;
                let ray = twin_of(&packet, lane);
                let mut left = 1.0 - ray.power;
                left += reference::trace(&stone.planes, ray, 1e-14, |m| left += m.power);
                assert!((left - 1.0).abs() < 1e-12, "{left}");
            }
        }
    }
}

/// [D] A lossless stone in uniform radiance 1 returns 1 along every ray: every cut of the library,
/// every material of the catalogue, 1e-5 in lanes and 1e-12 in the twin.
#[test]
fn every_cut_of_every_material_gives_uniform_light_back() {
    let materials = &*materials::MATERIALS;
    for (number, name) in library::names().enumerate() {
        let design = library::design(name, &BTreeMap::new()).expect("in the library").expect("good");
        let stone = ConvexStone::new(design.solid().expect("closed"));
        let mut s = Stream::new(SEED, Purpose::TEST, 600 + number as u64);
        for material in materials {
            let index = material.index_d();
            let (mut packet, reflected) = entering(&stone, &mut s, index as f32);
            for polarised in [false, true] {
                // what is still held after so many bounces is counted as lost
                packet.polarised = polarised;
                let mut ray = twin_of(&packet, number % LANES);
                ray.index = index;
                let mut all = 1.0 - ray.power;
                all += reference::trace(&stone.planes, ray, 1e-13, |m| all += m.power);
                assert!((all - 1.0).abs() < 1e-12, "{name} of {}: {all}", material.name);
            }
            assert_energy(&stone, packet, reflected, 1e-6);
        }
    }
}
