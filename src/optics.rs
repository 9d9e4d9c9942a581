//! Light and matter: dispersion, absorption, Fresnel, colour, and the catalogues of materials
//! and illuminants.

pub mod absorption;
pub mod colour;
pub mod dispersion;
pub mod fresnel;
pub mod illuminants;
pub mod materials;
pub mod stokes;

pub use illuminants::Illuminant;
pub use materials::Material;
