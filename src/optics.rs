//! Light and matter: dispersion, absorption, Fresnel, colour, and the catalogues of materials,
//! illuminants and viewers.

pub mod absorption;
pub mod colour;
pub mod daylight;
pub mod dispersion;
pub mod fresnel;
pub mod illuminants;
pub mod luminance;
pub mod materials;
pub mod rgb;
pub mod stokes;
pub mod viewers;
pub mod weight;

pub use illuminants::Illuminant;
pub use materials::Material;
