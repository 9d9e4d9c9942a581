//! Colour: the CIE observer, illuminants, daylight, and spectra of colours given as red, green and blue.

pub mod cie;
pub mod cielab;
pub mod daylight;
pub mod illuminants;
pub mod luminance;
pub mod rgb_upsampling;
pub mod viewers;

pub use illuminants::Illuminant;
