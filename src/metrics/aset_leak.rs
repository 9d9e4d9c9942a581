//! ASET by energy: light from below the horizon.

use super::{Better, Metric, MetricSource, Statistic};
use crate::estimators::view::AsetBand;

/// ASET by energy: light from below the horizon.
pub static ASET_LEAK: Metric = Metric {
    name: "aset_leak",
    about: "share from below: windows",
    unit: "",
    range: (0.0, 1.0),
    scale: 1.0,
    better: Better::Less,
    observer: None,
    by_beams: true,
    nonconvex: true,
    definition: "Parallel face-up view traced backward over the whole outline, no observer's head; \
        unpolarised light, Fresnel with its polarisation followed inside (scalar with --polarisation \
        off), D line (for a stone that absorbs, luminance under D65). Share of the sight lines' power \
        that comes from below the horizon, by whatever facet; reflection at entry not counted.",
    source: "colours of the ASET, American Gem Society (P. Yantzer et al., 2005)",
    read_from: MetricSource::View(Statistic::Mean(|t| [t.bands[AsetBand::Below as usize], t.rays], 1.0)),
};
