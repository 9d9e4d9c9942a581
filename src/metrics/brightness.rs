//! Brightness.

use super::{Better, Metric, MetricSource, Statistic};
use crate::estimators::view::GIA_OBSERVER_DEG;

/// Brightness.
pub static BRIGHTNESS: Metric = Metric {
    name: "brightness",
    about: "mean luminance of the face-up stone under a white dome, dark where the viewer is",
    unit: "",
    range: (0.0, 1.0),
    scale: 1.0,
    better: Better::More,
    observer: Some(GIA_OBSERVER_DEG),
    by_beams: true,
    nonconvex: true,
    definition: "Parallel face-up view traced backward over the whole outline; unpolarised light, \
        Fresnel with its polarisation followed inside (scalar with --polarisation off), D line (for a \
        stone that absorbs, luminance under D65). White dome above the horizon with a dark observer \
        cone of 23° half-angle, or --observer. Mean luminance over the outline per luminance of the \
        dome, by whatever facet, reflection at entry included.",
    source: "dome with a dark cone of 23°: T. Moses et al., Gems & Gemology 40 (2004) 202; the mean is cutlab's",
    read_from: MetricSource::View(Statistic::Mean(|t| [t.luminance, t.rays], 1.0)),
};
