//! What a candidate of a search costs on one thread: `cargo bench --bench candidates`. Planes to a solid, a solid
//! to beams, and ISO face-up to ± 0.5, ± 0.1 points and to rounding, of three designs; STONEs after `--` take
//! their place. Run by `cargo test` it only shows that it runs.

mod timing;

use cutlab::advanced::scoring::{Effort, Evaluator, Objective};
use cutlab::advanced::trace::ConvexStone;
use cutlab::advanced::trace::beams::Beams;
use cutlab::{Plane, Polyhedron, Stone};
use std::error::Error;
use timing::best_of;

/// Designs of the corpus: twelve tiers with few facets and with many, and the one with the most tiers.
const OF_THE_CORPUS: [&str; 3] = ["PC16030.ASC", "PC01746.ASC", "PC44048A.ASC"];

/// Cuts of the library, where there is no corpus.
const OF_THE_LIBRARY: [&str; 3] = ["single-cut", "tolkowsky", "emerald"];

fn main() -> Result<(), Box<dyn Error>> {
    let real = std::env::args().any(|a| a == "--bench");
    let runs = if real { 50 } else { 1 };
    rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build_global()?;
    println!("{}; one thread; shortest of {runs} runs, processor time in ms", timing::machine());
    println!(
        "| design | tiers | facets | meets | solid | beams | ISO ± 0.5 | ± 0.1 | to rounding | whole, ± 0.5 |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    let asked: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let stones = match (asked.is_empty(), std::env::var("CUTLAB_CORPUS")) {
        (false, _) => asked,
        (true, Ok(corpus)) => OF_THE_CORPUS.map(|name| format!("{corpus}/gemcad/{name}")).to_vec(),
        (true, Err(_)) => OF_THE_LIBRARY.map(str::to_owned).to_vec(),
    };
    for name in stones {
        candidate(&name, runs)?;
    }
    Ok(())
}

fn candidate(name: &str, runs: usize) -> Result<(), Box<dyn Error>> {
    let stone = Stone::parse(name)?;
    let (Some(design), Some(start)) = (stone.design(), stone.solid()) else {
        return Err(format!("{name}: not convex").into());
    };
    let planes: Vec<Plane> = design.facets().map(|f| f.plane).collect();
    // the design's tiers with their meets solved again: nothing yet, the planes are the design's own
    let (meets, planes) = best_of(runs, || planes.clone());
    let (solid, made) = best_of(runs, || Polyhedron::from_planes(&planes));
    let made = made?;
    let (beams, _) = best_of(runs, || _ = Beams::by_symmetry(&ConvexStone::new(made.clone())));
    let mut scores = Vec::new();
    for (error, runs) in [(5e-3, runs), (1e-3, runs), (1e-12, runs.div_ceil(10))] {
        let objective = vec![Objective::maximise("iso".parse()?)];
        let effort = Effort::default().error(error);
        let evaluator = Evaluator::new(objective, Vec::new(), stone.material(), effort, start)?;
        let (time, values) = best_of(runs, || evaluator.values(&made));
        scores.push((time, values?.objectives[0]));
    }
    let ms = |time: f64| format!("{:.3}", 1e3 * time);
    let score = |(time, iso): &(f64, cutlab::Estimate)| format!("{} ({iso})", ms(*time));
    println!(
        "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |",
        design.name,
        design.tiers.len(),
        made.faces.len(),
        ms(meets),
        ms(solid),
        ms(beams),
        score(&scores[0]),
        score(&scores[1]),
        score(&scores[2]),
        ms(meets + solid + scores[0].0)
    );
    Ok(())
}
