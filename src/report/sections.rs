//! The heads of a report and the scores under them, the ones that matter first.

use super::page::{Score, Section};
use crate::math::stats::Estimate;
use crate::metrics::{METRICS, Metric};

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
        about: "How much light comes back to someone who looks at the crown. Fractions of the light, D line.",
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

/// One line for people; the full definition of a score is in `cutlab list metrics`. A score without
/// a line here shows its definition.
const MEANINGS: &[(&str, &str)] = &[
    (
        "wlr",
        "weighted light return: white light from a dome, returned through the crown, most weight face-up",
    ),
    ("light_return", "share of a dome's light that comes back up through the crown, from inside"),
    ("glare", "share mirrored by the crown's surface without entering"),
    ("leakage", "share that leaves otherwise: through the pavilion, or downward through the crown"),
    ("lost", "share no longer followed: the error of the figures above"),
    ("aset_green", "share of what one sees face-up that comes from low light, 0–45°"),
    ("aset_red", "share from 45–75°, the light that matters most"),
    ("aset_blue", "share from 75–90°, where the viewer's head is: contrast"),
    ("aset_leak", "share from below: windows"),
    ("aset_green_strongest", "share of the outline whose strongest path is green, as in the picture"),
    ("aset_red_strongest", "share of the outline whose strongest path is red"),
    ("aset_blue_strongest", "share of the outline whose strongest path is blue"),
    ("leakage_strongest", "share of the outline whose strongest path comes from below"),
    (
        "fire_lit",
        "area of the beams that a point light sends out of the crown, per area of the stone (surrogate of GIA's DCLR)",
    ),
    (
        "fire_streak",
        "length of the colour streaks, line B to G, summed over the beams that a point light sends out of the crown (surrogate of GIA's DCLR)",
    ),
    (
        "dispersion_mean",
        "mean angle between lines B and G of one exit, by power; read it beside light return",
    ),
];

/// The sections of a report.
///
/// - `scores`: every metric of the catalogue with its value, none where it does not apply
pub fn sections(scores: &[(&'static Metric, Option<Estimate>)]) -> Vec<Section> {
    let line = |&(metric, value): &(&'static Metric, Option<Estimate>)| Score {
        name: metric.name.into(),
        about: meaning(metric).into(),
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

fn meaning(metric: &Metric) -> &'static str {
    MEANINGS.iter().find(|(name, _)| *name == metric.name).map_or(metric.definition, |(_, text)| text)
}

/// Every metric of the catalogue, in its order.
pub fn all_metrics() -> Vec<&'static Metric> {
    METRICS.to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_metric_stands_under_one_head_and_has_a_line() {
        let scores: Vec<_> = METRICS.iter().map(|m| (*m, None)).collect();
        let sections = sections(&scores);
        let names: Vec<&str> = sections.iter().flat_map(|s| &s.scores).map(|s| s.name.as_str()).collect();
        for metric in METRICS {
            assert_eq!(names.iter().filter(|n| **n == metric.name).count(), 1, "{}", metric.name);
            assert_ne!(meaning(metric), metric.definition, "{} has no line in MEANINGS", metric.name);
        }
        for (name, _) in MEANINGS {
            assert!(Metric::named(name).is_some(), "{name} is no metric");
        }
    }
}
