//! Weight ratio.

use super::{Better, Metric, Reading};
use crate::cut::library;
use crate::solid::Polyhedron;
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
    dented: false,
    definition: "Geometry of the solid, no light. Mass per that of the library's Tolkowsky brilliant of \
        equal girdle width (the least distance of two parallels that hold the outline) and the same \
        material.",
    source: "defined by cutlab; proportions of the other stone: M. Tolkowsky, Diamond Design (1919)",
    reading: Reading::Solid(weight_ratio),
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
