//! The tracer allocates nothing: lanes, search, twin, and stones that are not convex.

use cutlab::advanced::design::families;
use cutlab::advanced::sampling::random::{Purpose, Stream};
use cutlab::advanced::trace::lane_scheduler::{self, RayClient};
use cutlab::advanced::trace::nonconvex::{MeshStone, Side};
use cutlab::advanced::trace::{ConvexStone, Interaction, Isa, LANES, Packet, reference};
use glam::{Vec2, Vec3};
use std::collections::BTreeMap;

const INDEX: f32 = 2.417;

fn brilliant(isa: Isa) -> ConvexStone {
    let design = families::build("round-brilliant", &BTreeMap::new()).expect("builds");
    ConvexStone::with_isa(design.solid().expect("closed"), isa)
}

/// Vertical rays on a stone.
struct Rain<'a> {
    stone: &'a ConvexStone,
    stream: Stream,
    left: u32,
    power: f32,
}

impl RayClient for Rain<'_> {
    const WIDTH: usize = 1;

    fn polarised(&self) -> bool {
        true
    }

    fn load(&mut self, packet: &mut Packet, lane: usize) -> bool {
        while self.left > 0 {
            self.left -= 1;
            let target = (Vec2::from(self.stream.pair()) - 0.5).extend(2.0);
            if let Some(hit) = self.stone.intersect(target, Vec3::NEG_Z) {
                let entry = self.stone.refract_into(hit.facet, Vec3::NEG_Z, INDEX);
                packet.load_refracted(lane, target - Vec3::Z * hit.distance, &entry, INDEX);
                return true;
            }
        }
        false
    }

    fn interact(&mut self, interaction: &Interaction, _: &Packet) {
        self.power += interaction.power.iter().sum::<f32>();
    }
}

fn allocations(work: impl FnOnce()) -> u64 {
    allocation_counter::measure(work).count_total
}

#[test]
fn the_count_sees_an_allocation() {
    assert!(allocations(|| drop(std::hint::black_box(vec![1u8; 100]))) > 0);
}

#[test]
fn lanes_allocate_nothing() {
    for isa in Isa::all() {
        let stone = brilliant(isa);
        let stream = Stream::new(1, Purpose::TEST, 0);
        let mut rain = Rain { stone: &stone, stream, left: 5_000, power: 0.0 };
        let count = allocations(|| {
            lane_scheduler::trace_all(&stone, 1e-4, &mut rain);
        });
        assert!(rain.power > 1_000.0, "{}", rain.power);
        assert_eq!(count, 0, "{}", isa.name());
    }
}

#[test]
fn twin_and_nonconvex_stones_allocate_nothing() {
    let stone = brilliant(Isa::best());
    let mesh = MeshStone::new(&stone.solid.triangulate()).expect("closed");
    let mut stream = Stream::new(1, Purpose::TEST, 1);
    let (mut packet, mut bounces) = (Packet::default(), 0);
    let mut rain =
        Rain { stone: &stone, stream: Stream::new(1, Purpose::TEST, 0), left: LANES as u32, power: 0.0 };
    let count = allocations(|| {
        while rain.load(&mut packet, 0) {
            let ray = reference::ScalarRay {
                point: packet.point(0).as_dvec3(),
                direction: packet.direction(0).as_dvec3(),
                power: packet.power[0].into(),
                index: INDEX.into(),
                absorption: 0.0,
                stokes: None,
            };
            reference::trace(&stone.planes, ray, 1e-4, |_| bounces += 1);
            mesh.trace(ray, Side::Inside, 1e-4, &mut stream, |_, _| bounces += 1);
        }
    });
    assert!(bounces > 100);
    assert_eq!(count, 0);
}
