//! Light and matter: dispersion, Fresnel, colour, and the catalogue of materials.

pub mod colour;
pub mod dispersion;
pub mod fresnel;
pub mod materials;

pub use materials::Material;
