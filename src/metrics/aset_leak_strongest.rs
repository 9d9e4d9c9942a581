//! ASET by the strongest path: light from below the horizon.

use super::{Better, Metric, MetricSource, Statistic};
use crate::estimators::view::AsetBand;

/// ASET by the strongest path: light from below the horizon.
pub static ASET_LEAK_STRONGEST: Metric = Metric {
    name: "aset_leak_strongest",
    about: "share of the outline whose strongest path leaks, as in the picture; the same as leakage_strongest",
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
        strongest path comes from below the horizon, as a photograph shows it; reflection at entry \
        not counted.",
    source: "colours of the ASET, American Gem Society (P. Yantzer et al., 2005)",
    read_from: MetricSource::View(Statistic::Share(|t| [t.strongest[AsetBand::Below as usize], t.rays])),
};
