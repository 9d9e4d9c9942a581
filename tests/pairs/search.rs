//! Which cases are run, which pairs are refused, and which choices a failure needs.

use crate::bench::Inputs;
use crate::case::Case;
use crate::covering::{self, Choice, Row};
use crate::factors::Factor;
use crate::oracles::{self, Verdict};
use std::collections::{BTreeMap, HashSet};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Rounds of finding refused pairs: each finds all that the last one's rows ran into.
const ROUNDS: usize = 12;

/// What was found over all commands.
#[derive(Debug, Default)]
pub struct Report {
    cases: usize,
    pairs: usize,
    refused: usize,
    failures: usize,
    /// Each kind of failure: how many cases have it, and the smallest command that shows it.
    pub kinds: BTreeMap<String, (usize, String)>,
}

impl Report {
    /// Counts a failure.
    pub fn failed(&mut self, command: &str, oracle: &str, example: &str) {
        self.failures += 1;
        self.kinds.entry(format!("{command}: {oracle}")).or_insert((0, example.into())).0 += 1;
    }

    /// The figures in one line.
    pub fn summary(&self) -> String {
        format!(
            "{} pairs, {} refusals, {} cases, {} failures of {} kinds",
            self.pairs,
            self.refused,
            self.cases,
            self.failures,
            self.kinds.len()
        )
    }

    /// The kinds, one a line.
    pub fn text(&self) -> String {
        let line =
            |(kind, (n, example)): (&String, &(usize, String))| format!("{n:4} × {kind}\n       {example}\n");
        format!("{}\n{}", self.summary(), self.kinds.iter().map(line).collect::<String>())
    }
}

/// A failure of a kind that is known: it needs these choices.
struct Known {
    oracle: &'static str,
    needs: Vec<Choice>,
}

/// The cases of one command.
pub struct Search<'a> {
    command: &'a str,
    factors: Vec<Factor>,
    inputs: &'a Inputs,
    parser: clap::Command,
    refused: HashSet<(Choice, Choice)>,
    /// The smallest refused rows.
    refusals: Vec<Row>,
    known: Vec<Known>,
}

impl<'a> Search<'a> {
    /// Nothing is known yet.
    pub fn new(command: &'a str, factors: Vec<Factor>, inputs: &'a Inputs) -> Search<'a> {
        let mut parser = cutlab::cli::command();
        parser.build();
        Search {
            command,
            factors,
            inputs,
            parser,
            refused: HashSet::new(),
            refusals: Vec::new(),
            known: Vec::new(),
        }
    }

    fn case(&self, row: &[usize]) -> Case {
        Case::new(self.command, &self.factors, row)
    }

    /// Whether the command line is wrong by its definition.
    fn is_misspelt(&self, row: &[usize]) -> bool {
        let words = std::iter::once("cutlab".to_string()).chain(self.case(row).words());
        self.parser.clone().try_get_matches_from(words).is_err()
    }

    fn is_refused(&self, row: &[usize]) -> bool {
        self.is_misspelt(row) || oracles::judge(&self.case(row), self.inputs) == Verdict::Refused
    }

    /// Runs the cases that are kept, by command and number.
    pub fn run(mut self, keep: &impl Fn(&str, usize) -> bool, report: &mut Report) {
        let all = covering::pairs(&self.factors);
        report.pairs += all.len();
        let whole = keep(self.command, 0) && keep(self.command, 1);
        let mut open = all;
        let mut number = 0;
        for _ in 0..ROUNDS {
            let rows = self.spelt(&open);
            let kept: Vec<Row> = rows
                .into_iter()
                .filter(|_| {
                    number += 1;
                    keep(self.command, number - 1)
                })
                .collect();
            let verdicts = self.judged(&kept);
            report.cases += kept.len();
            let mut learned = false;
            for (row, verdict) in kept.iter().zip(verdicts) {
                match verdict {
                    Verdict::Refused if whole => {
                        let held = covering::pairs_in(row).any(|p| self.refused.contains(&p));
                        learned |= held || self.learn(row, &|s, row| s.is_refused(row), report);
                    }
                    Verdict::Refused => (),
                    verdict => {
                        open.retain(|p| !covering::is_in(row, p));
                        if let Verdict::Bad(faults) = verdict {
                            faults.into_iter().for_each(|f| self.count(row, f, report));
                        }
                    }
                }
            }
            open.retain(|p| !self.refused.contains(p));
            if !learned || open.is_empty() {
                break;
            }
        }
        if whole {
            self.check_refusals(report);
        }
    }

    /// Rows that the definition of the command line allows.
    fn spelt(&mut self, open: &HashSet<(Choice, Choice)>) -> Vec<Row> {
        loop {
            let open = open.difference(&self.refused).copied().collect();
            let rows = covering::rows(&self.factors, &open, &self.refused);
            let mut learned = false;
            for row in &rows {
                let known = covering::pairs_in(row).any(|p| self.refused.contains(&p));
                if !known && self.is_misspelt(row) {
                    learned |= self.learn(row, &|s, row| s.is_misspelt(row), &mut Report::default());
                }
            }
            if !learned {
                return rows.into_iter().filter(|row| !self.is_misspelt(row)).collect();
            }
        }
    }

    /// What becomes of each row, two at a time.
    fn judged(&self, rows: &[Row]) -> Vec<Verdict> {
        let (next, done) = (AtomicUsize::new(0), Mutex::new(BTreeMap::new()));
        std::thread::scope(|scope| {
            for _ in 0..2 {
                scope.spawn(|| {
                    loop {
                        let i = next.fetch_add(1, Ordering::Relaxed);
                        let Some(row) = rows.get(i) else { break };
                        let verdict = oracles::judge(&self.case(row), self.inputs);
                        done.lock().expect("no judge fails").insert(i, verdict);
                    }
                });
            }
        });
        done.into_inner().expect("no judge fails").into_values().collect()
    }

    /// The row with every choice at rest that `still` does not need.
    fn smallest(&self, row: &[usize], still: &dyn Fn(&Self, &[usize]) -> bool) -> Row {
        let mut smallest = row.to_vec();
        for factor in 0..smallest.len() {
            let mut other = smallest.clone();
            other[factor] = 0;
            if smallest[factor] != 0 && still(self, &other) {
                smallest = other;
            }
        }
        smallest
    }

    /// Learns which pair of a refused row is refused; whether it learned anything.
    fn learn(
        &mut self,
        row: &[usize],
        refuses: &dyn Fn(&Self, &[usize]) -> bool,
        report: &mut Report,
    ) -> bool {
        let smallest = self.smallest(row, refuses);
        let needs: Vec<Choice> = smallest.iter().copied().enumerate().filter(|(_, l)| *l != 0).collect();
        let (before, line) = (self.refused.len(), self.case(&smallest).line());
        match needs[..] {
            [] => report.failed(self.command, &format!("the command alone is refused: {line}"), ""),
            [one] => {
                // what it wants beside it: another option that is at rest here
                let mut rescued = false;
                for other in (0..self.factors.len()).filter(|f| *f != one.0) {
                    let levels = 0..self.factors[other].levels.len();
                    let with = |level: usize| {
                        let mut row = smallest.clone();
                        row[other] = level;
                        refuses(self, &row)
                    };
                    let bad: Vec<usize> = levels.clone().filter(|level| with(*level)).collect();
                    if bad.len() < levels.len() {
                        rescued = true;
                        self.refused.extend(bad.iter().map(|l| covering::pair(one, (other, *l))));
                    }
                }
                if !rescued {
                    report.failed(self.command, &format!("a value that is always refused: {line}"), "");
                    let others = (0..self.factors.len()).filter(|f| *f != one.0);
                    let pairs = others.flat_map(|f| (0..self.factors[f].levels.len()).map(move |l| (f, l)));
                    self.refused.extend(pairs.map(|other| covering::pair(one, other)));
                }
            }
            [a, b] => drop(self.refused.insert(covering::pair(a, b))),
            // three that do not go together: the first two are not tried together again
            [a, b, ..] => drop(self.refused.insert(covering::pair(a, b))),
        }
        self.refusals.push(smallest);
        self.refused.len() > before
    }

    /// Counts a fault under the smallest set of choices that has it.
    fn count(&mut self, row: &[usize], fault: oracles::Fault, report: &mut Report) {
        let has = |needs: &[Choice]| needs.iter().all(|(f, level)| row[*f] == *level);
        if !self.known.iter().any(|k| k.oracle == fault.oracle && has(&k.needs)) {
            let still = |s: &Self, row: &[usize]| match oracles::judge(&s.case(row), s.inputs) {
                Verdict::Bad(faults) => faults.iter().any(|f| f.oracle == fault.oracle),
                _ => false,
            };
            let smallest = self.smallest(row, &still);
            let needs = smallest.iter().copied().enumerate().filter(|(_, l)| *l != 0).collect();
            let line = self.case(&smallest).line();
            self.known.push(Known { oracle: fault.oracle, needs });
            report.failed(self.command, &format!("{}: {line}", fault.oracle), &fault.found);
            return;
        }
        report.failures += 1;
    }

    /// Every refusal that was found is one line, at once, and nothing is done.
    fn check_refusals(&mut self, report: &mut Report) {
        self.refusals.sort();
        self.refusals.dedup();
        let rows = std::mem::take(&mut self.refusals);
        report.refused += rows.len();
        for (row, verdict) in rows.iter().zip(self.judged(&rows)) {
            if let Verdict::Bad(faults) = verdict {
                faults.into_iter().for_each(|f| self.count(row, f, report));
            }
        }
    }
}
