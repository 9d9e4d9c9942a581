//! `methods`: every method of search against random search, on five designs: by three single objectives the best
//! value after 50, 100 and 200 candidates, and by two and three objectives together the front's hypervolume. Prints
//! the tables of `reports/optimise.md`, and on standard error how far it is.
//!
//! Best values are scored again, finer and by other random numbers than those that they were chosen by. What is
//! measured of a design is kept in `target/optimise/` for the same build, so that the whole can be made in pieces:
//! `methods --only NAME` measures one design and prints nothing.

use super::fronts::{hypervolumes, objectives_of};
use super::subjects::{SUBJECTS, Subject, ends, kept_file, median, objectives, problem};
use super::timing;
use cutlab::advanced::optimise::Optimisation;
use cutlab::advanced::scoring::{Effort, Objective};
use cutlab::advanced::search::front::best_distinct;
use cutlab::advanced::search::{Candidate, Evaluate, METHODS, Method, Problem, SearchSettings, search};
use serde::{Deserialize, Serialize};
use std::error::Error;
use std::time::Instant;

/// Candidates of a search.
const CANDIDATES: usize = 200;

/// When a search is looked at.
const AFTER: [usize; 3] = [50, 100, CANDIDATES];

/// Searches of each method and problem, with seeds from 1.
const SEEDS: u64 = 5;

/// The single objectives; of several tilts the worst counts.
const SINGLE: [&str; 3] = ["iso", "iso@0,10,20", "fire_streak"];

/// Objectives of fronts.
const TOGETHER: [&[&str]; 2] = [&["iso", "fire_streak"], &["iso", "fire_streak", "weight_ratio"]];

/// What a method reached: for each moment of [`AFTER`] a value for each seed.
type Reached = [Vec<f64>; AFTER.len()];

/// The results of all methods that take a problem.
#[derive(Serialize, Deserialize)]
struct Table {
    subject: String,
    objective: String,
    /// What the start has and the best that any method found, in words.
    ends: String,
    /// 0 is what the start has, 1 the best that any search of the table found.
    rows: Vec<(String, Reached)>,
}

/// What is measured of a design.
#[derive(Serialize, Deserialize)]
struct Measured {
    single: Vec<Table>,
    together: Vec<Table>,
    /// How long it took.
    seconds: f64,
}

/// Measures what is not measured yet, and prints all; after `--only` measures one design.
pub fn run(arguments: &[String]) -> Result<(), Box<dyn Error>> {
    if let [only, name] = arguments
        && only == "--only"
    {
        let subject = SUBJECTS.iter().find(|subject| subject.stone == name).ok_or("no such design")?;
        return measured(subject).map(drop);
    }
    let all = SUBJECTS.iter().map(measured).collect::<Result<Vec<_>, _>>()?;
    let seconds: f64 = all.iter().map(|measured| measured.seconds).sum();
    let threads = rayon::current_num_threads();
    println!("{}; {:.0} min in all on {threads} of them", timing::machine(), seconds / 60.0);
    println!("\n### One objective\n");
    let (single, together): (Vec<_>, Vec<_>) = all.into_iter().map(|m| (m.single, m.together)).unzip();
    print_all(&single.into_iter().flatten().collect::<Vec<_>>());
    println!("\n### Several objectives\n");
    print_all(&together.into_iter().flatten().collect::<Vec<_>>());
    Ok(())
}

/// What is measured of a design, now or before by the same build.
fn measured(subject: &Subject) -> Result<Measured, Box<dyn Error>> {
    let kept = kept_file(&format!("methods-{}-{}", subject.stone, env!("CUTLAB_BUILD")))?;
    if let Ok(text) = std::fs::read_to_string(&kept) {
        return Ok(serde_json::from_str(&text)?);
    }
    let begun = Instant::now();
    let told = |what: &str| eprintln!("{}, {what}: {:.0} s", subject.title(), begun.elapsed().as_secs_f64());
    let mut measured = Measured { single: Vec::new(), together: Vec::new(), seconds: 0.0 };
    for name in SINGLE {
        measured.single.push(of_one(subject, name)?);
        told(name);
    }
    for names in TOGETHER {
        measured.together.push(of_several(subject, names)?);
        told(&names.join(", "));
    }
    measured.seconds = begun.elapsed().as_secs_f64();
    std::fs::write(&kept, serde_json::to_string(&measured)?)?;
    Ok(measured)
}

/// The searches of a method, one for each seed.
fn searches(
    problem: &Problem,
    candidates: &dyn Evaluate,
    method: Method,
) -> Result<Vec<Vec<Candidate>>, Box<dyn Error>> {
    let one = |seed: u64| {
        let settings = SearchSettings { method, evaluations: CANDIDATES, seed, ..SearchSettings::default() };
        Ok(search(problem, &settings, candidates, &())?.candidates)
    };
    (1..=SEEDS).map(one).collect()
}

fn methods(objectives: usize) -> impl Iterator<Item = Method> {
    METHODS.iter().copied().filter(move |method| method.takes(objectives))
}

/// The methods for one objective.
fn of_one(subject: &Subject, name: &str) -> Result<Table, Box<dyn Error>> {
    let mut objective = Objective::maximise(name.parse()?);
    if name.contains(',') {
        objective = objective.worst();
    }
    let stone = subject.stone()?;
    let request = subject.request(vec![objective])?;
    let optimisation = request.prepared(&stone)?;
    let mut finer = request.clone();
    finer.effort = Effort::default().error(1e-4).samples(1 << 19).seed(7);
    let judge = finer.prepared(&stone)?;
    let problem = problem(&optimisation, 1)?;
    let mut rows = Vec::new();
    for method in methods(1) {
        let found = searches(&problem, &optimisation.candidates(&()), method)?;
        let reached = AFTER.map(|after| {
            found.iter().map(|candidates| best_value(&problem, &judge, candidates, after)).collect::<Vec<_>>()
        });
        rows.push((method, reached));
    }
    let start = judge.candidates(&()).evaluator.start().objectives[0];
    let best = ends(rows.iter().flat_map(|(_, reached)| reached.iter().flatten().copied())).1;
    let share = |value: f64| (value - start.value) / (best - start.value).max(f64::MIN_POSITIVE);
    let rows = rows.into_iter().map(|(method, reached)| {
        (method.name().to_owned(), reached.map(|v| v.into_iter().map(share).collect()))
    });
    Ok(Table {
        subject: format!("{} ({} variables)", subject.title(), problem.ranges().len()),
        objective: request.objectives[0].name(),
        ends: format!("{start} to {best:.4}"),
        rows: rows.collect(),
    })
}

/// The best of the first candidates, scored again.
fn best_value(problem: &Problem, judge: &Optimisation, candidates: &[Candidate], after: usize) -> f64 {
    let first = &candidates[..after.min(candidates.len())];
    let best = best_distinct(problem, first, 1, 0.0);
    let values: Vec<Vec<f64>> = best.iter().map(|i| first[*i].values.clone()).collect();
    let outcome = judge.candidates(&()).evaluate(&values).pop();
    outcome.and_then(|outcome| outcome.objectives.first().copied()).unwrap_or(f64::NAN)
}

/// The methods for several objectives, by the hypervolume of their fronts. All methods have the same random numbers
/// of the scores, and no front is scored again.
fn of_several(subject: &Subject, names: &[&str]) -> Result<Table, Box<dyn Error>> {
    let stone = subject.stone()?;
    let request = subject.request(objectives(names)?)?;
    let optimisation = request.prepared(&stone)?;
    let problem = problem(&optimisation, names.len())?;
    let mut all: Vec<(Method, Vec<Vec<Candidate>>)> = Vec::new();
    for method in methods(names.len()) {
        all.push((method, searches(&problem, &optimisation.candidates(&()), method)?));
    }
    // the start, all that was found, and each search at each moment, by one measure
    let mut fronts: Vec<Vec<Vec<f64>>> = Vec::new();
    let everything: Vec<Candidate> =
        all.iter().flat_map(|(_, found)| found.iter().flatten().cloned()).collect();
    fronts.push(objectives_of(&everything[..1]));
    fronts.push(objectives_of(&everything));
    for (_, found) in &all {
        for after in AFTER {
            fronts.extend(found.iter().map(|c| objectives_of(&c[..after.min(c.len())])));
        }
    }
    let mut volumes = hypervolumes(&fronts).into_iter();
    let (Some(start), Some(best)) = (volumes.next(), volumes.next()) else { return Err("no front".into()) };
    let share = |volume: f64| volume / best;
    let mut rows = Vec::new();
    for (method, _) in all {
        let reached = AFTER.map(|_| volumes.by_ref().take(SEEDS as usize).map(share).collect::<Vec<_>>());
        rows.push((method.name().to_owned(), reached));
    }
    Ok(Table {
        subject: format!("{} ({} variables)", subject.title(), problem.ranges().len()),
        objective: names.join(", "),
        ends: format!("start {:.2}", share(start)),
        rows,
    })
}

/// Of each method over all tables: the median of its medians, the worst of its searches, and in how many tables no
/// other method has a higher median at the end.
fn print_summary(tables: &[Table]) {
    let columns: Vec<String> = AFTER.iter().map(|after| format!("median after {after}")).collect();
    println!(
        "| method | {} | worst after {CANDIDATES} | best of {} problems |",
        columns.join(" | "),
        tables.len()
    );
    println!("|---|{}--:|--:|", "--:|".repeat(AFTER.len()));
    let Some(first) = tables.first() else { return };
    for (place, (method, _)) in first.rows.iter().enumerate() {
        let medians: Vec<String> = (0..AFTER.len())
            .map(|at| {
                median(&tables.iter().map(|table| median(&table.rows[place].1[at])).collect::<Vec<_>>())
            })
            .map(|value| format!("{value:.3}"))
            .collect();
        let last = AFTER.len() - 1;
        let worst = ends(tables.iter().flat_map(|table| table.rows[place].1[last].iter().copied())).0;
        let leads = tables.iter().filter(|table| {
            let own = median(&table.rows[place].1[last]);
            // what differs by less than is printed is the same
            table.rows.iter().all(|(_, reached)| own >= median(&reached[last]) - 5e-4)
        });
        println!("| {} | {} | {worst:.3} | {} |", method, medians.join(" | "), leads.count());
    }
    println!();
}

fn print_all(tables: &[Table]) {
    print_summary(tables);
    print_tables(tables);
}

fn print_tables(tables: &[Table]) {
    let columns: Vec<String> = AFTER.iter().map(|after| format!("after {after}")).collect();
    println!("| design | objective | start to best | method | {} |", columns.join(" | "));
    println!("|---|---|---|---|{}", "--:|".repeat(AFTER.len()));
    for table in tables {
        let mut head = [table.subject.as_str(), &table.objective, &table.ends];
        for (method, reached) in &table.rows {
            let cells: Vec<String> = reached.iter().map(|values| cell(values)).collect();
            println!("| {} | {} | {} | {} | {} |", head[0], head[1], head[2], method, cells.join(" | "));
            head = [""; 3];
        }
    }
}

/// `0.981 (0.950–0.997)`: the median and the ends.
fn cell(values: &[f64]) -> String {
    let (low, high) = ends(values.iter().copied());
    format!("{:.3} ({low:.3}–{high:.3})", median(values))
}
