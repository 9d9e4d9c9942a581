//! cutlab: a laboratory for gem cuts.
//!
//! Facet planes become a solid, light is traced through it, and what comes out is pictured and scored.
//! The rooms, lowest first; a file imports only from rooms before its own, which
//! `tests/house.rs` keeps:
//!
//! `sampling parse limits parallel progress` → `storage` → `color optics geometry` → `materials design trace` →
//! `formats estimators` → `stone metrics` → `scene scoring` → `photons batch` → `integrators` →
//! `render` → `report manual` → `cli`
//!
//! What is compiled of them follows from the features of the package. Without any, a stone of the library or
//! of a parametric family is modelled, traced and scored, on one thread and without files;
//! `parallel` takes all threads, `files` adds designs, meshes and tables on disk, `render` scenes and
//! pictures, `report` drawings and pages, and `cli` (the default) is all of it and the program.

#![deny(missing_docs)]

pub mod color;
pub mod design;
mod error;
pub mod estimators;
pub mod geometry;
pub mod limits;
pub mod manual;
pub mod materials;
pub mod metrics;
pub mod optics;
pub mod parallel;
pub mod parse;
pub mod prelude;
pub mod progress;
pub mod sampling;
pub mod scoring;
pub mod stone;
pub mod trace;

#[cfg(feature = "files")]
pub mod batch;
#[cfg(feature = "files")]
pub mod formats;
#[cfg(feature = "files")]
pub mod storage;

#[cfg(feature = "render")]
pub mod integrators;
#[cfg(feature = "render")]
pub mod photons;
#[cfg(feature = "render")]
pub mod render;
#[cfg(feature = "render")]
pub mod scene;

#[cfg(feature = "report")]
pub mod report;

#[cfg(feature = "cli")]
pub mod cli;

pub use design::{Design, LengthUnit};
pub use error::{Error, ErrorKind};
pub use glam;
pub use materials::Material;
pub use metrics::Metric;
pub use progress::Progress;
#[cfg(feature = "render")]
pub use render::{Picture, RenderRequest};
pub use sampling::stats::Estimate;
pub use scoring::{ScoreRequest, Scores};
pub use stone::{Stone, StoneOptions};
