//! Light return.

use super::{Better, Metric, MetricSource, Statistic};

/// Light return.
pub static LIGHT_RETURN: Metric = Metric {
    name: "light_return",
    about: "share of a dome's light that comes back up through the crown, from inside",
    unit: "",
    range: (0.0, 1.0),
    scale: 1.0,
    better: Better::More,
    observer: None,
    by_beams: true,
    nonconvex: true,
    definition: "Uniform dome of light above the girdle plane, no observer's head; unpolarised light, \
        Fresnel with its polarisation followed inside (scalar with --polarisation off), D line (for a \
        stone that absorbs, luminance under D65). Power that leaves upward through the crown after \
        entering, per power arriving. Directions are cosine-distributed about the crown facets' \
        normals, points uniform by crown area; those from below the horizon are not counted.",
    source: "defined by cutlab; light_return + glare + leakage + absorbed + lost = 1",
    read_from: MetricSource::Hemisphere(Statistic::Mean(|t| [t.returned, t.arrived], 1.0)),
};
