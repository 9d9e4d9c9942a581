//! Fire: length of the streaks.

use super::{Better, Metric, MetricSource, Statistic};

/// Fire: length of the streaks.
pub static FIRE_STREAK: Metric = Metric {
    name: "fire_streak",
    about: "length of the colour streaks, line B to G, summed over the beams that a point light sends out of the crown (surrogate of GIA's DCLR)",
    unit: "°",
    range: (0.0, 1e3),
    scale: 1.0,
    better: Better::More,
    observer: None,
    by_beams: false,
    nonconvex: false,
    definition: "Vertical collimated beam on the whole outline, unpolarised, Fresnel with its \
        polarisation followed inside (scalar with --polarisation off); exits upward through the \
        crown. Area of the exiting beams brighter than 1e-3 of the incident irradiance at D, weighted \
        by cos² of the angle from zenith and by the angle between lines B and G where both leave by \
        the same facets, per outline area. A surrogate. Of clear stones by exact beams, those too small \
        to be followed by photons. What a stone absorbs counts at each line.",
    source: "after the DCLR of I. M. Reinitz et al., Gems & Gemology 37 (2001) 174, whose formula is not public",
    read_from: MetricSource::PointLight(Statistic::Mean(|t| [t.streak_deg, t.points], 1.0)),
};
