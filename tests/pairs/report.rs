//! What was found over all commands.

use std::collections::BTreeMap;
use std::time::Duration;

/// Counts and failures.
#[derive(Debug, Default)]
pub struct Report {
    now: Counts,
    all: Counts,
    /// Each kind of failure: how many cases have it, and the smallest command that shows it.
    pub kinds: BTreeMap<String, (usize, String)>,
}

#[derive(Debug, Default, Clone, Copy)]
struct Counts {
    cases: usize,
    pairs: usize,
    refused: usize,
    failures: usize,
    kinds: usize,
}

impl Counts {
    fn line(&self) -> String {
        let Counts { cases, pairs, refused, failures, kinds } = self;
        format!("{pairs} pairs, {refused} refusals, {cases} cases, {failures} failures of {kinds} kinds")
    }

    fn add(&mut self, other: Counts) {
        self.cases += other.cases;
        self.pairs += other.pairs;
        self.refused += other.refused;
        self.failures += other.failures;
        self.kinds += other.kinds;
    }
}

impl Report {
    /// A command begins that has so many pairs of choices.
    pub fn begins(&mut self, command: &str, pairs: usize) {
        eprintln!("{command} …");
        self.now.pairs = pairs;
    }

    /// Counts cases.
    pub fn ran(&mut self, cases: usize) {
        self.now.cases += cases;
    }

    /// Counts refusals.
    pub fn refused(&mut self, refusals: usize) {
        self.now.refused += refusals;
    }

    /// Counts a failure of a kind.
    pub fn failed(&mut self, command: &str, oracle: &str, example: &str) {
        self.now.failures += 1;
        let kind = self.kinds.entry(format!("{command}: {oracle}"));
        let kind = kind.or_insert_with(|| {
            eprintln!("  {oracle}\n    {example}");
            self.now.kinds += 1;
            (0, example.into())
        });
        kind.0 += 1;
    }

    /// Counts a failure of a kind that is there already.
    pub fn again(&mut self) {
        self.now.failures += 1;
    }

    /// A command is through: its figures in one line.
    pub fn ends(&mut self, command: &str, took: Duration) {
        eprintln!("{command}: {}, {:.0} s", self.now.line(), took.as_secs_f64());
        self.all.add(std::mem::take(&mut self.now));
    }

    /// Takes what was found over other commands.
    pub fn add(&mut self, other: Report) {
        self.all.add(other.all);
        self.kinds.extend(other.kinds);
    }

    /// The figures of all commands in one line.
    pub fn summary(&self) -> String {
        self.all.line()
    }

    /// The kinds, one a line.
    pub fn text(&self) -> String {
        let line =
            |(kind, (n, example)): (&String, &(usize, String))| format!("{n:4} × {kind}\n       {example}\n");
        format!("{}\n{}", self.summary(), self.kinds.iter().map(line).collect::<String>())
    }
}
