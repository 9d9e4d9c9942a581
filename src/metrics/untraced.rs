//! Light given up.

use super::{Better, Metric, MetricSource, Statistic};

/// Light given up.
pub static UNTRACED: Metric = Metric {
    name: "lost",
    about: "share no longer followed: the error of the figures above",
    unit: "",
    range: (0.0, 1.0),
    scale: 1.0,
    better: Better::Neither,
    observer: None,
    by_beams: true,
    nonconvex: true,
    definition: "Uniform dome of light above the girdle plane, no observer's head; unpolarised light, \
        Fresnel with its polarisation followed inside (scalar with --polarisation off), D line (for a \
        stone that absorbs, luminance under D65). Power that the tracer stopped following (a ray with \
        less than 1e-4 of its light or half the error asked for; in a stone that absorbs the share is \
        of what has come out), per power arriving. The errors of the other four hold it. Directions \
        are cosine-distributed about the crown facets' normals, points uniform by crown area; those \
        from below the horizon are not counted.",
    source: "defined by cutlab; light_return + glare + leakage + absorbed + lost = 1",
    read_from: MetricSource::Hemisphere(Statistic::Smooth(|t| t.lost / t.arrived)),
};
