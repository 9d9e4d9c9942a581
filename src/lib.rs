//! cutlab: a laboratory for gem cuts.
//!
//! Facet planes become a solid, light is traced through it, and what comes out is pictured and scored.
//! The rooms, lowest first; a file imports only from rooms before its own, which
//! `tests/house.rs` keeps:
//!
//! `sampling parse storage progress` → `color optics geometry` → `materials design trace` →
//! `formats estimators` → `stone metrics` → `scene scoring` → `photons batch` → `integrators` →
//! `render` → `report manual` → `cli`

pub mod batch;
pub mod cli;
pub mod color;
pub mod design;
pub mod estimators;
pub mod formats;
pub mod geometry;
pub mod integrators;
pub mod manual;
pub mod materials;
pub mod metrics;
pub mod optics;
pub mod parse;
pub mod photons;
pub mod progress;
pub mod render;
pub mod report;
pub mod sampling;
pub mod scene;
pub mod scoring;
pub mod stone;
pub mod storage;
pub mod trace;
