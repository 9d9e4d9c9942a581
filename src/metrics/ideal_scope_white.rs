//! Ideal-Scope: leakage.

use super::{Better, Metric, MetricSource, Statistic};
use crate::estimators::view::AsetBand;

/// Ideal-Scope: leakage.
pub static IDEAL_SCOPE_WHITE: Metric = Metric {
    name: "ideal_scope_white",
    about: "share of what one sees face-up that comes from below (Ideal-Scope white: leakage)",
    unit: "",
    range: (0.0, 1.0),
    scale: 1.0,
    better: Better::Less,
    observer: None,
    by_beams: true,
    nonconvex: true,
    definition: "Parallel face-up view traced backward over the whole outline; unpolarised light, \
        Fresnel with its polarisation followed inside (scalar with --polarisation off), D line (for a \
        stone that absorbs, luminance under D65). Share of the sight lines' power that comes from \
        below the horizon, by whatever facet: what an Ideal-Scope shows white; reflection at entry \
        not counted. Equal to aset_leak.",
    source: "colours of the Ideal-Scope (K. Okuda, 1984; G. Holloway): red return, white leakage, black viewer",
    read_from: MetricSource::View(Statistic::Mean(|t| [t.bands[AsetBand::Below as usize], t.rays], 1.0)),
};
