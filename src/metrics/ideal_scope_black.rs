//! Ideal-Scope: light that comes from the viewer himself.

use super::{Better, Metric, MetricSource, Statistic};
use crate::estimators::view::SCOPE_DEG;

/// Ideal-Scope: light that comes from the viewer himself.
pub static IDEAL_SCOPE_BLACK: Metric = Metric {
    name: "ideal_scope_black",
    about: "share of what one sees face-up that comes from the viewer himself (Ideal-Scope black)",
    unit: "",
    range: (0.0, 1.0),
    scale: 1.0,
    better: Better::Neither,
    observer: Some(SCOPE_DEG),
    by_beams: true,
    nonconvex: true,
    definition: "Parallel face-up view traced backward over the whole outline; unpolarised light, \
        Fresnel with its polarisation followed inside (scalar with --polarisation off), D line (for a \
        stone that absorbs, luminance under D65). Share of the sight lines' power that comes from \
        within the dark cone about the viewer, by whatever facet; reflection at entry not counted. \
        The cone's half-angle is 12° (about 24° are blocked in all), or --observer.",
    source: "colours of the Ideal-Scope (K. Okuda, 1984; G. Holloway): red return, white leakage, black viewer",
    read_from: MetricSource::View(Statistic::Mean(|t| [t.scope_dark, t.rays], 1.0)),
};
