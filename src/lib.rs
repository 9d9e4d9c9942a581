//! cutlab: a laboratory for gem cuts.
//!
//! Facet planes become a solid, light walks through it, and what comes out is pictured and scored.
//! The rooms, lowest first; a file imports only from rooms before its own, which
//! `tests/house.rs` keeps:
//!
//! `math store` → `optics solid` → `cut` `walk` → `formats` → `scene` → `transport` →
//! `photons experiments` → `metrics` `render` → `study` → `report` → `cli`

pub mod cli;
pub mod cut;
pub mod experiments;
pub mod formats;
pub mod math;
pub mod metrics;
pub mod optics;
pub mod photons;
pub mod render;
pub mod report;
pub mod scene;
pub mod solid;
pub mod store;
pub mod study;
pub mod transport;
pub mod walk;
