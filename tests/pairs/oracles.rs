//! What must hold of every command: how it ends, and that it does the same again. What it writes is
//! judged in `outputs.rs`, its numbers in `numbers.rs`.

use crate::bench::{Bench, Inputs, Ran};
use crate::case::Case;
use crate::{numbers, outputs};
use std::path::PathBuf;
use std::time::Duration;

/// What came of a case.
#[derive(Debug, PartialEq)]
pub enum Verdict {
    /// All holds.
    Good,
    /// Refused at once, with one line and nothing done.
    Refused,
    /// What does not hold.
    Bad(Vec<Fault>),
}

/// Something that does not hold.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// What should.
    pub oracle: &'static str,
    /// What was found.
    pub found: String,
}

/// A fault against an oracle.
pub fn fault(oracle: &'static str, found: impl Into<String>) -> Fault {
    Fault { oracle, found: found.into() }
}

/// A refusal takes milliseconds; this is for a busy machine.
pub const AT_ONCE: Duration = Duration::from_secs(4);

/// How long a command is waited for where it only matters whether it is refused: one that is, and is not by then,
/// makes the choices that are learned as refused together more than they need be.
pub const SOON: Duration = Duration::from_millis(800);

/// Runs a case and what belongs to it, and judges it.
///
/// - `number`: of the case; every third is run anew on two threads, the others again where they were; of dear
///   ones the first alone is run again
pub fn judge(case: &Case, number: usize, inputs: &Inputs) -> Verdict {
    let bench = Bench::new(inputs, &case.words());
    let ran = bench.run(&case.words(), 1);
    let mut faults = ends(case, &ran);
    if ran.code == Some(2) && faults.is_empty() {
        return Verdict::Refused;
    }
    if !matches!(ran.code, Some(0 | 1)) {
        return Verdict::Bad(faults);
    }
    faults.extend(outputs::faults(case, &ran, inputs));
    match (case.is_dear(), number) {
        (false, _) if number.is_multiple_of(3) => faults.extend(repeated(case, &ran, inputs)),
        (false, _) | (true, 0) => faults.extend(again(case, &ran, &bench)),
        (true, _) => (),
    }
    faults.extend(numbers::faults(case, &ran, inputs));
    if faults.is_empty() { Verdict::Good } else { Verdict::Bad(faults) }
}

/// How a command ends: exit code, what it says, what it leaves.
fn ends(case: &Case, ran: &Ran) -> Vec<Fault> {
    let mut faults = Vec::new();
    let said = ran.stderr.trim();
    if ran.code.is_none() {
        faults.push(fault("it ends", "it did not"));
    }
    if said.contains("panicked") {
        faults.push(fault("no panic", said));
    }
    // one stone of several may have no score, which its row explains
    let explained = ran.code == Some(1) && case.gives_scores();
    if !matches!(ran.code, None | Some(0 | 2)) && !explained {
        faults.push(fault("exit code 0 or 2", format!("{:?}: {said}", ran.code)));
    }
    if ran.code == Some(2) {
        // what failed of several may be told as JSON instead
        let told = case.has("json") && serde_json::from_slice::<serde_json::Value>(&ran.stdout).is_ok();
        if !told && (said.lines().count() != 1 || !said.starts_with("cutlab: ")) {
            faults.push(fault("a refusal is one line", said));
        }
        if !ran.files.is_empty() || !(told || ran.stdout.is_empty()) {
            faults.push(fault("a refusal does nothing", format!("{said}: {:?}", ran.files.keys())));
        }
        if ran.took > AT_ONCE {
            faults.push(fault("a refusal comes at once", format!("{said}: after {:?}", ran.took)));
        }
    }
    if ran.code == Some(0) && case.has("quiet") && !said.is_empty() {
        faults.push(fault("quiet is silent", said));
    }
    let hidden = |path: &&PathBuf| path.iter().any(|part| part.as_encoded_bytes().starts_with(b"."));
    if let Some(left) = ran.files.keys().find(hidden) {
        faults.push(fault("nothing is left behind", left.display().to_string()));
    }
    if let Some(harmed) = ran.harmed.first() {
        faults.push(fault("inputs are left alone", harmed.display().to_string()));
    }
    faults
}

/// The same on two threads, and again in the same folder.
fn repeated(case: &Case, ran: &Ran, inputs: &Inputs) -> Vec<Fault> {
    let mut faults = Vec::new();
    let bench = Bench::new(inputs, &case.words());
    let two = bench.run(&case.words(), 2);
    if (two.code, &two.stdout, &two.files) != (ran.code, &ran.stdout, &ran.files) {
        faults.push(fault("the same on two threads", differing(ran, &two)));
    }
    faults.extend(again(case, &two, &bench));
    faults
}

/// The same in the folder where it was done already, on two threads.
fn again(case: &Case, ran: &Ran, bench: &Bench) -> Option<Fault> {
    let again = bench.run(&case.words(), 2);
    let says_what_it_did = ["import", "generate"].contains(&case.command.as_str()); // what was there already
    let same_words = says_what_it_did || again.stdout == ran.stdout;
    let same = (again.code, &again.files) == (ran.code, &ran.files) && same_words;
    (!same).then(|| fault("the same again", format!("{} {}", differing(ran, &again), again.stderr.trim())))
}

fn differing(one: &Ran, two: &Ran) -> String {
    let names = one.files.keys().chain(two.files.keys());
    let file = names.into_iter().find(|name| one.files.get(*name) != two.files.get(*name));
    let stdout = if one.stdout == two.stdout { "" } else { ", standard output" };
    format!("{:?} {:?}, file {file:?}{stdout}", one.code, two.code)
}
