//! How finely candidates of a search are scored.

use crate::design::USUAL_WIDTH_MM;
use serde::{Deserialize, Serialize};

/// How finely candidates are scored.
///
/// Where beams of one direction have no noise (the faceters' view in a clear stone) they are followed until no
/// more light is left than `error` allows. Else `samples` decide, with the same random numbers for every
/// candidate, so that two candidates differ by less than their errors say.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[non_exhaustive]
pub struct Effort {
    /// The most that a score by beams without noise may be off, times the metric's scale.
    pub error: f64,
    /// Points of the hemisphere and the view, fewer of dearer estimators.
    pub samples: u64,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Whether light keeps its polarisation from facet to facet.
    pub polarised: bool,
    /// Girdle width in millimetres of a stone that absorbs, whose size matters.
    pub size_mm: f64,
}

impl Default for Effort {
    /// A tenth of a point of ISO, ±.0004 of WLR.
    fn default() -> Effort {
        Effort { error: 1e-3, samples: 1 << 17, seed: 1, polarised: true, size_mm: USUAL_WIDTH_MM }
    }
}

impl Effort {
    /// With the most that a score by beams without noise may be off, times the metric's scale.
    pub fn error(self, error: f64) -> Effort {
        Effort { error, ..self }
    }

    /// With so many points of the hemisphere and the view.
    pub fn samples(self, samples: u64) -> Effort {
        Effort { samples, ..self }
    }

    /// With a seed of the random numbers.
    pub fn seed(self, seed: u64) -> Effort {
        Effort { seed, ..self }
    }

    /// Whether light keeps its polarisation from facet to facet.
    pub fn polarised(self, polarised: bool) -> Effort {
        Effort { polarised, ..self }
    }

    /// With a girdle width in millimetres of stones that absorb.
    pub fn size_mm(self, size_mm: f64) -> Effort {
        Effort { size_mm, ..self }
    }
}
