//! The heads of a report and the scores under them, the ones that matter first.

use super::page::{Score, Section};
use crate::math::stats::Estimate;
use crate::metrics::Metric;

/// A head, and under it the scores that are shown large, then those that follow.
struct Head {
    name: &'static str,
    about: &'static str,
    large: &'static [&'static str],
    /// Whether a score that stands nowhere by name belongs here.
    takes: fn(&Metric) -> bool,
}

const HEADS: [Head; 2] = [
    Head {
        name: "Brilliance",
        about: "How much light comes back to someone who looks at the crown. D line.",
        large: &["wlr", "leakage"],
        takes: |m| !m.needs_dispersion(),
    },
    Head {
        name: "Dispersion",
        about: "How widely the stone spreads colours, for a point light straight above.",
        large: &["fire_streak", "dispersion_mean"],
        takes: Metric::needs_dispersion,
    },
];

/// The sections of a report.
///
/// - `scores`: every metric of the catalogue with its value, none where it does not apply
pub fn sections(scores: &[(&'static Metric, Option<Estimate>)]) -> Vec<Section> {
    let line = |&(metric, value): &(&'static Metric, Option<Estimate>)| Score {
        name: metric.name.into(),
        about: metric.about.into(),
        unit: metric.unit.into(),
        value,
    };
    HEADS
        .iter()
        .map(|head| {
            let first = head.large.iter().filter_map(|name| scores.iter().find(|(m, _)| m.name == *name));
            let rest = scores.iter().filter(|(m, _)| (head.takes)(m) && !head.large.contains(&m.name));
            Section {
                head: head.name,
                about: head.about,
                large: head.large.len(),
                scores: first.chain(rest).map(line).collect(),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::METRICS;

    #[test]
    fn every_metric_stands_under_one_head() {
        let scores: Vec<_> = METRICS.iter().map(|m| (*m, None)).collect();
        let sections = sections(&scores);
        let names: Vec<&str> = sections.iter().flat_map(|s| &s.scores).map(|s| s.name.as_str()).collect();
        for metric in METRICS {
            assert_eq!(names.iter().filter(|n| **n == metric.name).count(), 1, "{}", metric.name);
        }
    }
}
