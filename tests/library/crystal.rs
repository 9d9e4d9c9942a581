//! Crystals: closed forms, energy, reversibility, and whole stones by both branches.

use crate::brilliants;
use cutlab::advanced::geometry::Plane;
use cutlab::advanced::optics::crystal::Uniaxial;
use cutlab::advanced::optics::crystal::facet::Crystal;
use cutlab::advanced::trace::crystal::{CrystalInteraction, CrystalOptics, CrystalRay};
use cutlab::advanced::trace::{ConvexStone, CrystalLanes, LANES, LoadedWave, Packet};
use glam::{DMat3, DVec3};

/// A crystal with its axis along a vector.
fn uniaxial(ordinary: f64, extraordinary: f64, axis: DVec3) -> CrystalOptics {
    let crystal = Crystal::Uniaxial(Uniaxial { ordinary, extraordinary, axis: axis.normalize() });
    CrystalOptics { crystal, absorption: DMat3::ZERO }
}

/// Numbers from 0 to 1 without gaps: the additive recurrence of the plastic number in three dimensions.
fn spread(i: u32) -> [f64; 3] {
    const STEPS: [f64; 3] = [0.819_172_513_396_164_4, 0.671_043_606_703_789_3, 0.549_700_477_901_960_3];
    STEPS.map(|step| (0.5 + step * f64::from(i)).fract())
}

/// The reference brilliant.
fn reference() -> ConvexStone {
    const PROPORTIONS: [(&str, f64); 6] = [
        ("table", 56.0),
        ("crown-angle", 34.0),
        ("pavilion-angle", 40.5),
        ("star", 50.0),
        ("lower-half", 75.0),
        ("girdle", 3.0),
    ];
    brilliants::stone(&brilliants::design(&PROPORTIONS))
}

/// Where a vertical line of sight meets a stone, and whether it does.
fn top(planes: &[Plane], x: f64, y: f64) -> Option<(usize, DVec3)> {
    let height = |p: &Plane| (p.distance - p.normal.x * x - p.normal.y * y) / p.normal.z;
    let upper = planes.iter().enumerate().filter(|(_, p)| p.normal.z > 1e-9);
    let (facet, z) = upper.map(|(i, p)| (i, height(p))).min_by(|a, b| a.1.total_cmp(&b.1))?;
    let lower = planes.iter().filter(|p| p.normal.z < -1e-9).map(height).fold(f64::NEG_INFINITY, f64::max);
    let inside = planes
        .iter()
        .filter(|p| p.normal.z.abs() <= 1e-9)
        .all(|p| p.normal.x * x + p.normal.y * y <= p.distance);
    (inside && z > lower).then(|| (facet, DVec3::new(x, y, z)))
}

/// Shares of the light on the outline of the reference brilliant in a vertical view: reflected; up: green, red, blue; down.
fn view(optics: &CrystalOptics, rays: u32, by_tree: bool) -> [f64; 6] {
    let stone = reference();
    let (mut sums, mut count) = ([0.0; 6], 0.0);
    for i in 0..rays {
        let [u, v, choice] = spread(i);
        let Some((facet, point)) = top(&stone.planes, 2.0 * u - 1.0, 2.0 * v - 1.0) else { continue };
        count += 1.0;
        let entered = optics.enter(point, -DVec3::Z, stone.planes[facet].normal);
        sums[0] += 1.0 - entered[0].power - entered[1].power;
        let visit = |exit: &CrystalInteraction| {
            let z = exit.direction.z;
            let band = if z <= 0.0 {
                5
            } else if z < 45f64.to_radians().cos() {
                2
            } else if z < 15f64.to_radians().cos() {
                3
            } else {
                4
            };
            sums[band] += exit.power;
            if z > 0.0 {
                sums[1] += exit.power;
            }
        };
        if by_tree {
            optics.trace_tree(&stone.planes, entered, 1e-3, visit);
        } else {
            optics.trace_walk(&stone.planes, entered, choice, 1e-5, visit);
        }
    }
    sums.map(|sum| sum / count)
}

#[test]
#[ignore]
fn whole_stones() {
    for (name, o, e, axis) in [
        ("moissanite", 2.64743, 2.68897, DVec3::Z),
        ("zircon", 1.925, 1.984, DVec3::new(1.0, 0.0, 1.0)),
        ("calcite", 1.65835, 1.4864, DVec3::Z),
        ("corundum", 1.76808, 1.76, DVec3::X),
        ("rutile", 2.61291, 2.90865, DVec3::X),
    ] {
        let optics = uniaxial(o, e, axis);
        for by_tree in [false] {
            let t = std::time::Instant::now();
            println!("{name} {by_tree} {:.5?} {:?}", view(&optics, 300_000, by_tree), t.elapsed());
        }
    }
}

/// Rays that enter the reference brilliant from above, loaded into packets.
fn packets(o: f64, e: f64, axis: DVec3, seed: u32) -> (ConvexStone, CrystalOptics, Packet) {
    let stone = reference();
    let optics = uniaxial(o, e, axis);
    let mut packet =
        Packet { waves: Some(Box::new(CrystalLanes::new(axis.normalize()))), ..Packet::default() };
    let (mut lane, mut i) = (0, 1000 * seed);
    while lane < LANES {
        i += 1;
        let [u, v, choice] = spread(i);
        let Some((facet, point)) = top(&stone.planes, 2.0 * u - 1.0, 2.0 * v - 1.0) else { continue };
        let rays = optics.enter(point, -DVec3::Z, stone.planes[facet].normal);
        let power = rays[0].power + rays[1].power;
        let mode = usize::from(choice * power >= rays[0].power);
        let wave = LoadedWave {
            wave_vector: rays[mode].wave.k.re.as_vec3(),
            is_extraordinary: mode == 1,
            indices: [o as f32, e as f32],
            choice: choice as f32,
        };
        packet.load_wave(lane, point.as_vec3(), rays[mode].wave.ray.as_vec3(), power as f32, &wave);
        lane += 1;
    }
    (stone, optics, packet)
}

#[test]
fn lanes_agree_with_the_twin_at_every_meeting() {
    let mut compared = 0;
    let mut errors = Vec::new();
    for (o, e, axis) in [
        (1.544, 1.553, DVec3::new(0.3, 0.5, 1.0)),
        (1.925, 1.984, DVec3::X),
        (1.65835, 1.4864, DVec3::new(1.0, 0.2, 0.4)),
        (2.64743, 2.68897, DVec3::Z),
    ] {
        for seed in 0..8 {
            let (stone, optics, mut packet) = packets(o, e, axis, seed);
            let planes = stone.kernel_planes();
            let mut before = packet.clone();
            stone.trace(&mut packet, 1e-3, |met, after| {
                for lane in 0..LANES {
                    if before.power[lane] < 1e-3 {
                        continue;
                    }
                    let (was, is) = (before.waves.as_ref().unwrap(), after.waves.as_ref().unwrap());
                    let k = was.wave_vector(lane).as_dvec3();
                    let mode = usize::from(was.mode[lane] > 0.5);
                    let Crystal::Uniaxial(crystal) = optics.crystal else { unreachable!() };
                    let ray = CrystalRay {
                        point: before.point(lane).as_dvec3(),
                        wave: crystal.wave_along(k, mode),
                        mode,
                        power: before.power[lane].into(),
                    };
                    let Some(twin) = optics.interact(&planes, &ray) else { continue };
                    if twin.facet != met.facet[lane] as usize {
                        continue; // on an edge
                    }
                    compared += 1;
                    let new = usize::from(is.mode[lane] > 0.5);
                    let kept = twin.reflected[0].power + twin.reflected[1].power;
                    errors.push(
                        ((f64::from(after.power[lane]) - kept).abs() / ray.power)
                            .max((after.direction(lane).as_dvec3() - twin.reflected[new].wave.ray).length()),
                    );
                }
                before = after.clone();
            });
        }
    }
    errors.sort_by(f64::total_cmp);
    let at = |share: f64| errors[((errors.len() - 1) as f64 * share) as usize];
    println!(
        "{compared}: median {:e}, 99 % {:e}, 99.9 % {:e}, most {:e}",
        at(0.5),
        at(0.99),
        at(0.999),
        at(1.0)
    );
    assert!(compared > 5000 && at(0.99) < 1e-5 && at(1.0) < 2e-3);
}

#[test]
#[ignore]
fn speed_of_lanes() {
    let made: Vec<_> = (0..50).map(|seed| packets(1.544, 1.553, DVec3::new(0.3, 0.5, 1.0), seed)).collect();
    for crystal in [false, true, false, true] {
        let (mut meetings, begun) = (0u64, std::time::Instant::now());
        for _ in 0..20 {
            for (stone, _, packet) in &made {
                let mut packet = packet.clone();
                if !crystal {
                    packet.waves = None;
                    packet.polarised = true;
                }
                stone.trace(&mut packet, 1e-4, |_, p| {
                    meetings += p.power.iter().filter(|x| **x > 0.0).count() as u64;
                });
            }
        }
        let seconds = begun.elapsed().as_secs_f64();
        println!("{crystal} {meetings} meetings, {:.2} M/s", meetings as f64 / seconds * 1e-6);
    }
}
