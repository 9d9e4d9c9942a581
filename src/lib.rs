//! cutlab: a laboratory for gem cuts.
//!
//! Facet planes become a solid, light is traced through it, and what comes out is pictured and scored.
//! The rooms, lowest first; a file imports only from rooms before its own, which
//! `tests/house/layers.rs` keeps:
//!
//! `sampling parse limits parallel progress` → `storage search` → `color optics geometry` → `materials design trace` →
//! `formats estimators` → `stone metrics` → `scene scoring` → `photons batch` → `integrators` →
//! `render` → `report manual` → `cli`
//!
//! What is compiled of them follows from the features of the package. Without any, a stone of the library or
//! of a parametric family is modelled, traced and scored, on one thread and without files;
//! `parallel` takes all threads, `search` finds the best points of a box, `files` adds designs, meshes and tables on disk, `render` scenes and
//! pictures, `report` drawings and pages, and `cli` (the default) is all of it and the program.

#![deny(missing_docs)]

pub mod advanced;
pub mod manual;
pub mod prelude;

mod color;
mod design;
mod error;
mod estimators;
mod geometry;
mod limits;
mod materials;
mod metrics;
mod optics;
#[cfg(feature = "search")]
mod optimise;
mod parallel;
mod parse;
mod progress;
mod sampling;
mod scoring;
mod stone;
mod trace;

#[cfg(feature = "files")]
mod batch;
#[cfg(feature = "files")]
mod formats;
#[cfg(feature = "files")]
mod storage;

#[cfg(feature = "search")]
mod search;

#[cfg(feature = "render")]
mod integrators;
#[cfg(feature = "render")]
mod photons;
#[cfg(feature = "render")]
mod render;
#[cfg(feature = "render")]
mod scene;

#[cfg(feature = "report")]
mod report;

#[cfg(feature = "cli")]
mod cli;

#[cfg(feature = "files")]
pub use batch::comparison::{ComparisonError, StoneComparison};
#[cfg(feature = "files")]
pub use batch::request::{ComparisonTable, ScoreTable, SweepTable, TableRequest};
#[cfg(feature = "files")]
pub use batch::stone_files::expand_stones;
pub use color::Illuminant;
pub use design::edit::EditRequest;
pub use design::retarget::RetargetRequest;
pub use design::{Design, LengthUnit};
pub use error::{Error, ErrorKind};
#[cfg(feature = "files")]
pub use formats::FormatError;
pub use geometry::{Plane, Polyhedron};
pub use glam;
#[cfg(feature = "render")]
pub use integrators::animation::Turn;
#[cfg(feature = "render")]
pub use integrators::{Film, Pass, ToneCurve};
pub use limits::Limits;
pub use materials::Material;
pub use metrics::{METRICS, Metric};
#[cfg(feature = "search")]
pub use optimise::{OptimiseRequest, Variable};
pub use progress::Progress;
#[cfg(feature = "render")]
pub use render::{
    AnimationRequest, Background, Exposure, Picture, PictureKind, RenderError, RenderRequest, StopRequest,
};
#[cfg(feature = "report")]
pub use report::ReportRequest;
pub use sampling::stats::Estimate;
#[cfg(feature = "render")]
pub use scene::{Pose, Scene, SceneFile};
pub use scoring::{AttributionRequest, Comparison, ScoreError, ScoreRequest, Scores, Target, Tilt};
pub use stone::{Orientation, Stone, StoneError, StoneOptions, StoneSpec, UpAxis};
