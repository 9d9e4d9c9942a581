//! How fast beams are: `cargo bench --bench beams`. Time and light not followed against the
//! threshold, for several directions; and the error of beams with photons beside photons alone, at
//! equal time. One thread. Run by `cargo test` it only shows that it runs.

use cutlab::cut::families;
use cutlab::experiments::exact::{self, Effort};
use cutlab::experiments::{Medium, Traced, View};
use cutlab::optics::Material;
use cutlab::walk::Stone;
use cutlab::walk::beams::{Beams, Exit, Lit, Scalar, Watch};
use glam::DVec3;
use std::collections::BTreeMap;
use std::error::Error;
use std::time::{Duration, Instant};

/// The sum that every score begins with.
struct Up(f64);

impl Watch<Scalar, 1> for Up {
    fn exit(&mut self, exit: &Exit<Scalar, 1>) {
        self.0 += if exit.direction.z > 0.0 { exit.power } else { 0.0 };
    }
}

fn cpu() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = info.lines().find_map(|l| l.strip_prefix("model name")).unwrap_or(": not known");
    name.trim_start_matches([':', ' ', '\t']).to_owned()
}

/// The shortest of several runs, and what the last one gave.
fn best_of<T>(runs: usize, mut work: impl FnMut() -> T) -> (Duration, T) {
    let timed = |work: &mut dyn FnMut() -> T| {
        let start = Instant::now();
        let result = work();
        (start.elapsed(), result)
    };
    let first = timed(&mut work);
    (1..runs).fold(first, |best, _| {
        let next = timed(&mut work);
        (best.0.min(next.0), next.1)
    })
}

fn main() -> Result<(), Box<dyn Error>> {
    let real = std::env::args().any(|a| a == "--bench");
    let runs: usize = if real { 20 } else { 1 };
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()?;
    let material = Material::named("diamond").ok_or("no diamond")?;
    let index = material.index_d();
    println!("cpu: {}; one thread; shortest of {runs} runs", cpu());
    for girdle in [16.0, 96.0, 448.0] {
        let given = BTreeMap::from([("girdle-facets".to_string(), girdle)]);
        let stone = Stone::new(families::build("round-brilliant", &given)?.solid()?);
        let beams = Beams::new(&stone);
        println!("round brilliant, {} facets", stone.facet_count());
        for (tilt, azimuth) in [(0.0f64, 0.0f64), (10.0, 10.0), (25.0, 33.0), (45.0, 71.0), (70.0, 20.0)] {
            let (t, a) = (tilt.to_radians(), azimuth.to_radians());
            let direction = -DVec3::new(t.sin() * a.cos(), t.sin() * a.sin(), t.cos());
            print!("  tilt {tilt:2.0}°:");
            for stop in [1e-4, 3e-5, 1e-5, 1e-6] {
                let lit = Lit { direction, indices: [index] };
                let follow = || beams.follow(&lit, Scalar(1.0), stop, &mut Up(0.0));
                let (time, totals) = best_of(if stop < 1e-5 { runs.div_ceil(4) } else { runs }, follow);
                let (ms, left) = (time.as_secs_f64() * 1e3, 100.0 * totals.not_followed);
                let each = time.as_secs_f64() * 1e9 / totals.beams as f64;
                print!("  {stop:.0e}: {ms:6.2} ms, {left:5.2} % left, {each:3.0} ns a beam;");
            }
            println!();
        }
    }
    errors(material, runs.div_ceil(4))
}

/// Standard errors of the light that returns upward, beams + photons beside photons alone.
fn errors(material: &Material, runs: usize) -> Result<(), Box<dyn Error>> {
    let stone = Stone::new(families::build("round-brilliant", &BTreeMap::new())?.solid()?);
    let beams = Beams::new(&stone);
    println!("light return upward, face-up, 153 facets: standard error against time");
    for (stop_power, photons) in
        [(1e-4, 2048), (1e-4, 16_384), (1e-5, 2048), (1e-5, 16_384), (1e-5, 131_072), (1e-6, 16_384)]
    {
        let effort = Effort { stop_power, photons, seed: 1 };
        let gaze = || exact::gaze(&stone, &beams, DVec3::NEG_Z, material.index_d(), &effort);
        let (time, gaze) = best_of(runs, gaze);
        let (ms, up) = (time.as_secs_f64() * 1e3, gaze?.up);
        println!(
            "  beams to {stop_power:.0e} + {photons:6} photons: {ms:7.2} ms, {:.6} ± {:.1e}",
            up.value, up.error
        );
    }
    for samples in [4096, 16_384, 65_536, 262_144] {
        let trace = || {
            let mut view = Traced::new(View::new(&stone, &Medium { material, polarised: false })?, 1);
            view.extend_to(samples);
            Ok::<_, cutlab::experiments::ExperimentError>(view.estimate(|t| (t.up(), t.rays)))
        };
        let (time, up) = best_of(runs, trace);
        let (ms, up) = (time.as_secs_f64() * 1e3, up?);
        println!("  photons alone, {samples:6}: {ms:7.2} ms, {:.6} ± {:.1e}", up.value, up.error);
    }
    Ok(())
}
