//! The experiments that the scores read, each traced once a stone.
//!
//! [`Hemisphere`]: a dome of light, everything that comes out. [`View`]: a parallel eye in front of
//! the stone, traced backward; [`Iso`] the same by the rules of faceters; [`Contrast`] and
//! [`Scintillation`] what a picture of it shows in cells that an eye can tell apart. [`Beam`]: a
//! point light at infinity, in colours. [`dented`] has the first two for stones that are not convex. An
//! experiment adds up small sums in independent batches
//! ([`Traced`]); a metric is a function of such sums, and the spread of the batches is its error.
//! The viewer, and light with him, looks from an [`Aspect`].

pub mod aspect;
pub mod batches;
pub mod beam;
pub mod by_beams;
pub mod cells;
pub mod contrast;
pub mod dented;
mod entrance;
pub mod exact;
pub mod fire;
pub mod hemisphere;
pub mod horizon;
pub mod iso;
pub mod quadrature;
pub mod scintillation;
pub mod separation;
mod together;
pub mod view;
mod wavelengths;
pub mod weigh;

pub use aspect::Aspect;
pub use batches::{BATCHES, Experiment, Traced};
pub use beam::Beam;
pub use contrast::Contrast;
pub use hemisphere::Hemisphere;
pub use iso::Iso;
pub use quadrature::Quadrature;
pub use scintillation::Scintillation;
pub use view::View;

use crate::optics::Material;

/// A ray with less than this share of its light is given up, unless less is asked for. Smaller costs
/// time; larger shows: of a round brilliant's light 3e-5 are given up in all. In a stone that absorbs
/// the share is of what has come out ([`crate::walk::feed::Rays::ends_by_what_came_out`]).
pub const STOP_POWER: f32 = 1e-4;

/// What a stone is made of, and how light is followed in it. A stone of a material that absorbs is
/// in millimetres: its size shows.
#[derive(Debug, Clone, Copy)]
pub struct Medium<'a> {
    /// The material.
    pub material: &'a Material,
    /// Whether light keeps its polarisation from facet to facet; if not it counts as unpolarised at
    /// each (scalar Fresnel).
    pub polarised: bool,
}

/// A stone's optics at one wavelength.
#[derive(Debug, Clone, Copy, Default)]
struct Optics {
    index: f32,
    /// Absorption coefficient per walking unit.
    absorption: f32,
}

impl Optics {
    fn absorbs(&self) -> bool {
        self.absorption > 0.0
    }
}

impl Medium<'_> {
    /// Wavelengths in which each point of a view is traced: one for a clear stone.
    pub fn wavelengths_a_point(&self) -> u64 {
        if self.material.is_clear() { 1 } else { wavelengths::TOGETHER as u64 }
    }

    /// Optics of a stone with a walking unit of `unit` at `um` (µm); refuses indices at which the
    /// formulas mean nothing.
    fn optics(&self, unit: f64, um: f64) -> Result<Optics, ExperimentError> {
        let index = check_index(self.material.index(um))?;
        Ok(Optics { index, absorption: (self.material.absorption_per_mm(um) * unit) as f32 })
    }
}

/// A stone or material that cannot be lit.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ExperimentError {
    /// No facet faces up.
    #[error("no facet faces up: no light enters from above")]
    NoCrown,
    /// An index of refraction that no stone has.
    #[error("index of refraction {0} is not a number from 1 to 10")]
    Index(f64),
}

/// Refuses indices at which the formulas mean nothing.
fn check_index(n: f64) -> Result<f32, ExperimentError> {
    if (1.0..=10.0).contains(&n) { Ok(n as f32) } else { Err(ExperimentError::Index(n)) }
}
