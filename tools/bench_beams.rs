//! How fast beams are: `cargo bench --bench beams`. Light not followed against time, from many
//! directions and face-up and tilted by 30°; and the error of beams with photons beside photons
//! alone, against time. One thread. Run by `cargo test` it only shows that it runs.

mod timing;

use cutlab::advanced::design::families;
use cutlab::advanced::estimators::{
    BatchedEstimate, TraceOptics, View, beam_view, view, weighted_exits::BeamEffort,
};
use cutlab::advanced::materials::Material;
use cutlab::advanced::optics::stokes::Stokes;
use cutlab::advanced::trace::beams::{
    BeamExit, BeamLight, BeamVisitor, Beams, EnergyBudget, IncidentBeam, StopCriteria, UnpolarisedLight,
};
use cutlab::advanced::trace::{ConvexStone, Isa};
use glam::{DMat3, DVec3};
use std::collections::BTreeMap;
use std::error::Error;
use timing::best_of;

/// The light not followed that the timings of many directions are for.
const LEFT: f64 = 0.025;

/// The sum that every score begins with.
struct Up(f64);

impl<L> BeamVisitor<L, 1> for Up {
    fn exit(&mut self, exit: &BeamExit<L, 1>) {
        self.0 += if exit.direction.z > 0.0 { exit.power } else { 0.0 };
    }
}

fn follow<L: BeamLight>(beams: &Beams, lit: &IncidentBeam<1>, light: L, until: StopCriteria) -> EnergyBudget {
    beams.trace(lit, light, until, &mut Up(0.0))
}

/// The power down to which beams must be followed so that [`LEFT`] is left, to a few per cent.
fn power_for(beams: &Beams, lit: &IncidentBeam<1>) -> f64 {
    let (mut low, mut high) = (1e-8f64.ln(), 1e-4f64.ln());
    for _ in 0..12 {
        let middle = 0.5 * (low + high);
        let totals = follow(beams, lit, UnpolarisedLight(1.0), StopCriteria::at_power(middle.exp()));
        if totals.not_followed > LEFT { high = middle } else { low = middle }
    }
    low.exp()
}

fn towards(tilt_deg: f64, azimuth_deg: f64) -> DVec3 {
    let (t, a) = (tilt_deg.to_radians(), azimuth_deg.to_radians());
    -DVec3::new(t.sin() * a.cos(), t.sin() * a.sin(), t.cos())
}

fn main() -> Result<(), Box<dyn Error>> {
    let real = std::env::args().any(|a| a == "--bench");
    let runs: usize = if real { 7 } else { 1 };
    rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build_global()?;
    let material = Material::by_name("diamond").ok_or("no diamond")?;
    println!("cpu: {}", timing::machine());
    println!("one thread, {}; shortest of {runs} runs, in its processor time", Isa::best().name());
    let design = families::build("round-brilliant", &BTreeMap::new())?;
    directions(&ConvexStone::new(design.solid()?), material, real, runs);
    for tilt in [0.0f64, 30.0] {
        let turn = DMat3::from_rotation_z(0.3) * DMat3::from_rotation_x(tilt.to_radians());
        let stone = ConvexStone::new(design.clone().turned(turn).solid()?);
        println!("\n{} facets, tilt {tilt}°", stone.facet_count());
        thresholds(&stone, material, real, runs);
        errors(&stone, material, real, runs)?;
    }
    Ok(())
}

/// What it takes to leave 2.5 %, from many directions.
fn directions(stone: &ConvexStone, material: &Material, real: bool, runs: usize) {
    let beams = Beams::new(stone);
    println!("\n{} facets, not followed {LEFT}", stone.facet_count());
    println!("| tilt | azimuth | down to | beams | ms | ns a beam | ms, strongest first | ms, polarised |");
    println!("|---|---|---|---|---|---|---|---|");
    let tilts = [0.0, 5.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0];
    for tilt in tilts.into_iter().take(if real { tilts.len() } else { 1 }) {
        for azimuth in [0.0, 7.0, 11.25, 20.0].into_iter().take(if tilt > 0.0 { 4 } else { 1 }) {
            let lit = IncidentBeam { direction: towards(tilt, azimuth), indices: [material.index_d()] };
            let until = StopCriteria::at_power(power_for(&beams, &lit));
            let (time, totals) = best_of(runs, || follow(&beams, &lit, UnpolarisedLight(1.0), until));
            let (first, _) = best_of(runs, || {
                follow(&beams, &lit, UnpolarisedLight(1.0), StopCriteria::at_residual(LEFT))
            });
            let stokes = Stokes::unpolarised(1.0, lit.direction.any_orthonormal_vector());
            let (polarised, _) = best_of(runs, || follow(&beams, &lit, stokes, until));
            println!(
                "| {tilt} | {azimuth} | {:.1e} | {} | {:.2} | {:.0} | {:.2} | {:.2} |",
                until.power,
                totals.beams,
                time * 1e3,
                time * 1e9 / totals.beams as f64,
                first * 1e3,
                polarised * 1e3
            );
        }
    }
}

/// Light not followed against time.
fn thresholds(stone: &ConvexStone, material: &Material, real: bool, runs: usize) {
    let beams = Beams::new(stone);
    let lit = IncidentBeam { direction: DVec3::NEG_Z, indices: [material.index_d()] };
    println!("| beams down to | ms | beams | not followed |\n|---|---|---|---|");
    let stops = [1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 3e-7, 1e-7];
    for stop in stops.into_iter().take(if real { stops.len() } else { 2 }) {
        let (time, t) =
            best_of(runs, || follow(&beams, &lit, UnpolarisedLight(1.0), StopCriteria::at_power(stop)));
        println!("| {stop:.0e} | {:.2} | {} | {:.3} % |", time * 1e3, t.beams, 100.0 * t.not_followed);
    }
}

/// Standard errors of the light that returns upward, beams + photons beside photons alone.
fn errors(stone: &ConvexStone, material: &Material, real: bool, runs: usize) -> Result<(), Box<dyn Error>> {
    let beams = Beams::new(stone);
    println!("\n| light that returns upward by | ms | value | standard error |\n|---|---|---|---|");
    let efforts = [(1e-4, 1024), (1e-4, 8192), (1e-5, 1024), (1e-5, 8192), (1e-5, 65_536), (1e-6, 65_536)];
    for (stop, photons) in efforts.into_iter().take(if real { efforts.len() } else { 1 }) {
        let effort =
            BeamEffort { stop: StopCriteria::at_power(stop), photons, seed: 1, ..BeamEffort::default() };
        let gaze = || beam_view::beam_view(&beams, DVec3::NEG_Z, material.index_d(), false, &effort);
        let (time, gaze) = best_of(runs, gaze);
        let (ms, up) = (time * 1e3, gaze?.up);
        println!("| beams to {stop:.0e}, {photons} photons | {ms:.2} | {:.6} | {:.1e} |", up.value, up.error);
    }
    let counts = [2048, 8192, 32_768, 131_072, 524_288];
    for samples in counts.into_iter().take(if real { counts.len() } else { 1 }) {
        let trace = || {
            let mut view =
                BatchedEstimate::new(View::new(stone, &TraceOptics { material, polarised: false })?, 1);
            view.extend_to(samples);
            Ok::<_, cutlab::advanced::estimators::EstimatorError>(
                view.estimate(|t| view::up(t) / t[view::RAYS]),
            )
        };
        let (time, up) = best_of(runs.min(3), trace);
        let up = up?;
        println!("| {samples} photons alone | {:.2} | {:.6} | {:.1e} |", time * 1e3, up.value, up.error);
    }
    Ok(())
}
