//! Integrators and pictures: camera rays, rays in stones, passes, tone, image files.

pub mod animation;
pub mod camera_integrator;
mod camera_sample;
pub mod film;
pub mod glare;
pub mod image_io;
pub mod mp4;
pub mod progressive;
mod sensor;
mod stone_integrator;
pub mod tone;

pub use camera_integrator::{PhotonMaps, RenderSettings, render};
pub use film::{Film, Pass};
pub use progressive::Progressive;
pub use tone::{Tone, ToneCurve};
