//! Crystals that refract doubly: waves inside, and what becomes of them at a facet.
//!
//! Wave vectors are in units of ω/c, so that the size of one is the refractive index of its wave.

mod biaxial;
pub mod facet;
pub mod field;
mod quartic;
mod uniaxial;
pub mod wave;

pub use biaxial::Biaxial;
pub use uniaxial::Uniaxial;
