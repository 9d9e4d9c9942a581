//! Mean separation of the colours.

use super::{Better, Metric, MetricSource, Statistic};

/// Mean separation of the colours.
pub static DISPERSION_MEAN: Metric = Metric {
    name: "dispersion_mean",
    about: "mean angle between lines B and G of one exit, by power; read it beside light return",
    unit: "°",
    range: (0.0, 180.0),
    scale: 1.0,
    better: Better::Neither,
    observer: None,
    by_beams: true,
    nonconvex: false,
    definition: "Vertical collimated beam on the whole outline, unpolarised, Fresnel with its \
        polarisation followed inside (scalar with --polarisation off); exits upward through the \
        crown. Angle between lines B and G where both leave by the same facets as D, mean weighted by \
        the power at D. High for stones that return little: read it beside light return. What a stone \
        absorbs counts at each line.",
    source: "defined by cutlab",
    read_from: MetricSource::PointLight(Statistic::Smooth(|t| t.power_angle_deg / t.paired_power)),
};
