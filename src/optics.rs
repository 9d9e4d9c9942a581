//! Light and matter: dispersion, Fresnel, colour, and the catalogue of materials.

pub mod colour;
pub mod dispersion;
pub mod fresnel;
pub mod materials;
pub mod stokes;

pub use materials::Material;
