//! Extinction.

use super::{Better, Metric, MetricSource, Statistic};
use crate::estimators::view::GIA_OBSERVER_DEG;

/// Extinction.
pub static EXTINCTION: Metric = Metric {
    name: "extinction",
    about: "share of the outline that is dark without being a window",
    unit: "",
    range: (0.0, 1.0),
    scale: 1.0,
    better: Better::Less,
    observer: Some(GIA_OBSERVER_DEG),
    by_beams: false,
    nonconvex: false,
    definition: "Parallel face-up view traced backward over the whole outline; unpolarised light, \
        Fresnel with its polarisation followed inside (scalar with --polarisation off), D line (for a \
        stone that absorbs, luminance under D65). White dome above the horizon with a dark observer \
        cone of 23° half-angle, or --observer. Share of the outline, windowing aside, whose luminance \
        is under a tenth of the dome's, by whatever facet, reflection at entry included.",
    source: "the faceters' extinction, as defined by cutlab",
    read_from: MetricSource::View(Statistic::Share(|t| [t.dark, t.rays])),
};
