//! Scores on the page: under their heads, beside those of the reference stones.

use crate::metrics::Better;
use crate::report::estimates::estimate_html;
use crate::report::html::escaped;
use crate::report::references::STONES;
use crate::sampling::stats::Estimate;
use std::fmt::Write;

/// One score on the page.
#[derive(Debug, Clone)]
pub struct PageScore {
    /// Its name in the table of scores.
    pub name: String,
    /// One line on what it means.
    pub about: String,
    /// Which values are the better.
    pub better: Better,
    /// `%`, `°` or empty.
    pub unit: String,
    /// Value with standard error; none if the metric has no value here.
    pub value: Option<Estimate>,
    /// Why it has none.
    pub left_out: Option<String>,
    /// The same of the reference stones.
    pub references: [Option<Estimate>; STONES.len()],
}

/// A head with its scores, the ones that matter first.
#[derive(Debug, Clone)]
pub struct Section {
    /// Brilliance, Dispersion and others.
    pub head: &'static str,
    /// One line on what the head is about.
    pub about: &'static str,
    /// How many of the scores are shown large.
    pub large: usize,
    /// The scores.
    pub scores: Vec<PageScore>,
}

impl Section {
    /// Which scores are left out and why, each reason once; none if all are there.
    pub fn omissions(&self) -> Option<String> {
        let mut reasons: Vec<(&str, Vec<&str>)> = Vec::new();
        for score in &self.scores {
            let Some(why) = score.left_out.as_deref() else { continue };
            match reasons.iter_mut().find(|(reason, _)| *reason == why) {
                Some((_, names)) => names.push(&score.name),
                None => reasons.push((why, vec![&score.name])),
            }
        }
        let said = reasons.iter().map(|(why, names)| format!("{} left out: {why}", names.join(", ")));
        let said: Vec<String> = said.collect();
        (!said.is_empty()).then(|| said.join("; "))
    }
}

impl PageScore {
    /// The score's row beside the reference stones.
    pub(super) fn row(&self) -> String {
        let mut out = format!(
            "<tr><th scope=\"row\"><code>{}</code><span>{}{}</span></th><td class=\"value\">{}</td>",
            escaped(&self.name),
            escaped(&self.about),
            self.better_html(),
            self.value_html()
        );
        for ((name, ..), value) in STONES.iter().zip(self.references) {
            let _ =
                write!(out, "<td class=\"other\" data-stone=\"{name}\">{}</td>", estimate_html(value, ""));
        }
        out + "</tr>\n"
    }

    /// `; more is better`, or nothing.
    fn better_html(&self) -> String {
        match self.better.said() {
            "" => String::new(),
            said => format!("; <em>{said}</em>"),
        }
    }

    pub(super) fn value_html(&self) -> String {
        let unit = if self.unit.is_empty() { String::new() } else { format!(" {}", escaped(&self.unit)) };
        match &self.left_out {
            Some(why) => format!("<span title=\"{}\">–</span>", escaped(why)),
            None => estimate_html(self.value, &unit),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reason_is_said_once_under_a_head() {
        let score = |name: &str, why: Option<&str>| PageScore {
            name: name.into(),
            about: String::new(),
            better: Better::More,
            unit: String::new(),
            value: None,
            left_out: why.map(String::from),
            references: Default::default(),
        };
        let scores = vec![score("a", Some("no x")), score("b", None), score("c", Some("no x"))];
        let section = Section { head: "", about: "", large: 1, scores };
        assert_eq!(section.omissions().as_deref(), Some("a, c left out: no x"));
        assert_eq!(section.scores[0].value_html(), "<span title=\"no x\">–</span>");
        let whole = Section { scores: vec![score("b", None)], ..section };
        assert_eq!(whole.omissions(), None);
    }
}
