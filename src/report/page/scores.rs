//! Scores on the page: under their heads, beside those of the reference stones.

use crate::metrics::Better;
use crate::report::estimates::estimate_html;
use crate::report::references::STONES;
use crate::sampling::stats::Estimate;
use maud::{Markup, html};

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
    pub(super) fn row(&self) -> Markup {
        html! {
            tr {
                th scope="row" {
                    code { (self.name) }
                    span {
                        (self.about)
                        @if !self.better.said().is_empty() { "; " em { (self.better.said()) } }
                    }
                }
                td class="value" { (self.value_html()) }
                @for ((name, ..), value) in STONES.iter().zip(self.references) {
                    td class="other" data-stone=(name) { (estimate_html(value, "")) }
                }
            }
            "\n"
        }
    }

    /// The value with its unit and error; a dash if there is none, with the reason.
    pub(super) fn value_html(&self) -> Markup {
        match &self.left_out {
            Some(why) => html! { span title=(why) { "–" } },
            None => estimate_html(self.value, &self.unit),
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
        assert_eq!(section.scores[0].value_html().into_string(), "<span title=\"no x\">–</span>");
        let whole = Section { scores: vec![score("b", None)], ..section };
        assert_eq!(whole.omissions(), None);
    }
}
