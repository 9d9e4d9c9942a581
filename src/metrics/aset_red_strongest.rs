//! ASET by the strongest path: light from 45 to 75° above the girdle plane.

use super::{Better, Metric, MetricSource, Statistic};
use crate::estimators::view::AsetBand;

/// ASET by the strongest path: light from 45 to 75° above the girdle plane.
pub static ASET_RED_STRONGEST: Metric = Metric {
    name: "aset_red_strongest",
    about: "share of the outline whose strongest path is red",
    unit: "",
    range: (0.0, 1.0),
    scale: 1.0,
    better: Better::More,
    observer: None,
    by_beams: true,
    nonconvex: false,
    definition: "Parallel face-up view traced backward over the whole outline, no observer's head; \
        unpolarised light, Fresnel with its polarisation followed inside (scalar with --polarisation \
        off), D line (for a stone that absorbs, luminance under D65). Share of the outline whose \
        strongest path comes from 45 to 75° above the girdle plane, as a photograph shows it; \
        reflection at entry not counted.",
    source: "colours of the ASET, American Gem Society (P. Yantzer et al., 2005)",
    read_from: MetricSource::View(Statistic::Share(|t| [t.strongest[AsetBand::Red as usize], t.rays])),
};
