//! Median separation of the colours.

use super::{Better, Metric, MetricSource, Statistic};
use crate::estimators::point_light::CLASS_DEG;

/// Median separation of the colours.
pub static DISPERSION_MEDIAN: Metric = Metric {
    name: "dispersion_median",
    about: "median angle between lines B and G of one exit, by power; read it beside light return",
    unit: "°",
    range: (0.0, 180.0),
    scale: 1.0,
    better: Better::Neither,
    observer: None,
    by_beams: false,
    nonconvex: false,
    definition: "Vertical collimated beam on the whole outline, unpolarised, Fresnel with its \
        polarisation followed inside (scalar with --polarisation off); exits upward through the \
        crown. Angle between lines B and G where both leave by the same facets as D: half the power \
        at D leaves with less. Median of grouped data: the power of each class of 0.05° counts as \
        spread evenly over it, because facets give a few sharp angles; angles under 0.001° count as 0. \
        What a stone absorbs counts at each line. The error is the longer side of a 95 % confidence \
        interval over 1.96: between two peaks it reaches from one to the other until the rays can tell \
        on which the half falls.",
    source: "defined by cutlab",
    read_from: MetricSource::PointLight(Statistic::Median(|t| &t.power_by_angle, CLASS_DEG)),
};
