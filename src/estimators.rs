//! Estimators that the metrics read, each traced once a stone.
//!
//! [`Hemisphere`]: a dome of light, everything that comes out. [`View`]: a parallel eye in front of
//! the stone, traced backward; [`FaceterView`] the same by the rules of faceters; [`Contrast`] and
//! [`Scintillation`] what a picture of it shows in cells that an eye can tell apart. [`PointLight`]: a
//! point light at infinity, in colours. [`nonconvex`] has the first two for stones that are not convex. An
//! estimator adds up small sums in independent batches
//! ([`BatchedEstimate`]); a metric is a function of such sums, and the spread of the batches is its error.
//! The viewer, and light with him, looks from a [`ViewFrame`].

pub mod batches;
pub mod beam_tallies;
pub mod beam_view;
pub mod colour_separation;
pub mod contrast;
mod entry_sampling;
pub mod faceter_view;
pub mod fire;
pub mod hemisphere;
pub mod horizon;
pub mod nonconvex;
pub mod pixel_cells;
pub mod point_light;
pub mod quadrature;
mod same_path;
pub mod scintillation;
pub mod view;
pub mod view_frame;
mod wavelengths;
pub mod weighted_exits;

pub use batches::{BATCHES, BatchedEstimate, Estimator};
pub use contrast::Contrast;
pub use faceter_view::FaceterView;
pub use hemisphere::Hemisphere;
pub use point_light::PointLight;
pub use quadrature::Quadrature;
pub use scintillation::Scintillation;
pub use view::View;
pub use view_frame::ViewFrame;

use crate::materials::Material;

/// A ray with less than this share of its light is given up, unless less is asked for. Smaller costs
/// time; larger shows: of a round brilliant's light 3e-5 are given up in all. In a stone that absorbs
/// the share is of what has come out ([`crate::trace::lane_scheduler::RayClient::stops_by_emitted_power`]).
pub const STOP_POWER: f32 = 1e-4;

/// What a stone is made of, and how light is followed in it. A stone of a material that absorbs is
/// in millimetres: its size shows.
#[derive(Debug, Clone, Copy)]
pub struct TraceOptics<'a> {
    /// The material.
    pub material: &'a Material,
    /// Whether light keeps its polarisation from facet to facet; if not it counts as unpolarised at
    /// each (scalar Fresnel).
    pub polarised: bool,
}

/// A stone's optics at one wavelength.
#[derive(Debug, Clone, Copy, Default)]
struct LineOptics {
    index: f32,
    /// Absorption coefficient per trace unit.
    absorption: f32,
}

impl LineOptics {
    fn absorbs(&self) -> bool {
        self.absorption > 0.0
    }
}

impl TraceOptics<'_> {
    /// Wavelengths in which each point of a view is traced: one for a clear stone.
    pub fn wavelengths_per_point(&self) -> u64 {
        if self.material.is_clear() { 1 } else { wavelengths::LINES_PER_RAY as u64 }
    }

    /// Optics of a stone with a trace unit of `unit` at `um` (µm); refuses indices at which the
    /// formulas mean nothing.
    fn optics(&self, unit: f64, um: f64) -> Result<LineOptics, EstimatorError> {
        let index = check_index(self.material.index(um))?;
        Ok(LineOptics { index, absorption: (self.material.absorption_per_mm(um) * unit) as f32 })
    }
}

/// A stone or material that cannot be lit.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum EstimatorError {
    /// No facet faces up.
    #[error("no facet faces up: no light enters from above")]
    NoCrown,
    /// An index of refraction that no stone has.
    #[error("index of refraction {0} is not a number from 1 to 10")]
    Index(f64),
}

/// Refuses indices at which the formulas mean nothing.
fn check_index(n: f64) -> Result<f32, EstimatorError> {
    if (1.0..=10.0).contains(&n) { Ok(n as f32) } else { Err(EstimatorError::Index(n)) }
}
