//! Windowing.

use super::{Better, Metric, MetricSource, Statistic};

/// Windowing.
pub static WINDOWING: Metric = Metric {
    name: "windowing",
    about: "share of the outline through which one looks straight out of the bottom",
    unit: "",
    range: (0.0, 1.0),
    scale: 1.0,
    better: Better::Less,
    observer: None,
    by_beams: true,
    nonconvex: false,
    definition: "Parallel face-up view traced backward over the whole outline; unpolarised light, \
        Fresnel with its polarisation followed inside (scalar with --polarisation off), D line (for a \
        stone that absorbs, luminance under D65). No observer's head. Share of the outline whose \
        strongest path leaves through the first pavilion facet (or culet) that it meets; reflection \
        at entry not counted.",
    source: "the faceters' window, as defined by cutlab",
    read_from: MetricSource::View(Statistic::Share(|t| [t.windowed, t.rays])),
};
