//! ASET by energy: light from 75 to 90° above the girdle plane.

use super::{Better, Metric, MetricSource, Statistic};
use crate::estimators::view::AsetBand;

/// ASET by energy: light from 75 to 90° above the girdle plane.
pub static ASET_BLUE: Metric = Metric {
    name: "aset_blue",
    about: "share from 75–90°, where the viewer's head is: contrast",
    unit: "",
    range: (0.0, 1.0),
    scale: 1.0,
    better: Better::Neither,
    observer: None,
    by_beams: true,
    nonconvex: true,
    definition: "Parallel face-up view traced backward over the whole outline, no observer's head; \
        unpolarised light, Fresnel with its polarisation followed inside (scalar with --polarisation \
        off), D line (for a stone that absorbs, luminance under D65). Share of the sight lines' power \
        that comes from 75 to 90° above the girdle plane, by whatever facet; reflection at entry not \
        counted.",
    source: "colours of the ASET, American Gem Society (P. Yantzer et al., 2005)",
    read_from: MetricSource::View(Statistic::Mean(|t| [t.bands[AsetBand::Blue as usize], t.rays], 1.0)),
};
