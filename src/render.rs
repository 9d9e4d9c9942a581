//! Pictures: camera rays, passes, tone, files.

pub mod animation;
pub mod film;
pub mod glare;
mod inside;
pub mod mp4;
pub mod progressive;
mod sensor;
pub mod tone;
pub mod tracer;
pub mod write;

pub use film::{Film, Pass};
pub use progressive::Progressive;
pub use tone::{Curve, Tone};
pub use tracer::{Maps, Settings, render};
