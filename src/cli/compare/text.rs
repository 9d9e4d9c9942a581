//! A comparison as text and Markdown.

use crate::batch::comparison::StoneComparison;
use crate::cli::terminal_table;
use crate::materials::weight::Weight;
use crate::metrics::Better;
use crate::report::comparison_page;
use crate::report::estimates::plus;
use crate::stone::Stone;
use crate::storage::terminal::in_line;

/// Up to so many stones have a column each and a line for each metric, else a line each.
const MOST_COLUMNS: usize = 4;

/// A comparison, written for people.
pub struct ComparisonText<'a>(pub &'a StoneComparison);

impl ComparisonText<'_> {
    /// The heads of the stones' columns: name and material.
    fn heads(&self) -> Vec<String> {
        let labels = comparison_page::labels(&self.names());
        let head = |(label, stone): (&String, &Stone)| format!("{label} ({})", stone.material().name);
        labels.iter().zip(&self.0.stones).map(head).collect()
    }

    /// What must be known about the weights, a line each.
    pub fn weight_notes(&self) -> Vec<String> {
        let said = |stone: &Stone| {
            let note = Weight::new(stone.material()).note()?;
            Some(format!("weight of {}: {note}", in_line(stone.name())))
        };
        self.0.stones.iter().filter_map(said).collect()
    }

    fn names(&self) -> Vec<&str> {
        self.0.comparison.rows.iter().map(|r| r.stone.as_str()).collect()
    }

    fn score(&self, stone: usize, metric: usize) -> String {
        self.0.comparison.rows[stone].scores[metric]
            .map_or_else(|| terminal_table::NONE.into(), terminal_table::format_estimate)
    }

    fn mark(&self, stone: usize, metric: usize) -> &'static str {
        if self.0.is_significant(stone, metric) { " *" } else { "" }
    }

    /// A line for each metric: its name, the scores, the differences from the first, its unit.
    fn by_metric(&self) -> (Vec<String>, Vec<Vec<String>>) {
        let (heads, stones) = (self.heads(), self.0.stones.len());
        let labels = comparison_page::labels(&self.names());
        let mut head = vec![String::new()];
        head.extend(heads);
        head.extend(labels[1..].iter().map(|label| format!("{label} less {}", labels[0])));
        head.extend(["unit".into(), "better".into()]);
        let mut lines = Vec::new();
        for (m, metric) in self.0.scores().metrics.iter().enumerate() {
            let mut line = vec![metric.name.to_owned()];
            line.extend((0..stones).map(|s| self.score(s, m)));
            line.extend((1..stones).map(|s| {
                let d = self.0.difference(s, m);
                let shown = d.map_or_else(|| terminal_table::NONE.into(), terminal_table::format_estimate);
                format!("{}{shown}{}", d.map_or("", plus), self.mark(s, m))
            }));
            line.extend([metric.unit, metric.better.word()].map(String::from));
            lines.push(line);
        }
        for measure in self.0.measures() {
            let shown =
                |v: &Option<f64>| v.map_or_else(|| terminal_table::NONE.to_owned(), |v| format!("{v:.2}"));
            let mut line = vec![measure.name.to_owned()];
            line.extend(measure.values.iter().map(shown));
            let first = measure.values[0];
            line.extend(measure.values[1..].iter().map(|v| match (v, first) {
                (Some(v), Some(first)) if (v - first).abs() < 0.005 => "0.00".to_owned(),
                (Some(v), Some(first)) => format!("{:+.2}", v - first),
                _ => terminal_table::NONE.to_owned(),
            }));
            line.extend([measure.unit, ""].map(String::from));
            lines.push(line);
        }
        (head, lines)
    }

    /// A line for each stone: its name, its material, its scores.
    fn by_stone(&self) -> (Vec<String>, Vec<Vec<String>>) {
        let mut head = vec!["stone".to_owned(), "material".to_owned()];
        head.extend(self.0.scores().metrics.iter().map(|m| m.name.to_owned()));
        let line = |s: usize| {
            let stone = &self.0.stones[s];
            let mut line = vec![in_line(stone.name()), stone.material().name.to_string()];
            let cell = |m| format!("{}{}", self.score(s, m), self.mark(s, m));
            line.extend((0..self.0.scores().metrics.len()).map(cell));
            line
        };
        (head, (0..self.0.stones.len()).map(line).collect())
    }

    /// What the marks and labels stand for, a line each.
    fn legend(&self) -> Vec<String> {
        let mut lines = Vec::new();
        if self.0.stones.len() <= MOST_COLUMNS {
            lines = comparison_page::explained(&self.names());
        }
        lines.extend(comparison_page::left_out(&self.0.comparison));
        lines.extend(self.weight_notes());
        for better in [Better::More, Better::Less].iter().filter(|_| self.0.stones.len() > MOST_COLUMNS) {
            let which = self.0.scores().metrics.iter().filter(|m| m.better == *better);
            let names: Vec<&str> = which.map(|m| m.name).collect();
            if !names.is_empty() {
                lines.push(format!("{}: {}", better.said(), names.join(", ")));
            }
        }
        lines.push(
            "after ± one standard error; * differs from the first by more than three errors of the difference, \
             and not negligibly"
                .into(),
        );
        lines
    }

    fn grid(&self) -> (Vec<String>, Vec<Vec<String>>) {
        if self.0.stones.len() <= MOST_COLUMNS { self.by_metric() } else { self.by_stone() }
    }

    /// The table for people.
    pub fn text(&self) -> String {
        let (head, lines) = self.grid();
        let mut table = terminal_table::new();
        table.set_header(head);
        table.add_rows(lines);
        let legend: String = self.legend().iter().map(|line| format!("{line}\n")).collect();
        terminal_table::lines(&table) + &legend
    }

    /// The same as Markdown.
    pub fn markdown(&self) -> String {
        let (head, lines) = self.grid();
        let row = |cells: &[String]| {
            let cells: Vec<String> = cells
                .iter()
                .map(|c| c.replace('\\', "\\\\").replace('|', "\\|").replace('<', "&lt;"))
                .collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let rule = format!("|{}\n", " --- |".repeat(head.len()));
        let body: String = lines.iter().map(|line| row(line)).collect();
        let legend = self.legend().join("  \n").replace('*', "\\*").replace('<', "&lt;");
        format!("{}{rule}{body}\n{legend}\n", row(&head))
    }
}
