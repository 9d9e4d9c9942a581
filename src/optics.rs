//! Light and matter: dispersion, absorption, Snell's law, Fresnel coefficients, Stokes vectors.

pub mod absorption;
pub mod crystal;
pub mod dispersion;
pub mod fresnel;
pub mod snell;
pub mod spectral_curve;
pub mod stokes;
