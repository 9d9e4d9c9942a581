//! Weight ratio.

use super::{Better, Metric, MetricSource};
use crate::design::library;
use crate::geometry::Polyhedron;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// Weight ratio.
pub static WEIGHT_RATIO: Metric = Metric {
    name: "weight_ratio",
    about: "mass per mass of a Tolkowsky brilliant of equal girdle width",
    unit: "",
    range: (0.0, 1000.0),
    scale: 1.0,
    better: Better::Neither,
    observer: None,
    by_beams: false,
    nonconvex: false,
    definition: "Geometry of the solid, no light. Mass per that of the library's Tolkowsky brilliant of \
        equal girdle width (the least distance of two parallels that hold the outline) and the same \
        material.",
    source: "defined by cutlab; proportions of the other stone: M. Tolkowsky, Diamond Design (1919)",
    read_from: MetricSource::Solid(weight_ratio),
};

/// Volume per that of the Tolkowsky stone as wide.
fn weight_ratio(solid: &Polyhedron) -> Option<f64> {
    let volume = |s: &Polyhedron| s.volume() / s.width().powi(3);
    Some(volume(solid) / volume(tolkowsky()?))
}

/// The library's Tolkowsky brilliant.
pub(super) fn tolkowsky() -> Option<&'static Polyhedron> {
    static TOLKOWSKY: LazyLock<Option<Polyhedron>> =
        LazyLock::new(|| library::design("tolkowsky", &BTreeMap::new())?.ok()?.solid().ok());
    TOLKOWSKY.as_ref()
}
