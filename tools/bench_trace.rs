//! How fast the tracer is: `cargo bench --bench trace`. Every instruction set of this machine and the
//! `f64` twin on three brilliants; what a facet costs, from 20 to 505 of them; two threads beside
//! one. Run by `cargo test` it only shows that it runs.

#[path = "bench_rays.rs"]
mod shower;
#[path = "timing.rs"]
mod timing;

use cutlab::advanced::design::{families, library};
use cutlab::advanced::geometry::{Plane, Polyhedron};
use cutlab::advanced::sampling::{
    random::{Purpose, Stream},
    warps,
};
use cutlab::advanced::trace::lane_scheduler::{self, RayClient};
use cutlab::advanced::trace::{ConvexStone, Isa, LANES, Packet, reference};
use glam::{DVec3, Vec3};
use shower::{INDEX, STOP_POWER, Shower};
use std::collections::BTreeMap;
use std::error::Error;
use std::time::Instant;

/// Per trace unit, weak: rays live nearly as long as in a clear stone.
const ABSORPTION: f32 = 0.01;

fn main() -> Result<(), Box<dyn Error>> {
    let real = std::env::args().any(|a| a == "--bench");
    let (rays, runs) = if real { (50_000, 5) } else { (100, 1) };
    println!("{}; lanes {LANES}; an interaction is one ray with one facet", timing::machine());
    println!("processor time of one thread, shortest of {runs} runs");
    for flats in [16.0, 96.0, 448.0] {
        let solid = brilliant(&[("girdle-facets", flats)])?;
        println!("round brilliant, {} facets", solid.faces.len());
        for isa in Isa::all() {
            let stone = ConvexStone::with_isa(solid.clone(), isa);
            for (what, polarised, absorption) in
                [("", false, 0.0), (", Stokes", true, 0.0), (", Stokes, absorbing", true, ABSORPTION)]
            {
                let (seconds, bounces) =
                    timing::best_of(runs, || traced(&stone, rays, polarised, absorption));
                report(&format!("{}{what}", isa.name()), bounces, rays as f64, seconds);
            }
        }
        let stone = ConvexStone::new(solid);
        let (few, start) = (rays / 50, timing::thread_time());
        let bounces = twin_meetings(&stone, few);
        report("f64 twin", bounces, few as f64, (timing::thread_time() - start).as_secs_f64());
        first_hits(&stone, rays, runs);
    }
    println!("what a facet costs, {}", Isa::best().name());
    costs("cuts with girdles of more and more flats", &girdles()?, rays, runs);
    costs("planes about a sphere, hardly one of them upright", &spheres()?, rays, runs);
    two_threads(&ConvexStone::new(brilliant(&[])?), rays, runs);
    Ok(())
}

fn brilliant(overrides: &[(&str, f64)]) -> Result<Polyhedron, Box<dyn Error>> {
    let given: BTreeMap<_, _> = overrides.iter().map(|(k, v)| (k.to_string(), *v)).collect();
    Ok(families::build("round-brilliant", &given)?.solid()?)
}

/// Interactions of a shower, counted by the lane.
fn traced(stone: &ConvexStone, rays: u64, polarised: bool, absorption: f32) -> f64 {
    let mut shower = Shower::new(stone, rays, polarised);
    shower.absorption = absorption;
    lane_scheduler::trace_all(stone, STOP_POWER, &mut shower);
    shower.bounces as f64 * LANES as f64
}

fn twin_meetings(stone: &ConvexStone, rays: u64) -> f64 {
    let (mut shower, mut packet, mut bounces) = (Shower::new(stone, rays, false), Packet::default(), 0.0);
    while shower.load(&mut packet, 0) {
        let ray = reference::ScalarRay {
            point: packet.point(0).as_dvec3(),
            direction: packet.direction(0).as_dvec3(),
            power: packet.power[0].into(),
            index: INDEX.into(),
            absorption: 0.0,
            stokes: None,
        };
        reference::trace(&stone.planes, ray, STOP_POWER.into(), |_| bounces += 1.0);
    }
    bounces
}

fn report(name: &str, bounces: f64, rays: f64, seconds: f64) {
    let (m, r) = (bounces / seconds / 1e6, rays / seconds / 1e3);
    println!("  {name:>26}: {m:6.1} million interactions/s, {r:7.1} thousand rays/s");
}

/// Rays from outside that look for their first facet.
fn first_hits(stone: &ConvexStone, rays: u64, runs: usize) {
    let (seconds, hits) = timing::best_of(runs, || {
        let mut stream = Stream::new(1, Purpose::TEST, 1);
        let hits = (0..rays).filter(|_| {
            let toward: Vec3 = -warps::uniform_cone(stream.pair(), 0.5);
            let target = warps::uniform_disc(stream.pair()).extend(0.0);
            stone.intersect(target - 3.0 * toward, toward).is_some()
        });
        hits.count() as u64
    });
    let rate = rays as f64 / seconds / 1e6;
    println!(
        "  {:>16}: {rate:6.1} million rays/s, drawn and tried ({}% hit)",
        "first hit",
        100 * hits / rays.max(1)
    );
}

/// Cuts from the icosahedron to a brilliant whose girdle has 448 flats.
fn girdles() -> Result<Vec<ConvexStone>, Box<dyn Error>> {
    let mut stones = Vec::new();
    for name in ["icosahedron", "swiss-cut"] {
        let design = library::design(name, &BTreeMap::new()).ok_or("not in the library")??;
        stones.push(ConvexStone::new(design.solid()?));
    }
    for flats in [16.0, 96.0, 240.0, 448.0] {
        stones.push(ConvexStone::new(brilliant(&[("girdle-facets", flats)])?));
    }
    Ok(stones)
}

/// Stones of many slopes: planes at unit distance whose normals wind about the axis by the golden
/// angle.
fn spheres() -> Result<Vec<ConvexStone>, Box<dyn Error>> {
    let golden = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    let sphere = |count: usize| {
        let normal = |i: usize| {
            let z = 1.0 - (2 * i + 1) as f64 / count as f64;
            let (r, turn) = ((1.0 - z * z).sqrt(), golden * i as f64);
            DVec3::new(r * turn.cos(), r * turn.sin(), z)
        };
        let planes: Vec<_> = (0..count).map(|i| Plane::new(normal(i), 1.0)).collect();
        Polyhedron::from_planes(&planes).map(ConvexStone::new)
    };
    Ok([20, 58, 74, 154, 300, 506].into_iter().map(sphere).collect::<Result<_, _>>()?)
}

/// Nanoseconds an interaction: linear growth keeps the last column from rising.
fn costs(title: &str, stones: &[ConvexStone], rays: u64, runs: usize) {
    println!("  {title}");
    for stone in stones {
        let (seconds, bounces) = timing::best_of(runs, || traced(stone, rays, false, 0.0));
        let (ns, facets) = (seconds / bounces * 1e9, stone.facet_count());
        println!("    {facets:3} facets: {ns:6.1} ns an interaction, {:.3} ns a facet", ns / facets as f64);
    }
}

/// Two threads beside one: by the clock, and by the time the threads have had, which does not count
/// other programs.
fn two_threads(stone: &ConvexStone, rays: u64, runs: usize) {
    let rates = |threads: usize| {
        let start = Instant::now();
        let had: Vec<(f64, f64)> = std::thread::scope(|scope| {
            let work = || timing::best_of(1, || traced(stone, 2 * rays, false, 0.0));
            let started: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
            started.into_iter().filter_map(|thread| thread.join().ok()).collect()
        });
        let bounces: f64 = had.iter().map(|(_, m)| m).sum();
        [bounces / start.elapsed().as_secs_f64(), had.iter().map(|(s, m)| m / s).sum()]
    };
    let best =
        |threads| (0..runs).map(|_| rates(threads)).fold([0f64; 2], |a, b| [a[0].max(b[0]), a[1].max(b[1])]);
    let (one, two) = (best(1), best(2));
    println!(
        "two threads beside one: {:.2} times by the clock, {:.2} times by processor time",
        two[0] / one[0],
        two[1] / one[1]
    );
}
