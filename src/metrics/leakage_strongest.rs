//! Leakage by the strongest path: the outline that looks down through the stone.

use super::{Better, Metric, MetricSource, Statistic};
use crate::estimators::view::AsetBand;

/// Leakage by the strongest path: the outline that looks down through the stone.
pub static LEAKAGE_STRONGEST: Metric = Metric {
    name: "leakage_strongest",
    about: "share of the outline whose strongest path comes from below",
    unit: "",
    range: (0.0, 1.0),
    scale: 1.0,
    better: Better::Less,
    observer: None,
    by_beams: true,
    nonconvex: false,
    definition: "Parallel face-up view traced backward over the whole outline, no observer's head; \
        unpolarised light, Fresnel with its polarisation followed inside (scalar with --polarisation \
        off), D line (for a stone that absorbs, luminance under D65). Share of the outline whose \
        strongest path comes from below the horizon, as a photograph shows it; reflection at entry \
        not counted.",
    source: "colours of the ASET, American Gem Society (P. Yantzer et al., 2005)",
    read_from: MetricSource::View(Statistic::Share(|t| [t.strongest[AsetBand::Below as usize], t.rays])),
};
