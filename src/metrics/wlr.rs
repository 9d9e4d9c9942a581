//! Weighted light return.

use super::{Better, Metric, MetricSource, Statistic};

/// Weighted light return.
pub static WLR: Metric = Metric {
    name: "wlr",
    about: "weighted light return: white light from a dome, returned through the crown, most weight face-up",
    unit: "",
    range: (0.0, 1.0),
    scale: 1.0,
    better: Better::More,
    observer: None,
    by_beams: true,
    nonconvex: true,
    definition: "Uniform dome of light above the girdle plane, no observer's head; unpolarised light, \
        Fresnel with its polarisation followed inside (scalar with --polarisation off), D line (for a \
        stone that absorbs, luminance under D65). Power that leaves upward through the crown, \
        weighted by cos² of its angle from zenith, surface reflection excluded, per power arriving. \
        Directions are cosine-distributed about the crown facets' normals, points uniform by crown \
        area; those from below the horizon are not counted.",
    source: "T. S. Hemphill et al., Gems & Gemology 34 (1998) 158; recipe of the project's reference figures, \
        which tests/scores.rs holds",
    read_from: MetricSource::Hemisphere(Statistic::Mean(|t| [t.returned_cos2, t.arrived], 1.0)),
};
