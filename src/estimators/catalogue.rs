//! The catalogue of estimators.

use super::contrast::ContrastKind;
use super::faceter_view::FaceterViewKind;
use super::hemisphere::HemisphereKind;
use super::kind::{EstimatorKind, Method, Metric, Setup};
use super::point_light::PointLightKind;
use super::scintillation::ScintillationKind;
use super::solid::SolidKind;
use super::view_metrics::ViewKind;
use super::{beam_tallies, fire, nonconvex, quadrature};
use crate::trace::ConvexStone;
use crate::trace::nonconvex::MeshStone;

/// Gives methods for a convex stone, of those metrics of a kind that are asked for.
pub type ConvexMethods = for<'a> fn(&'a ConvexStone, Setup<'a>, &[&Metric]) -> Vec<Method<'a>>;

/// Gives methods for a stone that is not convex.
pub type NonconvexMethods = for<'a> fn(&'a MeshStone, Setup<'a>) -> Vec<Method<'a>>;

/// Where the noise of sums by beams comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BeamNoise {
    /// There is none: beams are followed to their end.
    None,
    /// From photons that finish beams of one direction: less noise than photons alone have in the same time.
    Photons,
    /// From directions drawn at random: more noise than photons have in the same time.
    Directions,
}

/// A kind of estimator, and what else finds its sums: files of their own, which it need not know.
#[derive(Debug, Clone, Copy)]
pub struct CataloguedEstimator {
    /// The kind.
    pub kind: &'static dyn EstimatorKind,
    /// In clear stones, in place of the kind's own methods.
    pub in_clear_stones: Option<ConvexMethods>,
    /// By exact beams, for metrics that say that they have them.
    pub by_beams: Option<ConvexMethods>,
    /// Where the noise of these comes from.
    pub beam_noise: BeamNoise,
    /// Whether the kind's own methods give what beams were to give and did not.
    pub completes_beams: bool,
    /// In stones that are not convex, for metrics that say that these have them.
    pub nonconvex: Option<NonconvexMethods>,
}

impl CataloguedEstimator {
    /// A kind with no methods but its own.
    pub const fn new(kind: &'static dyn EstimatorKind) -> CataloguedEstimator {
        CataloguedEstimator {
            kind,
            in_clear_stones: None,
            by_beams: None,
            beam_noise: BeamNoise::Photons,
            completes_beams: false,
            nonconvex: None,
        }
    }
}

/// Every estimator, in the order in which a stone's scores are computed.
pub static ESTIMATORS: [CataloguedEstimator; 7] = [
    CataloguedEstimator::new(&SolidKind),
    CataloguedEstimator {
        by_beams: Some(quadrature::methods),
        beam_noise: BeamNoise::Directions,
        nonconvex: Some(nonconvex::hemisphere_methods),
        ..CataloguedEstimator::new(&HemisphereKind)
    },
    CataloguedEstimator {
        by_beams: Some(beam_tallies::view_methods),
        completes_beams: true,
        nonconvex: Some(nonconvex::view_methods),
        ..CataloguedEstimator::new(&ViewKind)
    },
    CataloguedEstimator {
        by_beams: Some(beam_tallies::iso_methods),
        beam_noise: BeamNoise::None,
        ..CataloguedEstimator::new(&FaceterViewKind)
    },
    CataloguedEstimator::new(&ContrastKind),
    CataloguedEstimator::new(&ScintillationKind),
    CataloguedEstimator {
        in_clear_stones: Some(fire::methods),
        by_beams: Some(beam_tallies::colour_methods),
        ..CataloguedEstimator::new(&PointLightKind)
    },
];

impl Metric {
    /// Where the noise of the metric by beams comes from; none if beams do not give it.
    pub fn beam_noise(&self) -> Option<BeamNoise> {
        let estimator = ESTIMATORS.iter().find(|e| self.is_of(e.kind));
        estimator.filter(|_| self.by_beams).map(|e| e.beam_noise)
    }
}
