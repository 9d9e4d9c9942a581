//! Ideal-Scope: light that comes back from around the viewer.

use super::{Better, Metric, MetricSource, Statistic};
use crate::estimators::view::SCOPE_DEG;

/// Ideal-Scope: light that comes back from around the viewer.
pub static IDEAL_SCOPE_RED: Metric = Metric {
    name: "ideal_scope_red",
    about: "share of what one sees face-up that comes back from around the viewer (Ideal-Scope red)",
    unit: "",
    range: (0.0, 1.0),
    scale: 1.0,
    better: Better::More,
    observer: Some(SCOPE_DEG),
    by_beams: true,
    nonconvex: true,
    definition: "Parallel face-up view traced backward over the whole outline; unpolarised light, \
        Fresnel with its polarisation followed inside (scalar with --polarisation off), D line (for a \
        stone that absorbs, luminance under D65). Share of the sight lines' power that comes from \
        above the horizon, outside the dark cone about the viewer, by whatever facet; reflection at \
        entry not counted. The cone's half-angle is 12° (about 24° are blocked in all), or \
        --observer.",
    source: "colours of the Ideal-Scope (K. Okuda, 1984; G. Holloway): red return, white leakage, black viewer",
    read_from: MetricSource::View(Statistic::Mean(|t| [t.scope_bright, t.rays], 1.0)),
};
