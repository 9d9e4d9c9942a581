//! Light that the stone absorbs.

use super::{Better, Metric, MetricSource, Statistic};

/// Absorbed light.
pub static ABSORBED: Metric = Metric {
    name: "absorbed",
    about: "share that the stone's colour takes: 0 in a clear stone, more in a larger one",
    unit: "",
    range: (0.0, 1.0),
    scale: 1.0,
    better: Better::Neither,
    observer: None,
    by_beams: true,
    nonconvex: true,
    definition: "Uniform dome of light above the girdle plane, no observer's head; unpolarised light, \
        Fresnel with its polarisation followed inside (scalar with --polarisation off), D line (for a \
        stone that absorbs, luminance under D65). Power absorbed inside by Beer–Lambert over the path \
        in millimetres, per power arriving. Directions are cosine-distributed about the crown facets' \
        normals, points uniform by crown area; those from below the horizon are not counted.",
    source: "defined by cutlab; light_return + glare + leakage + absorbed + lost = 1",
    read_from: MetricSource::Hemisphere(Statistic::Smooth(|t| t.absorbed / t.arrived)),
};
