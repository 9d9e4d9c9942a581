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

/// Designs of the corpus: two of twelve tiers, with few facets and with many, and the one with the most tiers.
const DESIGNS: [&str; 3] = ["PC16030.ASC", "PC01746.ASC", "PC44048A.ASC"];

/// How the variables of a candidate are chosen.
#[derive(Clone, Copy, PartialEq)]
enum Vary {
    /// The two tangent ratios, both anywhere in their usual ranges.
    Ratios,
    /// The angle of one tier, each in its turn, by up to 2° either way.
    OneAngle,
}

/// What is measured of a candidate, in milliseconds.
#[derive(Default)]
struct Times {
    whole: Vec<f64>,
    edited: Vec<f64>,
    guarded: Vec<f64>,
    scored: Vec<f64>,
    /// Of candidates that have no score: what met cannot meet any more.
    refused: Vec<f64>,
}

/// Measures each design with each choice of variables.
pub fn run(arguments: &[String]) -> Result<(), Box<dyn Error>> {
    let corpus = corpus(arguments)?;
    println!("{}", timing::machine());
    println!("one thread, processor time in ms, of each candidate the shorter of two runs; median (worst)");
    println!();
    println!(
        "| design | tiers | facets | varies | candidate | settings, meets, solid | guards | ISO | refused |"
    );
    println!("|---|--:|--:|---|--:|--:|--:|--:|--:|");
    // all parallel loops of this thread are on it alone
    let _pool = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build()?;
    for name in DESIGNS {
        let stone = Stone::parse(format!("{corpus}/gemcad/{name}"))?;
        for vary in [Vary::Ratios, Vary::OneAngle] {
            let times = measure(&stone, vary)?;
            let words = if vary == Vary::Ratios { "two tangent ratios" } else { "one angle ± 2°" };
            let tiers = stone.design().map_or(0, |design| design.tiers.len());
            let cell = |times: &[f64]| match times.is_empty() {
                true => "–".to_owned(),
                false => format!("{:.3} ({:.3})", median(times), ends(times.iter().copied()).1),
            };
            println!(
                "| {name} | {tiers} | {} | {words} | {} | {} | {} | {} | {}: {} |",
                stone.facets(),
                cell(&times.whole),
                cell(&times.edited),
                cell(&times.guarded),
                cell(&times.scored),
                times.refused.len(),
                cell(&times.refused)
            );
        }
    }
    Ok(())
}

fn measure(stone: &Stone, vary: Vary) -> Result<Times, Box<dyn Error>> {
    let angles: Vec<Variable> = vec!["P*.angle".parse()?, "C*.angle".parse()?];
    let mut request = OptimiseRequest::new(objectives(&["iso"])?);
    if vary == Vary::OneAngle {
        request = request.vary(angles);
    }
    request.effort = Effort::default().error(ERROR);
    let optimisation = request.prepared(stone)?;
    let problem = problem(&optimisation, 1)?;
    let candidates = optimisation.candidates(&());
    let mut times = Times::default();
    for number in 0..CANDIDATES {
        let mut stream = Stream::new(1, Purpose::TEST, number);
        let mut values = problem.start().to_vec();
        match vary {
            Vary::Ratios => {
                let unit: Vec<f64> = values.iter().map(|_| stream.unit64()).collect();
                values = problem.from_unit(&unit);
            }
            Vary::OneAngle => {
                let turns = number as usize % values.len();
                values[turns] += 4.0 * stream.unit64() - 2.0;
            }
        }
        let timed = |times: &mut Vec<f64>, work: &dyn Fn()| times.push(1e3 * timing::best_of(2, work).0);
        let Ok(edited) = candidates.edited(&values) else {
            timed(&mut times.refused, &|| drop(candidates.evaluate(std::slice::from_ref(&values))));
            continue;
        };
        timed(&mut times.whole, &|| drop(candidates.evaluate(std::slice::from_ref(&values))));
        timed(&mut times.edited, &|| drop(candidates.edited(&values)));
        timed(&mut times.guarded, &|| _ = candidates.guards.violation(&edited.solid));
        timed(&mut times.scored, &|| drop(candidates.evaluator.values(&edited.solid)));
    }
    Ok(times)
}
