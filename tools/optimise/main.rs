//! Measurements of `cutlab optimise`: what a candidate costs, whether meets are kept, whether known optima are
//! found, and which method of search is best. One part at a time:
//!
//! `cargo run --release --example optimise -- PART [ARGUMENT…]`; `tools/optimise/README.md` says what each measures
//! and how long it takes.

#[path = "../timing.rs"]
mod timing;

mod candidate_cost;
mod fronts;
mod keller;
mod light_return;
mod meets;
mod methods;
mod round_trips;
mod subjects;

use std::error::Error;

/// A measurement by the name that it is asked for by.
type Part = (&'static str, fn(&[String]) -> Result<(), Box<dyn Error>>);

const PARTS: [Part; 7] = [
    ("cost", candidate_cost::run),
    ("meets", meets::run),
    ("keller", keller::run),
    ("light-return", light_return::run),
    ("fronts", fronts::run),
    ("round-trips", round_trips::run),
    ("methods", methods::run),
];

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let asked = words.first().map_or("", String::as_str);
    match PARTS.iter().find(|(name, _)| *name == asked) {
        Some((_, run)) => run(&words[1..]),
        None => {
            Err(format!("'{asked}' is no part: one of {}", PARTS.map(|(name, _)| name).join(", ")).into())
        }
    }
}
