//! Contrast.

use super::{Better, Metric, MetricSource, Statistic};
use crate::estimators::{contrast::ContrastTally, pixel_cells::AGS_OBSERVER_DEG};

/// Contrast.
pub static CONTRAST: Metric = Metric {
    name: "contrast",
    about: "how much the face-up picture varies: standard deviation per mean of its cells",
    unit: "",
    range: (0.0, 100.0),
    scale: 1.0,
    better: Better::Neither,
    observer: Some(AGS_OBSERVER_DEG),
    by_beams: false,
    nonconvex: false,
    definition: "Parallel face-up view traced backward over the whole outline; unpolarised light, \
        Fresnel with its polarisation followed inside (scalar with --polarisation off), D line (for a \
        stone that absorbs, luminance under D65). White dome above the horizon with a dark observer \
        cone of 15° half-angle, or --observer; reflection at entry included. The luminance is the \
        mean over square cells of 1/100 of the girdle's width (what of them lies in the outline; mean \
        over all ways to lay the grid). Standard deviation per mean of the cells, by their area in \
        the outline.",
    source: "resolution: J. Sasián et al., Optical Engineering 46 (2007) 093604; observer: American Gem Society; the figure is cutlab's",
    read_from: MetricSource::Contrast(Statistic::Smooth(ContrastTally::contrast)),
};
