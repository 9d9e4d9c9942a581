//! How fast the next facet is found: `cargo bench --bench query`. One thread, every instruction set
//! of this machine; beside it Embree's robust single-ray query on the same rays, where its headers
//! and a C++ compiler are installed (Debian: `libembree-dev g++`). Run by `cargo test` it only shows
//! that it runs.

#[path = "bench_rays.rs"]
mod shower;
#[path = "timing.rs"]
mod timing;

use cutlab::advanced::design::families;
use cutlab::advanced::trace::{ConvexStone, Isa, LANES, Packet, lane_scheduler, reference};
use shower::{STOP_POWER, Shower};
use std::collections::BTreeMap;
use std::error::Error;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Packets asked in turn: 16,384 rays.
const PACKETS: usize = 1024;

fn main() -> Result<(), Box<dyn Error>> {
    let real = std::env::args().any(|a| a == "--bench");
    let (packets, runs) = if real { (PACKETS, 200) } else { (4, 1) };
    println!("{}; one thread; shortest of {runs} runs, processor time", timing::machine());
    for flats in [16.0, 96.0, 448.0] {
        let given = BTreeMap::from([("girdle-facets".to_string(), flats)]);
        let solid = families::build("round-brilliant", &given)?.solid()?;
        println!(
            "round brilliant, {} facets, {} rays that have just left a facet",
            solid.faces.len(),
            packets * LANES
        );
        let mut rates = Vec::new();
        let stone = ConvexStone::new(solid.clone());
        let rays = rays_inside(&stone, packets);
        for isa in Isa::all() {
            let stone = ConvexStone::with_isa(solid.clone(), isa);
            let (seconds, ()) = timing::best_of(runs, || {
                for packet in &rays {
                    black_box(stone.next_facets(black_box(packet)));
                }
            });
            rates.push((isa.name(), (rays.len() * LANES) as f64 / seconds / 1e6));
        }
        let embree = if real { beside_embree(&stone, &rays)? } else { None };
        for (name, rate) in rates {
            print!("  {name:>9}: {rate:6.1} million queries/s");
            println!("{}", embree.map_or(String::new(), |e| format!(", {:.1} times Embree", rate / e)));
        }
        let one = rays.len().div_ceil(16);
        let (seconds, ()) = timing::best_of(3, || {
            for packet in &rays[..one] {
                for lane in 0..LANES {
                    let (point, direction) =
                        (packet.point(lane).as_dvec3(), packet.direction(lane).as_dvec3());
                    black_box(reference::next_facet(&stone.planes, point, direction));
                }
            }
        });
        println!("  {:>9}: {:6.1} million queries/s", "f64 twin", (one * LANES) as f64 / seconds / 1e6);
    }
    Ok(())
}

/// Packets of a trace, every lane of them alive, as they leave the facets they met.
fn rays_inside(stone: &ConvexStone, packets: usize) -> Vec<Packet> {
    let mut shower = Shower::new(stone, 100 * packets as u64, false);
    shower.kept.reserve_exact(packets);
    lane_scheduler::trace_all(stone, STOP_POWER, &mut shower);
    shower.kept
}

/// Embree's rate in millions a second on the stone's triangles and the same rays; none if it cannot
/// be built here.
fn beside_embree(stone: &ConvexStone, rays: &[Packet]) -> Result<Option<f64>, Box<dyn Error>> {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    let (program, scene) = (folder.join("embree_query"), folder.join("embree_query.bin"));
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tools/embree_query.cpp");
    let compiled = Command::new("c++")
        .args(["-O3", "-march=native", "-o"])
        .args([&program, &source])
        .arg("-lembree3")
        .output()
        .is_ok_and(|o| o.status.success());
    if !compiled {
        println!("  Embree: not installed here, no comparison");
        return Ok(None);
    }
    std::fs::write(&scene, scene_bytes(stone, rays))?;
    let output = Command::new(&program).arg(&scene).output()?;
    let text = String::from_utf8(output.stdout)?;
    print!("{text}");
    let rate = text.split_whitespace().find_map(|word| word.parse().ok());
    Ok(Some(rate.ok_or("Embree's program printed no rate")?))
}

/// Counts, then corners, triangles, their facets, rays (point, direction) and the facets we find.
fn scene_bytes(stone: &ConvexStone, rays: &[Packet]) -> Vec<u8> {
    let mesh = stone.solid.triangulate();
    let mut numbers: Vec<u32> =
        [mesh.vertices.len(), mesh.triangles.len(), rays.len() * LANES].map(|n| n as u32).into();
    let bits = |v: glam::Vec3| v.to_array().map(f32::to_bits);
    numbers.extend(mesh.vertices.iter().flat_map(|v| bits(stone.point_from_design(*v).as_vec3())));
    numbers.extend(mesh.triangles.iter().flatten().map(|c| *c as u32));
    numbers.extend(mesh.faces.iter().map(|f| *f as u32));
    let lanes = || rays.iter().flat_map(|packet| (0..LANES).map(move |lane| (packet, lane)));
    numbers.extend(lanes().flat_map(|(p, l)| [bits(p.point(l)), bits(p.direction(l))]).flatten());
    numbers.extend(rays.iter().flat_map(|packet| stone.next_facets(packet).facet));
    numbers.into_iter().flat_map(u32::to_le_bytes).collect()
}
