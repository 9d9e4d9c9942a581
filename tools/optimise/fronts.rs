//! `fronts [SUBJECT…]`: the front of ISO, fire and weight after 800 candidates against the front of 10,000 random
//! feasible designs of the same box, by hypervolume. The random ones are kept in `target/optimise/`, and taken from
//! there as long as the first of them still have the outcomes that they had: so a method can be changed and measured
//! again.

use super::subjects::{SUBJECTS, Subject, ends, kept_file, objectives, problem};
use super::timing;
use cutlab::advanced::sampling::random::{Purpose, Stream};
use cutlab::advanced::search::front::{front, hypervolume};
use cutlab::advanced::search::{Candidate, Evaluate, Outcome, Problem, SearchResult, SearchSettings, search};
use serde::{Deserialize, Serialize};
use std::error::Error;
use std::time::Instant;

/// The objectives of the front.
pub const OBJECTIVES: [&str; 3] = ["iso", "fire_streak", "weight_ratio"];

/// Candidates of the optimisation.
const CANDIDATES: usize = 800;

/// Random feasible designs that it is held against.
const RANDOM: usize = 10_000;

/// Random points that are evaluated together.
const BATCH: u64 = 100;

/// Where hypervolumes are counted from: so far below the worst value of each objective on the fronts, as a share of
/// what the fronts span.
const BELOW: f64 = 0.1;

/// Measures the subjects that are named, else all.
pub fn run(arguments: &[String]) -> Result<(), Box<dyn Error>> {
    println!("{}", timing::machine());
    println!(
        "| design | variables | candidates | front | hypervolume | random, feasible | front | hypervolume | ratio |"
    );
    println!("|---|--:|--:|--:|--:|--:|--:|--:|--:|");
    let asked =
        |subject: &&Subject| arguments.is_empty() || arguments.iter().any(|name| name == subject.stone);
    SUBJECTS.iter().filter(asked).try_for_each(measure)
}

fn measure(subject: &Subject) -> Result<(), Box<dyn Error>> {
    let begun = Instant::now();
    let stone = subject.stone()?;
    let request = subject.request(objectives(&OBJECTIVES)?)?;
    let optimisation = request.prepared(&stone)?;
    let problem = problem(&optimisation, OBJECTIVES.len())?;
    let candidates = optimisation.candidates(&());
    let settings = SearchSettings { evaluations: CANDIDATES, ..SearchSettings::default() };
    let SearchResult { candidates: found, .. } = search(&problem, &settings, &candidates, &())?;
    eprintln!("{}: searched after {:.0} s", subject.title(), begun.elapsed().as_secs_f64());

    let kept = kept_file(&format!("fronts-{}", subject.stone))?;
    let random = match std::fs::read_to_string(&kept).ok().and_then(|text| serde_json::from_str(&text).ok()) {
        Some(random) if is_current(&random, &problem, &candidates) => random,
        _ => random_designs(subject, &problem, &candidates),
    };
    std::fs::write(&kept, serde_json::to_string(&random)?)?;
    std::fs::write(kept.with_extension("found.json"), serde_json::to_string(&found)?)?;
    let Random { feasible: random, tried } = random;
    let fronts = [&found, &random].map(|candidates| objectives_of(candidates));
    let volumes = hypervolumes(&fronts);
    let (ours, theirs) = (volumes[0], volumes[1]);
    println!(
        "| {} | {} | {CANDIDATES} | {} | {ours:.4} | {RANDOM} of {tried} | {} | {theirs:.4} | {:.4} |",
        subject.title(),
        problem.ranges().len(),
        fronts[0].len(),
        fronts[1].len(),
        ours / theirs
    );
    Ok(())
}

/// Random designs.
#[derive(Serialize, Deserialize)]
struct Random {
    /// Those that are feasible.
    feasible: Vec<Candidate>,
    /// Out of so many.
    tried: u64,
}

/// The random point of a number.
fn random_point(problem: &Problem, number: u64) -> Vec<f64> {
    let mut stream = Stream::new(1, Purpose::TEST, number);
    let unit: Vec<f64> = problem.ranges().iter().map(|_| stream.unit64()).collect();
    problem.from_unit(&unit)
}

fn random_designs(subject: &Subject, problem: &Problem, evaluate: &dyn Evaluate) -> Random {
    let begun = Instant::now();
    let (mut feasible, mut tried): (Vec<Candidate>, u64) = (Vec::new(), 0);
    while feasible.len() < RANDOM {
        let batch: Vec<Vec<f64>> =
            (tried..tried + BATCH).map(|number| random_point(problem, number)).collect();
        tried += BATCH;
        let outcomes = evaluate.evaluate(&batch);
        let new = batch.into_iter().zip(outcomes).map(|(values, outcome)| Candidate { values, outcome });
        feasible.extend(new.filter(|candidate| candidate.outcome.is_feasible()));
        if tried % 1000 == 0 {
            let seconds = begun.elapsed().as_secs_f64();
            eprintln!("{}: {} feasible of {tried} after {seconds:.0} s", subject.title(), feasible.len());
        }
    }
    feasible.truncate(RANDOM);
    Random { feasible, tried }
}

/// Whether designs that were kept are random ones of this problem, with the outcomes that they have.
fn is_current(random: &Random, problem: &Problem, evaluate: &dyn Evaluate) -> bool {
    let values: Vec<Vec<f64>> = (0..BATCH).map(|number| random_point(problem, number)).collect();
    let outcomes = evaluate.evaluate(&values);
    let now = values.into_iter().zip(outcomes).map(|(values, outcome)| Candidate { values, outcome });
    let now: Vec<Candidate> = now.filter(|candidate| candidate.outcome.is_feasible()).collect();
    random.feasible.len() == RANDOM && random.feasible.starts_with(&now)
}

/// The objectives of the feasible candidates that none dominates.
pub fn objectives_of(candidates: &[Candidate]) -> Vec<Vec<f64>> {
    front(candidates).into_iter().map(|i| candidates[i].outcome.objectives.clone()).collect()
}

/// The hypervolumes of fronts, all by one measure: what the front of all of them spans of each objective is one, and
/// volume is counted from a tenth below.
pub fn hypervolumes(fronts: &[Vec<Vec<f64>>]) -> Vec<f64> {
    let feasible = |objectives: &Vec<f64>| Candidate {
        values: Vec::new(),
        outcome: Outcome::feasible(objectives.clone()),
    };
    let best = objectives_of(&fronts.iter().flatten().map(feasible).collect::<Vec<_>>());
    let objectives = best.first().map_or(0, Vec::len);
    let spans: Vec<(f64, f64)> = (0..objectives).map(|j| ends(best.iter().map(|point| point[j]))).collect();
    let share = |(value, (low, high)): (&f64, &(f64, f64))| {
        BELOW + if high > low { (value - low) / (high - low) } else { 1.0 }
    };
    let of_front = |front: &Vec<Vec<f64>>| {
        let scaled = front.iter().map(|point| point.iter().zip(&spans).map(share).collect());
        hypervolume(&scaled.collect::<Vec<_>>(), &vec![0.0; objectives])
    };
    fronts.iter().map(of_front).collect()
}
