//! Median separation of the colours.

use super::{Metric, Reading, Statistic};
use crate::experiments::beam::CLASS_DEG;

/// Median separation of the colours.
pub static DISPERSION_MEDIAN: Metric = Metric {
    name: "dispersion_median",
    about: "median angle between lines B and G of one exit, by power; read it beside light return",
    unit: "°",
    range: (0.0, 180.0),
    scale: 1.0,
    observer: None,
    by_beams: false,
    dented: false,
    definition: "Vertical collimated beam on the whole outline, unpolarised, Fresnel with its \
        polarisation followed inside (scalar with --polarisation off); exits upward through the \
        crown. Angle between lines B and G where both leave by the same facets as D: half the power \
        at D leaves with less. Median of grouped data: the power of each class of 0.05° counts as \
        spread evenly over it, because facets give a few sharp angles. What a stone absorbs counts at \
        each line.",
    source: "defined by cutlab",
    reading: Reading::Beam(Statistic::Median(|t| &t.power_by_angle, CLASS_DEG)),
};
