//! One command: a choice for each option.

use crate::factors::Factor;
use crate::samples;

/// A command with its options.
#[derive(Debug, Clone)]
pub struct Case {
    /// The subcommand.
    pub command: String,
    parts: Vec<Part>,
}

#[derive(Debug, Clone)]
struct Part {
    id: String,
    words: Vec<String>,
    positional: bool,
}

impl Case {
    /// The one that takes level `row[f]` of each factor f.
    pub fn new(command: &str, factors: &[Factor], row: &[usize]) -> Case {
        let part = |(f, level): (&Factor, &usize)| Part {
            id: f.id.clone(),
            words: f.levels[*level].clone(),
            positional: f.positional,
        };
        Case { command: command.into(), parts: factors.iter().zip(row).map(part).collect() }
    }

    /// What is typed after `cutlab`.
    pub fn words(&self) -> Vec<String> {
        let of = |positional: bool| self.parts.iter().filter(move |p| p.positional == positional);
        let mut words = vec![self.command.clone()];
        words.extend(of(false).flat_map(|p| p.words.clone()));
        words.extend(samples::tamed(&self.command, &words));
        words.extend(of(true).flat_map(|p| p.words.clone()));
        words
    }

    /// What is typed, in one line.
    pub fn line(&self) -> String {
        format!("cutlab {}", self.words().join(" "))
    }

    /// Whether the option is given.
    pub fn has(&self, id: &str) -> bool {
        self.parts.iter().any(|p| p.id == id && !p.words.is_empty())
    }

    /// The values of an option.
    pub fn values(&self, id: &str) -> Vec<&str> {
        let Some(part) = self.parts.iter().find(|p| p.id == id) else { return Vec::new() };
        part.words.iter().filter(|w| !w.starts_with("--")).map(String::as_str).collect()
    }

    /// The same with other words for an option.
    pub fn with(&self, id: &str, words: &[&str]) -> Case {
        let mut case = self.clone();
        case.parts
            .iter_mut()
            .filter(|p| p.id == id)
            .for_each(|p| p.words = words.iter().map(|w| w.to_string()).collect());
        case
    }

    /// Whether standard output is a file of the command's own.
    pub fn streams(&self) -> bool {
        let by_default = ["score", "sweep"].contains(&self.command.as_str()) && !self.has("output");
        by_default || ["output", "beams", "diagram"].iter().any(|id| self.values(id).contains(&"-"))
    }

    /// The same without some options.
    pub fn without(&self, ids: &[&str]) -> Case {
        ids.iter().fold(self.clone(), |case, id| case.with(id, &[]))
    }

    /// Whether it takes seconds: a page.
    pub fn is_dear(&self) -> bool {
        let has_page = ["compare", "optimise"].contains(&self.command.as_str());
        self.command == "report" || (has_page && self.values("output").contains(&"out"))
    }

    /// Whether its rows have scores, of which some may be missing.
    pub fn gives_scores(&self) -> bool {
        self.makes_table() || self.command == "compare"
    }

    /// Whether it makes or joins a table of scores.
    pub fn makes_table(&self) -> bool {
        ["score", "sweep", "merge"].contains(&self.command.as_str())
    }
}
