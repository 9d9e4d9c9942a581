//! Light and matter: dispersion, absorption, Fresnel coefficients, Stokes vectors.

pub mod absorption;
pub mod dispersion;
pub mod fresnel;
pub mod spectral_curve;
pub mod stokes;
