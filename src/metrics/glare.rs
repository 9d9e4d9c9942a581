//! Glare.

use super::{Better, Metric, MetricSource, Statistic};

/// Glare.
pub static GLARE: Metric = Metric {
    name: "glare",
    about: "share mirrored by the crown's surface without entering",
    unit: "",
    range: (0.0, 1.0),
    scale: 1.0,
    better: Better::Neither,
    observer: None,
    by_beams: true,
    nonconvex: true,
    definition: "Uniform dome of light above the girdle plane, no observer's head; unpolarised light, \
        Fresnel with its polarisation followed inside (scalar with --polarisation off), D line (for a \
        stone that absorbs, luminance under D65). Power reflected at entry per power arriving. \
        Directions are cosine-distributed about the crown facets' normals, points uniform by crown \
        area; those from below the horizon are not counted.",
    source: "defined by cutlab; light_return + glare + leakage + absorbed + lost = 1",
    read_from: MetricSource::Hemisphere(Statistic::Smooth(|t| t.glare / t.arrived)),
};
