//! `cost`: what a candidate costs on one thread, from values of the variables to its outcome, as `cutlab optimise`
//! has it computed: settings applied, meets solved again, the solid, the guards, ISO face-up to ± 0.5 points.

use super::subjects::{corpus, ends, median, objectives, problem};
use super::timing;
use cutlab::advanced::sampling::random::{Purpose, Stream};
use cutlab::advanced::scoring::Effort;
use cutlab::advanced::search::Evaluate;
use cutlab::{OptimiseRequest, Stone, Variable};
use std::error::Error;

/// The most that ISO may be off, times its scale of 100 points.
const ERROR: f64 = 5e-3;

/// Candidates of a design.
const CANDIDATES: u64 = 200;

/// Designs of the corpus: of twelve tiers the one with the fewest and one of those with the most facets, and the
/// design with the most tiers.
const DESIGNS: [&str; 3] = ["PC16030.ASC", "PC01746.ASC", "PC44048A.ASC"];

/// Variables: those that there are if none is named, and every angle of crown and pavilion.
const VARY: [(&str, &[&str]); 2] =
    [("two tangent ratios", &[]), ("all angles ± 2°", &["P*.angle", "C*.angle"])];

/// Measures each design with each set of variables.
pub fn run(arguments: &[String]) -> Result<(), Box<dyn Error>> {
    let corpus = corpus(arguments)?;
    println!(
        "{}; one thread, processor time in ms, of each candidate the shorter of two runs",
        timing::machine()
    );
    println!();
    println!("| design | tiers | facets | variables | candidates | with a score | median | worst |");
    println!("|---|--:|--:|---|--:|--:|--:|--:|");
    // all parallel loops of this thread are on it alone
    let _pool = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build()?;
    for name in DESIGNS {
        let stone = Stone::parse(format!("{corpus}/gemcad/{name}"))?;
        for (words, vary) in VARY {
            measure(name, &stone, words, vary)?;
        }
    }
    Ok(())
}

fn measure(name: &str, stone: &Stone, words: &str, vary: &[&str]) -> Result<(), Box<dyn Error>> {
    let vary: Vec<Variable> = vary.iter().map(|text| text.parse()).collect::<Result<_, _>>()?;
    let mut request = OptimiseRequest::new(objectives(&["iso"])?).vary(vary);
    request.effort = Effort::default().error(ERROR);
    let optimisation = request.prepared(stone)?;
    let problem = problem(&optimisation, 1)?;
    let candidates = optimisation.candidates(&());
    let (mut times, mut scored) = (Vec::new(), 0);
    for number in 0..CANDIDATES {
        let mut stream = Stream::new(1, Purpose::TEST, number);
        let unit: Vec<f64> = optimisation.degrees.iter().map(|_| stream.unit64()).collect();
        let mut values = problem.from_unit(&unit);
        if !request.vary.is_empty() {
            // a usual range of an angle is ± 5°: with dozens of them hardly a stone would be left
            let near = values.iter().zip(&optimisation.degrees).map(|(v, d)| d.start + 0.4 * (v - d.start));
            values = near.collect();
        }
        let (time, outcome) = timing::best_of(2, || candidates.evaluate(std::slice::from_ref(&values)));
        times.push(1e3 * time);
        scored += u32::from(outcome.iter().any(|o| !o.objectives.is_empty()));
    }
    println!(
        "| {name} | {} | {} | {words} ({}) | {CANDIDATES} | {scored} | {:.3} | {:.3} |",
        stone.design().map_or(0, |design| design.tiers.len()),
        stone.facets(),
        optimisation.degrees.len(),
        median(&times),
        ends(times.iter().copied()).1
    );
    Ok(())
}
