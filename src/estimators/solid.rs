//! The solid: closed forms of a stone's shape, without light.

use super::kind::{Better, EstimatorKind, Method, Metric, MetricSource, Setup};
use crate::design::library;
use crate::geometry::Polyhedron;
use crate::geometry::measure::polygon_area;
use crate::sampling::tally::Column;
use crate::trace::ConvexStone;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// The solid itself: it has no sums.
#[derive(Debug, Clone, Copy)]
pub struct SolidKind;

impl EstimatorKind for SolidKind {
    fn name(&self) -> &'static str {
        "solid"
    }

    fn metrics(&self) -> &'static [Metric] {
        &METRICS
    }

    fn columns(&self) -> &'static [Column] {
        &[]
    }

    fn methods<'a>(&self, _: &'a ConvexStone, _: Setup<'a>, _: &[&Metric]) -> Vec<Method<'a>> {
        Vec::new()
    }
}

const SOLID: &str = "Geometry of the solid, no light.";

/// What the rows have in common.
const ROW: Metric = Metric {
    source: "defined by cutlab; proportions of the other stone: M. Tolkowsky, Diamond Design (1919)",
    ..Metric::of(&SolidKind, MetricSource::Solid(spread))
};

/// The metrics.
static METRICS: [Metric; 2] = [
    Metric {
        name: "spread",
        about: "how much larger the stone looks than a Tolkowsky brilliant of equal mass",
        unit: "%",
        range: (-100.0, 10000.0),
        scale: 100.0,
        better: Better::More,
        definition: &[
            SOLID,
            "Area of the outline seen face-up per that of the library's Tolkowsky brilliant of equal \
                mass, less 1, in percent.",
        ],
        read_from: MetricSource::Solid(|solid| Some(100.0 * (spread(solid)? - 1.0))),
        ..ROW
    },
    Metric {
        name: "weight_ratio",
        about: "mass per mass of a Tolkowsky brilliant of equal girdle width",
        range: (0.0, 1000.0),
        definition: &[
            SOLID,
            "Mass per that of the library's Tolkowsky brilliant of equal girdle width (the least distance \
                of two parallels that hold the outline) and the same material.",
        ],
        read_from: MetricSource::Solid(weight_ratio),
        ..ROW
    },
];

/// Outline area per that of the Tolkowsky stone of equal mass.
fn spread(solid: &Polyhedron) -> Option<f64> {
    let area = |s: &Polyhedron| polygon_area(&s.hull()) / s.volume().powf(2.0 / 3.0);
    Some(area(solid) / area(tolkowsky()?))
}

/// Volume per that of the Tolkowsky stone as wide.
fn weight_ratio(solid: &Polyhedron) -> Option<f64> {
    let volume = |s: &Polyhedron| s.volume() / s.width().powi(3);
    Some(volume(solid) / volume(tolkowsky()?))
}

/// The library's Tolkowsky brilliant.
fn tolkowsky() -> Option<&'static Polyhedron> {
    static TOLKOWSKY: LazyLock<Option<Polyhedron>> =
        LazyLock::new(|| library::design("tolkowsky", &BTreeMap::new())?.ok()?.solid().ok());
    TOLKOWSKY.as_ref()
}
