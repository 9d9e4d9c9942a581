//! Light and matter: dispersion, absorption, Fresnel, colour, and the catalogues of materials,
//! illuminants and viewers.

pub mod absorption;
pub mod dispersion;
pub mod fresnel;
pub mod stokes;
