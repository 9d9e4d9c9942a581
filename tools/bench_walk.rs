//! How fast the walk is: `cargo bench --bench walk`. One thread, every instruction set of this
//! machine, and the `f64` twin; run by `cargo test` it only shows that it runs.

use cutlab::cut::families;
use cutlab::math::{
    random::{Purpose, Stream},
    sample,
};
use cutlab::walk::feed::{self, Rays};
use cutlab::walk::{Isa, LANES, Meeting, Packet, Stone, scalar};
use glam::Vec3;
use std::collections::BTreeMap;
use std::error::Error;
use std::time::Instant;

const SEED: u64 = 1;
const INDEX: f32 = 2.417;
/// Per walking unit, weak: rays live nearly as long as in a clear stone.
const ABSORPTION: f32 = 0.01;
const STOP_POWER: f32 = 1e-4;

/// Vertical and slanting rays on a stone, counted.
struct Shower<'a> {
    stone: &'a Stone,
    stream: Stream,
    left: u64,
    meetings: u64,
    polarised: bool,
    absorbing: bool,
}

impl Rays for Shower<'_> {
    const WIDTH: usize = 1;

    fn polarised(&self) -> bool {
        self.polarised
    }

    fn absorbing(&self) -> bool {
        self.absorbing
    }

    fn next(&mut self, packet: &mut Packet, lane: usize) -> bool {
        while self.left > 0 {
            self.left -= 1;
            let toward = -sample::cone(self.stream.pair(), 0.5);
            let target = sample::disc(self.stream.pair()).extend(0.0) * 0.9;
            if let Some(hit) = self.stone.hit(target - 3.0 * toward, toward) {
                let entry = self.stone.enter(hit.facet, toward, INDEX);
                let point = target + (hit.distance - 3.0) * toward;
                packet.enter(lane, point, &entry, INDEX);
                packet.absorption[lane] = ABSORPTION;
                return true;
            }
        }
        false
    }

    fn meet(&mut self, _meeting: &Meeting, _packet: &Packet) {
        self.meetings += 1;
    }
}

fn cpu() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = info.lines().find_map(|l| l.strip_prefix("model name")).unwrap_or(": not known");
    name.trim_start_matches([':', ' ', '\t']).to_owned()
}

fn main() -> Result<(), Box<dyn Error>> {
    let rays = if std::env::args().any(|a| a == "--bench") { 100_000 } else { 100 };
    println!("cpu: {}; one thread; lanes {LANES}; a meeting is one ray with one facet", cpu());
    for flats in [16.0, 96.0, 448.0] {
        let given = BTreeMap::from([("girdle-facets".to_string(), flats)]);
        let solid = families::build("round-brilliant", &given)?.solid()?;
        println!("round brilliant, {} facets", solid.faces.len());
        for isa in Isa::all() {
            let stone = Stone::with_isa(solid.clone(), isa);
            for (what, polarised, absorbing) in
                [("", false, false), (", Stokes", true, false), (", Stokes, absorbing", true, true)]
            {
                let stream = Stream::new(SEED, Purpose::Test, 0);
                let mut shower =
                    Shower { stone: &stone, stream, left: rays, meetings: 0, polarised, absorbing };
                let start = Instant::now();
                feed::walk_all(&stone, STOP_POWER, &mut shower);
                let seconds = start.elapsed().as_secs_f64();
                let meetings = shower.meetings as f64 * LANES as f64;
                let name = format!("{}{what}", isa.name());
                report(&name, meetings, rays as f64, stone.facet_count(), seconds);
            }
        }
        let stone = Stone::new(solid);
        let start = Instant::now();
        let (few, mut meetings) = (rays / 50, 0.0);
        let mut shower = Shower {
            stone: &stone,
            stream: Stream::new(SEED, Purpose::Test, 0),
            left: few,
            meetings: 0,
            polarised: false,
            absorbing: false,
        };
        let mut packet = Packet::default();
        while shower.next(&mut packet, 0) {
            let ray = scalar::Ray {
                point: packet.point(0).as_dvec3(),
                direction: packet.direction(0).as_dvec3(),
                power: packet.power[0].into(),
                index: INDEX.into(),
                absorption: 0.0,
                stokes: None,
            };
            scalar::walk(&stone.planes, ray, STOP_POWER.into(), |_| meetings += 1.0);
        }
        report("f64 twin", meetings, few as f64, stone.facet_count(), start.elapsed().as_secs_f64());
        first_hits(&stone, rays);
    }
    Ok(())
}

fn report(name: &str, meetings: f64, rays: f64, facets: usize, seconds: f64) {
    println!(
        "  {name:>26}: {:7.2} million meetings/s, {:5.2}e9 facet tests/s, {:7.1} thousand rays/s",
        meetings / seconds / 1e6,
        meetings * facets as f64 / seconds / 1e9,
        rays / seconds / 1e3
    );
}

/// Rays from outside that look for their first facet.
fn first_hits(stone: &Stone, rays: u64) {
    let mut stream = Stream::new(SEED, Purpose::Test, 1);
    let start = Instant::now();
    let mut hits = 0;
    for _ in 0..rays {
        let toward: Vec3 = -sample::cone(stream.pair(), 0.5);
        let target = sample::disc(stream.pair()).extend(0.0);
        hits += u64::from(stone.hit(target - 3.0 * toward, toward).is_some());
    }
    let rate = rays as f64 / start.elapsed().as_secs_f64() / 1e6;
    println!("  first hit: {rate:7.2} million rays/s ({}% hit)", 100 * hits / rays.max(1));
}
