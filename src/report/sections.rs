//! The heads of a report and the scores under them, the ones that matter first.

use super::page::{PageScore, Section};
use super::references::References;
use crate::metrics::{Metric, MetricSource};
use crate::sampling::stats::Estimate;
use crate::scoring::score::ScoreRow;

/// A head, and under it the scores that are shown large, then those that follow.
struct Head {
    name: &'static str,
    about: &'static str,
    large: &'static [&'static str],
    /// Whether a score that no head before takes belongs here.
    takes: fn(&Metric) -> bool,
}

/// The heads; the last one takes what no other does, so that a new score is never left out.
const HEADS: [Head; 6] = [
    Head {
        name: "Brilliance",
        about: "How much light comes back to someone who looks at the crown. D line.",
        large: &["wlr", "leakage"],
        takes: |m| m.estimator.name() == "hemisphere" || m.name == "brightness",
    },
    Head {
        name: "Dispersion",
        about: "How widely the stone spreads colours, for a point light straight above.",
        large: &["fire_streak", "dispersion_mean"],
        takes: Metric::needs_dispersion,
    },
    Head {
        name: "Contrast and scintillation",
        about: "How much the face-up picture varies, and how much it changes when the stone is rocked.",
        large: &[],
        takes: |m| {
            ["contrast", "scintillation"].contains(&m.estimator.name())
                || ["extinction", "windowing"].contains(&m.name)
        },
    },
    Head {
        name: "Faceters’ scores",
        about: "Light return by the rules of faceters, of the whole stone and of the table alone, in percent.",
        large: &[],
        takes: |m| m.estimator.name() == "iso",
    },
    Head {
        name: "Weight and spread",
        about: "The solid alone, against Tolkowsky’s brilliant.",
        large: &[],
        takes: |m| matches!(m.read_from, MetricSource::Solid(_)),
    },
    Head {
        name: "Viewer maps",
        about: "Where the light of the face-up stone comes from, as the pictures show it: by power, and by \
                strongest path.",
        large: &[],
        takes: |_| true,
    },
];

/// The sections of a report.
///
/// - `row`: a score, or why there is none, for each of `metrics`
pub fn sections(metrics: &[&'static Metric], row: &ScoreRow, references: &References) -> Vec<Section> {
    let scores: Vec<(&'static Metric, Option<Estimate>)> =
        metrics.iter().copied().zip(row.scores.iter().copied()).collect();
    let line = |&(metric, value): &(&'static Metric, Option<Estimate>)| PageScore {
        name: metric.name.into(),
        about: metric.about.into(),
        better: metric.better,
        unit: metric.unit.into(),
        value,
        left_out: row.why_left_out(metric).map(String::from),
        references: references.scores(metric),
    };
    let home = |m: &Metric| HEADS.iter().position(|head| (head.takes)(m));
    HEADS
        .iter()
        .enumerate()
        .map(|(i, head)| {
            let here = || scores.iter().filter(move |(m, _)| home(m) == Some(i));
            let first = head.large.iter().filter_map(|name| here().find(|(m, _)| m.name == *name));
            let rest = here().filter(|(m, _)| !head.large.contains(&m.name));
            Section {
                head: head.name,
                about: head.about,
                large: head.large.len(),
                scores: first.chain(rest).map(line).collect(),
            }
        })
        .filter(|section| !section.scores.is_empty())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::materials::Material;
    use crate::metrics::METRICS;
    use crate::scoring::score::{ScoreInput, ScoreRequest, score};

    #[test]
    fn every_metric_stands_under_one_head() {
        let nothing = ScoreInput {
            stone: String::new(),
            material: Material::from_index(1.5),
            shape: Err("none".into()),
            tilt: None,
        };
        let row = score(&nothing, &ScoreRequest::default());
        let sections = sections(&METRICS, &row, &References::read().expect("can be read"));
        let names: Vec<&str> = sections.iter().flat_map(|s| &s.scores).map(|s| s.name.as_str()).collect();
        for metric in METRICS.iter() {
            assert_eq!(names.iter().filter(|n| **n == metric.name).count(), 1, "{}", metric.name);
        }
        assert!(sections.iter().all(|s| s.large <= s.scores.len()));
    }
}
