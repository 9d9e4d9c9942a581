//! How well methods search: `cargo bench --bench search [-- EVALUATIONS]`. Each method from several starts and
//! seeds beside random points, on functions that look like those of stones: a narrow ridge (crown and pavilion
//! angles that belong together), a window (a cliff), ripples, several peaks, trade-offs. Run by `cargo test` it
//! only shows that it runs.

#[path = "timing.rs"]
mod timing;

use cutlab::advanced::search::front::hypervolume;
use cutlab::advanced::search::{
    Evaluate, METHODS, Method, Outcome, Problem, SearchResult, SearchSettings, search,
};
use std::error::Error;

/// What is searched.
struct Subject {
    name: &'static str,
    variables: usize,
    /// A front's hypervolume is that above it; empty for one objective.
    reference: Vec<f64>,
    evaluate: Box<dyn Evaluate>,
}

/// A method's results on a subject.
struct Measured {
    values: Vec<f64>,
    /// Of the method itself, in seconds of processor time for one search: evaluations here cost nothing.
    seconds: f64,
}

impl Measured {
    fn worst(&self) -> f64 {
        self.values.iter().copied().fold(f64::INFINITY, f64::min)
    }

    fn median(&self) -> f64 {
        let mut values = self.values.clone();
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    }
}

impl Subject {
    fn new(name: &'static str, variables: usize, reference: &[f64], f: fn(&[f64]) -> Outcome) -> Subject {
        Subject { name, variables, reference: reference.to_vec(), evaluate: Box::new(f) }
    }

    fn objectives(&self) -> usize {
        self.reference.len().max(1)
    }

    /// What a search was worth: the best value, or the front's hypervolume; nothing, if nothing is feasible.
    fn worth(&self, result: &SearchResult) -> f64 {
        let front = result.front().into_iter().map(|i| result.candidates[i].outcome.objectives.clone());
        let front: Vec<Vec<f64>> = front.collect();
        if self.reference.is_empty() {
            front.first().map_or(f64::NEG_INFINITY, |objectives| objectives[0])
        } else {
            hypervolume(&front, &self.reference)
        }
    }

    /// Searches with seeds 0 to `seeds`, each from a start of its own.
    fn measure(&self, method: Method, evaluations: usize, seeds: u64) -> Result<Measured, Box<dyn Error>> {
        let from_start = |seed: u64| -> Result<f64, Box<dyn Error>> {
            // golden-ratio steps: no start is near another, or on a round number
            let coordinate = |i: usize| 0.05 + 0.9 * ((seed as f64 * 0.618_034 + i as f64 * 0.414_214) % 1.0);
            let start = (0..self.variables).map(coordinate).collect();
            let problem = Problem::new(vec![0.0..=1.0; self.variables], start, self.objectives())?;
            let settings = SearchSettings { method, evaluations, seed, ..SearchSettings::default() };
            Ok(self.worth(&search(&problem, &settings, self.evaluate.as_ref(), &())?))
        };
        let (seconds, values) = timing::best_of(1, || (0..seeds).map(from_start).collect::<Result<_, _>>());
        Ok(Measured { values: values?, seconds: seconds / seeds as f64 })
    }
}

/// A score that is high on a ridge, between ripples and kinks; over low pavilions there is a window.
fn light(x: &[f64]) -> f64 {
    let (crown, pavilion) = (x[0], x[1]);
    let across = 40.0 * (crown + 0.6 * pavilion - 0.85).powi(2);
    let along = 0.75 * (crown - 0.55).powi(2);
    let ripples = 0.03 * (25.0 * crown).cos() * (19.0 * pavilion).cos();
    let kink = 0.2 * (crown - pavilion - 0.1).abs();
    let window = if pavilion < 0.15 + 0.3 * crown { 0.25 * (1.0 - pavilion / 0.45).max(0.1) } else { 0.0 };
    let belonging = x[2..].iter().zip([crown, pavilion].into_iter().cycle());
    let others: f64 = belonging.map(|(x, to)| 0.75 * (x - 0.4 - 0.3 * to).powi(2)).sum();
    0.95 - 0.5 * across / (1.0 + across) - along - window - kink + ripples - others
}

/// A score with four peaks of about the same height.
fn peaks(x: &[f64]) -> f64 {
    let peaks = [(1.0, 0.18, 0.7), (0.97, 0.25, 0.2), (0.95, 0.3, 0.5), (0.9, 0.35, 0.85)];
    let peak = |(height, width, centre): (f64, f64, f64)| {
        let offset = |(i, x): (usize, &f64)| (x - (centre + 0.37 * i as f64) % 1.0).powi(2);
        let away = x.iter().enumerate().map(offset).sum::<f64>().sqrt() / width / (x.len() as f64).sqrt();
        height * (-away.min(1.5)).exp()
    };
    peaks.into_iter().map(peak).fold(0.0, f64::max) + 0.01 * (60.0 * x[0]).sin() * (45.0 * x[1]).sin()
}

fn fire(x: &[f64]) -> f64 {
    let others: f64 = x[2..].iter().enumerate().map(|(i, x)| (x - 0.8 + 0.1 * i as f64).powi(2)).sum();
    let main = 0.4 * (3.0 * x[0]).sin() * (1.0 - (x[1] - 0.7).powi(2));
    0.5 + main - 0.3 * others + 0.02 * (40.0 * (x[0] + x[1])).sin()
}

fn weight(x: &[f64]) -> f64 {
    let others = x[2..].iter().sum::<f64>() / x.len() as f64;
    1.0 - 0.5 * (x[0] - 0.1).abs() - 0.4 * x[1] * x[1] - 0.1 * others
}

fn of_light(x: &[f64]) -> Outcome {
    Outcome::feasible(vec![light(x)])
}

fn of_peaks(x: &[f64]) -> Outcome {
    Outcome::feasible(vec![peaks(x)])
}

/// Light of stones that keep four fifths of the weight.
fn of_heavy(x: &[f64]) -> Outcome {
    Outcome { objectives: vec![light(x)], violation: (0.8 - weight(x)).max(0.0) }
}

fn of_three(x: &[f64]) -> Outcome {
    Outcome { objectives: vec![light(x), fire(x), weight(x)], violation: (0.25 - weight(x)).max(0.0) }
}

fn main() -> Result<(), Box<dyn Error>> {
    let is_real = std::env::args().any(|a| a == "--bench");
    let asked = std::env::args().skip(1).find_map(|a| a.parse().ok());
    let (seeds, many) = if is_real { (15, 10_000) } else { (1, 100) };
    let of_three_above = [0.3, 0.0, 0.3];
    let subjects = [
        Subject::new("light, 2 variables", 2, &[], of_light),
        Subject::new("light, 4 variables", 4, &[], of_light),
        Subject::new("light, 6 variables", 6, &[], of_light),
        Subject::new("peaks, 2 variables", 2, &[], of_peaks),
        Subject::new("peaks, 4 variables", 4, &[], of_peaks),
        Subject::new("light of 0.8 weight, 4 variables", 4, &[], of_heavy),
        Subject::new("light, fire, weight, 2 variables", 2, &of_three_above, of_three),
        Subject::new("light, fire, weight, 4 variables", 4, &of_three_above, of_three),
        Subject::new("light, fire, weight, 6 variables", 6, &of_three_above, of_three),
    ];
    println!("{}; {seeds} seeds; a search in seconds of one thread", timing::machine());
    for subject in &subjects {
        let default = if subject.objectives() == 1 { 150 } else { 800 };
        let evaluations = asked.unwrap_or(if is_real { default } else { 30 });
        println!("{}, {evaluations} evaluations", subject.name);
        for &method in METHODS.iter().filter(|method| method.takes(subject.objectives())) {
            let measured = subject.measure(method, evaluations, seeds)?;
            let (median, worst) = (measured.median(), measured.worst());
            println!(
                "  {:>11}: median {median:.5}, worst {worst:.5}, {:.3} s",
                method.name(),
                measured.seconds
            );
        }
        let random = subject.measure(Method::Random, many, 3.min(seeds))?.median();
        println!("  {many} random points: {random:.5}");
    }
    Ok(())
}
