//! Which cases are run, which choices are refused, and which choices a failure needs.

use crate::bench::{Bench, Inputs};
use crate::case::Case;
use crate::covering::{self, Choice, Refused, Row};
use crate::factors::Factor;
use crate::oracles::{self, Verdict};
use crate::report::Report;
use std::collections::{BTreeMap, HashSet};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// Rounds of finding what is refused: each finds all that the last one's rows ran into.
const ROUNDS: usize = 12;

/// The word that makes a page of a comparison or an optimisation.
const PAGE: &str = "out";

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
    refused: Refused,
    /// The smallest refused rows.
    refusals: Vec<Row>,
    known: Vec<Known>,
    /// Rows that went well.
    good: Vec<Row>,
}

impl<'a> Search<'a> {
    /// Nothing is known yet.
    pub fn new(command: &'a str, factors: Vec<Factor>, inputs: &'a Inputs) -> Search<'a> {
        let mut parser = cutlab::advanced::cli::command();
        parser.build();
        Search {
            command,
            factors,
            inputs,
            parser,
            refused: Refused::default(),
            refusals: Vec::new(),
            known: Vec::new(),
            good: Vec::new(),
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

    /// Whether the program refuses the command line, which it does at once.
    fn is_refused(&self, row: &[usize]) -> bool {
        let words = self.case(row).words();
        self.is_misspelt(row)
            || Bench::new(self.inputs, &words).run_for(&words, 1, oracles::SOON).code == Some(2)
    }

    /// Runs the cases that are kept, by command and number.
    pub fn run(mut self, keep: &impl Fn(&str, usize) -> bool, report: &mut Report) {
        let start = Instant::now();
        let mut open = covering::pairs(&self.factors);
        open.retain(|p| self.is_tried(*p));
        report.begins(self.command, open.len());
        let whole = keep(self.command, 0) && keep(self.command, 1);
        let mut number = 0;
        for _ in 0..ROUNDS {
            let rows = self.spelt(&open, report);
            let kept: Vec<Row> = rows
                .into_iter()
                .filter(|_| {
                    number += 1;
                    keep(self.command, number - 1)
                })
                .collect();
            let verdicts = self.judged(&kept);
            report.ran(kept.len());
            let went = kept.iter().zip(&verdicts).filter(|(_, verdict)| **verdict == Verdict::Good);
            self.good.extend(went.map(|(row, _)| row.clone()));
            let mut learned = false;
            for (row, verdict) in kept.iter().zip(verdicts) {
                match verdict {
                    Verdict::Refused if whole => {
                        let held = self.refused.refuses(row);
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
            open.retain(|p| !self.refused.has(p));
            if !learned || open.is_empty() {
                break;
            }
        }
        if whole {
            self.check_refusals(report);
        }
        report.ends(self.command, start.elapsed());
    }

    /// Whether a pair is to be tried. Pages take up to a minute of processor time: with one of `compare` or
    /// `optimise` go the first two values of each other option, and of `report` each value goes with one stone.
    fn is_tried(&self, (a, b): (Choice, Choice)) -> bool {
        let page = |(f, level): Choice| {
            ["compare", "optimise"].contains(&self.command)
                && self.factors[f].levels[level].contains(&PAGE.into())
        };
        match (self.command, page(a), page(b)) {
            ("report", ..) => a.0 == 0 && a.1 == b.1 % self.factors[0].levels.len(),
            (_, true, _) => b.1 < 2,
            (_, _, true) => a.1 < 2,
            _ => true,
        }
    }

    /// Rows that the definition of the command line allows.
    fn spelt(&mut self, open: &HashSet<(Choice, Choice)>, report: &mut Report) -> Vec<Row> {
        loop {
            let open = open.iter().copied().filter(|p| !self.refused.has(p)).collect();
            let rows = covering::rows(&self.factors, &open, &self.refused);
            let mut learned = false;
            for row in &rows {
                if !self.refused.refuses(row) && self.is_misspelt(row) {
                    learned |= self.learn(row, &|s, row| s.is_misspelt(row), report);
                }
            }
            if !learned {
                return rows.into_iter().filter(|row| !self.is_misspelt(row)).collect();
            }
        }
    }

    /// What becomes of each row, one on each core at a time.
    fn judged(&self, rows: &[Row]) -> Vec<Verdict> {
        let (next, done) = (AtomicUsize::new(0), Mutex::new(BTreeMap::new()));
        let workers = std::thread::available_parallelism().map_or(2, usize::from);
        std::thread::scope(|scope| {
            for _ in 0..workers {
                scope.spawn(|| {
                    loop {
                        let i = next.fetch_add(1, Ordering::Relaxed);
                        let Some(row) = rows.get(i) else { break };
                        let verdict = oracles::judge(&self.case(row), i, self.inputs);
                        done.lock().expect("no judge fails").insert(i, verdict);
                    }
                });
            }
        });
        done.into_inner().expect("no judge fails").into_values().collect()
    }

    /// The row with every choice at rest that `still` does not need.
    fn smallest(&self, row: &[usize], still: &dyn Fn(&Self, &[usize]) -> bool) -> Row {
        self.smallest_beside(usize::MAX, row, still)
    }

    /// The same with the choice of one factor left as it is.
    fn smallest_beside(&self, kept: usize, row: &[usize], still: &dyn Fn(&Self, &[usize]) -> bool) -> Row {
        let mut smallest = row.to_vec();
        for factor in (0..smallest.len()).filter(|f| *f != kept) {
            let mut other = smallest.clone();
            other[factor] = 0;
            if smallest[factor] != 0 && still(self, &other) {
                smallest = other;
            }
        }
        smallest
    }

    /// Learns which choices of a refused row are refused together; whether it learned anything.
    ///
    /// - `refuses`: whether a row is refused; the row is shrunk as long as it is spelt as before
    fn learn(
        &mut self,
        row: &[usize],
        refuses: &dyn Fn(&Self, &[usize]) -> bool,
        report: &mut Report,
    ) -> bool {
        let misspelt = self.is_misspelt(row);
        let smallest = self.smallest(row, &|s, row| s.is_misspelt(row) == misspelt && refuses(s, row));
        let needs: Vec<Choice> = smallest.iter().copied().enumerate().filter(|(_, l)| *l != 0).collect();
        let learned = match needs[..] {
            [] => {
                let line = self.case(&smallest).line();
                report.failed(self.command, &format!("the command alone is refused: {line}"), "");
                false
            }
            // of what the definition refuses, an option may be missing that another needs
            _ if misspelt || needs.len() == 1 => self.learn_wanted(&needs, &smallest, refuses, report),
            _ => self.refused.all_of(needs),
        };
        self.refusals.push(smallest);
        learned
    }

    /// Learns what choices want beside them that are refused without: options that are at rest in `row`.
    fn learn_wanted(
        &mut self,
        needs: &[Choice],
        row: &[usize],
        refuses: &dyn Fn(&Self, &[usize]) -> bool,
        report: &mut Report,
    ) -> bool {
        let with = |s: &Self, choices: &[Choice]| {
            let mut row = row.to_vec();
            choices.iter().for_each(|(f, level)| row[*f] = *level);
            refuses(s, &row)
        };
        let resting: Vec<usize> = (0..row.len()).filter(|f| needs.iter().all(|n| n.0 != *f)).collect();
        let mut wanted: Vec<(usize, Vec<usize>)> = Vec::new();
        for &other in &resting {
            let levels = 0..self.factors[other].levels.len();
            let bad: Vec<usize> = levels.clone().filter(|level| with(self, &[(other, *level)])).collect();
            if bad.len() < levels.len() {
                wanted.push((other, bad));
            }
        }
        let together = |more: &[Choice]| [needs, more].concat();
        match &wanted[..] {
            [] => {
                let [one] = needs else { return self.refused.all_of(needs.to_vec()) };
                match self.company(*one, refuses) {
                    Some(pairs) => {
                        pairs.into_iter().map(|c| self.refused.pair(*one, c)).fold(false, |a, b| a | b)
                    }
                    None => {
                        let line = self.case(row).line();
                        report.failed(self.command, &format!("a value that is always refused: {line}"), "");
                        let others = resting.iter();
                        let pairs =
                            others.flat_map(|&f| (0..self.factors[f].levels.len()).map(move |l| (f, l)));
                        pairs.map(|other| self.refused.pair(*one, other)).fold(false, |a, b| a | b)
                    }
                }
            }
            [(other, bad)] => {
                let each = bad.iter().map(|l| together(&[(*other, *l)]));
                each.map(|all| self.refused.all_of(all)).fold(false, |a, b| a | b)
            }
            several => {
                let at_rest: Vec<Choice> = several.iter().map(|(f, _)| (*f, 0)).collect();
                self.refused.all_of(together(&at_rest))
            }
        }
    }

    /// The choices beside which one is refused, by a row that went well and all that it needs of it; none if
    /// it never does.
    fn company(&self, one: Choice, refuses: &dyn Fn(&Self, &[usize]) -> bool) -> Option<Vec<Choice>> {
        let with = |row: &[usize], choice: Choice| {
            let mut row = row.to_vec();
            row[choice.0] = choice.1;
            row
        };
        let has_one = |row: &&Row| row[one.0] == one.1;
        let rows = self.good.iter().filter(has_one).chain(self.good.iter().filter(|r| !has_one(r)));
        let row = rows.map(|row| with(row, one)).find(|row| !refuses(self, row))?;
        let row = self.smallest_beside(one.0, &row, &|s, row| !refuses(s, row));
        let needed = (0..row.len()).filter(|f| *f != one.0 && row[*f] != 0);
        let choices = needed.flat_map(|f| (0..self.factors[f].levels.len()).map(move |l| (f, l)));
        Some(choices.filter(|choice| refuses(self, &with(&row, *choice))).collect())
    }

    /// Counts a fault under the smallest set of choices that has it.
    fn count(&mut self, row: &[usize], fault: oracles::Fault, report: &mut Report) {
        let has = |needs: &[Choice]| needs.iter().all(|(f, level)| row[*f] == *level);
        if self.known.iter().any(|k| k.oracle == fault.oracle && has(&k.needs)) {
            report.again();
            return;
        }
        let still = |s: &Self, row: &[usize]| match oracles::judge(&s.case(row), 0, s.inputs) {
            Verdict::Bad(faults) => faults.iter().any(|f| f.oracle == fault.oracle),
            _ => false,
        };
        let smallest = if self.case(row).is_dear() { row.to_vec() } else { self.smallest(row, &still) };
        let needs = smallest.iter().copied().enumerate().filter(|(_, l)| *l != 0).collect();
        let line = self.case(&smallest).line();
        self.known.push(Known { oracle: fault.oracle, needs });
        report.failed(self.command, &format!("{}: {line}", fault.oracle), &fault.found);
    }

    /// Every refusal that was found is one line, at once, and nothing is done.
    fn check_refusals(&mut self, report: &mut Report) {
        self.refusals.sort();
        self.refusals.dedup();
        let rows = std::mem::take(&mut self.refusals);
        report.refused(rows.len());
        for (row, verdict) in rows.iter().zip(self.judged(&rows)) {
            if let Verdict::Bad(faults) = verdict {
                faults.into_iter().for_each(|f| self.count(row, f, report));
            }
        }
    }
}
