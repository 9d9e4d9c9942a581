//! Spread.

use super::weight_ratio::tolkowsky;
use super::{Better, Metric, MetricSource};
use crate::geometry::Polyhedron;
use crate::geometry::measure::polygon_area;

/// Spread.
pub static SPREAD: Metric = Metric {
    name: "spread",
    about: "how much larger the stone looks than a Tolkowsky brilliant of equal mass",
    unit: "%",
    range: (-100.0, 10000.0),
    scale: 100.0,
    better: Better::More,
    observer: None,
    by_beams: false,
    nonconvex: false,
    definition: "Geometry of the solid, no light. Area of the outline seen face-up per that of the \
        library's Tolkowsky brilliant of equal mass, less 1, in percent.",
    source: "defined by cutlab; proportions of the other stone: M. Tolkowsky, Diamond Design (1919)",
    read_from: MetricSource::Solid(|solid| Some(100.0 * (spread(solid)? - 1.0))),
};

/// Outline area per that of the Tolkowsky stone of equal mass.
fn spread(solid: &Polyhedron) -> Option<f64> {
    let area = |s: &Polyhedron| polygon_area(&s.hull()) / s.volume().powf(2.0 / 3.0);
    Some(area(solid) / area(tolkowsky()?))
}
