//! A comparison as text, Markdown and CSV.

use crate::batch::table::{TableCell, TableError, TableFormat};
use crate::cli::terminal_table;
use crate::design::proportions;
use crate::materials::weight::Weight;
use crate::metrics::Better;
use crate::report::estimates::plus;
use crate::report::{ReportInput, comparison_page};
use crate::sampling::stats::Estimate;
use crate::scoring::comparison::Comparison;
use crate::scoring::score::ScoreRequest;
use crate::storage::terminal::in_line;

/// Up to so many stones have a column each and a line for each metric, else a line each.
const MOST_COLUMNS: usize = 4;

/// What is compared.
pub struct Compared<'a> {
    /// One a stone.
    pub requests: &'a [ReportInput],
    /// Their scores.
    pub comparison: &'a Comparison,
    /// What was scored.
    pub plan: &'a ScoreRequest,
}

/// A measure of every stone that has no error.
struct MeasureRow {
    name: &'static str,
    unit: &'static str,
    values: Vec<Option<f64>>,
    /// Why a stone may have none.
    why: &'static str,
}

impl Compared<'_> {
    /// Proportions and weight.
    fn measures(&self) -> Vec<MeasureRow> {
        type Of = fn(&proportions::Proportions, &ReportInput) -> Option<f64>;
        let all: [(&str, &str, Of, &str); 10] = [
            ("width", "mm", |p, _| Some(p.width), ""),
            ("length_to_width", "", |p, _| Some(p.length / p.width), ""),
            ("table", "%", |p, _| p.table_percent, "the stone has no table"),
            ("crown_angle", "°", |p, _| p.crown_angle_deg, "the crown has no inclined facets"),
            ("crown_height", "%", |p, _| Some(p.crown_height_percent), ""),
            ("pavilion_angle", "°", |p, _| p.pavilion_angle_deg, "the pavilion has no inclined facets"),
            ("pavilion_depth", "%", |p, _| Some(p.pavilion_depth_percent), ""),
            ("girdle", "%", |p, _| Some(p.girdle_percent), ""),
            ("depth", "%", |p, _| Some(p.depth_percent), ""),
            (
                "weight",
                "ct",
                |p, request| Weight::new(&request.material).carats(p.volume),
                "the density of what it is made of is not known; --material names a material that has one",
            ),
        ];
        let measured: Vec<_> = self.requests.iter().map(|r| proportions::of_design(&r.design).ok()).collect();
        let each =
            |of: Of| measured.iter().zip(self.requests).map(move |(p, r)| of(p.as_ref()?, r)).collect();
        let measure = |(name, unit, of, why)| MeasureRow { name, unit, values: each(of), why };
        all.into_iter().map(measure).collect()
    }

    /// The heads of the stones' columns: name and material.
    fn heads(&self) -> Vec<String> {
        let labels = comparison_page::labels(&self.names());
        labels.iter().zip(self.requests).map(|(label, r)| format!("{label} ({})", r.material.name)).collect()
    }

    /// What must be known about the weights, a line each.
    pub fn weight_notes(&self) -> Vec<String> {
        let said = |r: &ReportInput| {
            Some(format!("weight of {}: {}", in_line(&r.stone), Weight::new(&r.material).note()?))
        };
        self.requests.iter().filter_map(said).collect()
    }

    fn names(&self) -> Vec<&str> {
        self.comparison.rows.iter().map(|r| r.stone.as_str()).collect()
    }

    fn score(&self, stone: usize, metric: usize) -> String {
        self.comparison.rows[stone].scores[metric]
            .map_or_else(|| terminal_table::NONE.into(), terminal_table::format_estimate)
    }

    fn difference(&self, stone: usize, metric: usize) -> Option<Estimate> {
        stone.checked_sub(1).and_then(|other| self.comparison.differences[other][metric])
    }

    fn is_significant(&self, stone: usize, metric: usize) -> bool {
        let other = stone.checked_sub(1);
        other.and_then(|other| self.comparison.is_significant(other, metric)) == Some(true)
    }

    fn mark(&self, stone: usize, metric: usize) -> &'static str {
        if self.is_significant(stone, metric) { " *" } else { "" }
    }

    /// A line for each metric: its name, the scores, the differences from the first, its unit.
    fn by_metric(&self) -> (Vec<String>, Vec<Vec<String>>) {
        let (heads, stones) = (self.heads(), self.requests.len());
        let labels = comparison_page::labels(&self.names());
        let mut head = vec![String::new()];
        head.extend(heads);
        head.extend(labels[1..].iter().map(|label| format!("{label} less {}", labels[0])));
        head.extend(["unit".into(), "better".into()]);
        let mut lines = Vec::new();
        for (m, metric) in self.plan.metrics.iter().enumerate() {
            let mut line = vec![metric.name.to_owned()];
            line.extend((0..stones).map(|s| self.score(s, m)));
            line.extend((1..stones).map(|s| {
                let d = self.difference(s, m);
                let shown = d.map_or_else(|| terminal_table::NONE.into(), terminal_table::format_estimate);
                format!("{}{shown}{}", d.map_or("", plus), self.mark(s, m))
            }));
            line.extend([metric.unit, metric.better.word()].map(String::from));
            lines.push(line);
        }
        for measure in self.measures() {
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
        head.extend(self.plan.metrics.iter().map(|m| m.name.to_owned()));
        let line = |s: usize| {
            let mut line = vec![in_line(&self.requests[s].stone), self.requests[s].material.name.to_string()];
            let cell = |m| format!("{}{}", self.score(s, m), self.mark(s, m));
            line.extend((0..self.plan.metrics.len()).map(cell));
            line
        };
        (head, (0..self.requests.len()).map(line).collect())
    }

    /// What the marks and labels stand for, a line each.
    fn legend(&self) -> Vec<String> {
        let mut lines = Vec::new();
        if self.requests.len() <= MOST_COLUMNS {
            lines = comparison_page::explained(&self.names());
        }
        lines.extend(comparison_page::left_out(self.comparison));
        lines.extend(self.weight_notes());
        for better in [Better::More, Better::Less].iter().filter(|_| self.requests.len() > MOST_COLUMNS) {
            let which = self.plan.metrics.iter().filter(|m| m.better == *better);
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
        if self.requests.len() <= MOST_COLUMNS { self.by_metric() } else { self.by_stone() }
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

    /// The same as a table with a row for each metric and stone; where a stone has no score or no such
    /// measure its row says why.
    pub fn table(&self, form: TableFormat) -> Result<Vec<u8>, TableError> {
        let columns = COLUMNS.map(String::from);
        let mut rows: Vec<Vec<TableCell>> = Vec::new();
        let cell = |x: Option<f64>| x.map_or(TableCell::Empty(()), TableCell::number);
        let mut add = |stone: usize, (words, why): ([&str; 3], Option<&str>), values: [_; 2], mark: bool| {
            let ([name, unit, better], [score, difference]): (_, [Option<Estimate>; 2]) = (words, values);
            let significant = difference.map(|_| if mark { "yes" } else { "no" });
            let request = &self.requests[stone];
            rows.push(vec![
                name.into(),
                unit.into(),
                Some(better).filter(|word| !word.is_empty()).into(),
                request.stone.as_str().into(),
                request.material.name.as_ref().into(),
                cell(score.map(|e| e.value)),
                cell(score.map(|e| e.error)),
                cell(difference.map(|e| e.value)),
                cell(difference.map(|e| e.error)),
                significant.into(),
                why.filter(|_| score.is_none()).into(),
            ]);
        };
        for (m, metric) in self.plan.metrics.iter().enumerate() {
            for (s, row) in self.comparison.rows.iter().enumerate() {
                let d = self.difference(s, m);
                let why = row.why_left_out(metric).or(row.error.as_deref());
                let words = [metric.name, metric.unit, metric.better.word()];
                add(s, (words, why), [row.scores[m], d], self.is_significant(s, m));
            }
        }
        for measure in self.measures() {
            let first = measure.values[0];
            for (s, value) in measure.values.iter().enumerate() {
                let difference = value.zip(first).filter(|_| s > 0).map(|(v, f)| Estimate::exact(v - f));
                let differs = difference.is_some_and(|d| d.value.abs() > 1e-9);
                let said = ([measure.name, measure.unit, ""], Some(measure.why));
                add(s, said, [value.map(Estimate::exact), difference], differs);
            }
        }
        let mut out = form.head(&columns)?;
        for (i, row) in rows.iter().enumerate() {
            out.extend_from_slice(form.before(i as u64));
            out.extend(form.row(&columns, row)?);
        }
        out.extend_from_slice(form.tail(rows.len() as u64));
        Ok(out)
    }
}

/// Columns of [`Compared::table`]; `difference` is from the first stone.
pub const COLUMNS: [&str; 11] = [
    "metric",
    "unit",
    "better",
    "stone",
    "material",
    "value",
    "value_se",
    "difference",
    "difference_se",
    "significant",
    "left_out",
];
