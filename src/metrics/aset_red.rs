//! ASET by energy: light from 45 to 75° above the girdle plane.

use super::{Better, Metric, MetricSource, Statistic};
use crate::estimators::view::AsetBand;

/// ASET by energy: light from 45 to 75° above the girdle plane.
pub static ASET_RED: Metric = Metric {
    name: "aset_red",
    about: "share from 45–75°, the light that matters most",
    unit: "",
    range: (0.0, 1.0),
    scale: 1.0,
    better: Better::More,
    observer: None,
    by_beams: true,
    nonconvex: true,
    definition: "Parallel face-up view traced backward over the whole outline, no observer's head; \
        unpolarised light, Fresnel with its polarisation followed inside (scalar with --polarisation \
        off), D line (for a stone that absorbs, luminance under D65). Share of the sight lines' power \
        that comes from 45 to 75° above the girdle plane, by whatever facet; reflection at entry not \
        counted.",
    source: "colours of the ASET, American Gem Society (P. Yantzer et al., 2005)",
    read_from: MetricSource::View(Statistic::Mean(|t| [t.bands[AsetBand::Red as usize], t.rays], 1.0)),
};
