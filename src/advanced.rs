//! The library behind the root: its rooms, lowest first. Names in here change from version to version more
//! freely than those of the root.

/// Random streams, quasi-random sequences, distributions, statistics with their errors.
pub mod sampling {
    pub use crate::sampling::*;
}

/// Numbers and names as people type them, data files, tables of spectra.
pub mod parse {
    pub use crate::parse::*;
}

/// Limits on what is read.
pub mod limits {
    pub use crate::limits::*;
}

/// Loops over independent work.
pub mod parallel {
    pub use crate::parallel::*;
}

/// What long work tells, and whether it is to end.
pub mod progress {
    pub use crate::progress::*;
}

/// Atomic writes, locks, journals, checkpoints, reading within limits, text decoding.
#[cfg(feature = "files")]
pub mod storage {
    pub use crate::storage::*;
}

/// Search for the best points of a box, for one objective or several.
#[cfg(feature = "search")]
pub mod search {
    pub use crate::search::*;
}

/// CIE observer, illuminants, daylight, RGB upsampling, the colours of viewers.
pub mod color {
    pub use crate::color::*;
}

/// Fresnel coefficients, Stokes vectors, dispersion, absorption.
pub mod optics {
    pub use crate::optics::*;
}

/// Planes, half-space clipping, polyhedra, closed meshes, facet recovery, measures.
pub mod geometry {
    pub use crate::geometry::*;
}

/// The catalogue of materials and the reader of their files; weights.
pub mod materials {
    pub use crate::materials::*;
}

/// Tiers, meet points, parametric families, the library of cuts, symmetry, proportions.
pub mod design {
    pub use crate::design::*;
}

/// Variables, objectives and bounds of an optimisation, and its run.
#[cfg(feature = "search")]
pub mod optimise {
    pub use crate::optimise::*;
}

/// The packet kernel, its `f64` reference, non-convex stones, exact beams.
pub mod trace {
    pub use crate::trace::*;
}

/// Readers and writers of designs and meshes.
#[cfg(feature = "files")]
pub mod formats {
    pub use crate::formats::*;
}

/// Estimators: the traced sums that metrics read; their catalogue.
pub mod estimators {
    pub use crate::estimators::*;
}

/// Stones as values; the grammar of a STONE argument.
pub mod stone {
    pub use crate::stone::*;
}

/// All metrics, in the order of the columns.
pub mod metrics {
    pub use crate::metrics::*;
}

/// Scene files, camera, lights, surfaces, placed stones, intersection.
#[cfg(feature = "render")]
pub mod scene {
    pub use crate::scene::*;
}

/// Scores of stones, as accurate as asked for, and of stones against each other.
pub mod scoring {
    pub use crate::scoring::*;
}

/// Emission, photon maps, irradiance estimates.
#[cfg(feature = "render")]
pub mod photons {
    pub use crate::photons::*;
}

/// Requests for tables and their identity, tables, shards, merging, sweeps, validation.
#[cfg(feature = "files")]
pub mod batch {
    pub use crate::batch::*;
}

/// Camera and stone integrators, progressive rendering, film, tone, image files.
#[cfg(feature = "render")]
pub mod integrators {
    pub use crate::integrators::*;
}

/// Pictures from requests, and the files they are written to.
#[cfg(feature = "render")]
pub mod render {
    pub use crate::render::*;
}

/// Diagrams, plots, pages.
#[cfg(feature = "report")]
pub mod report {
    pub use crate::report::*;
}

/// The command line.
#[cfg(feature = "cli")]
pub mod cli {
    pub use crate::cli::*;
}
