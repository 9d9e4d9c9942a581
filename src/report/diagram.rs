//! Line drawings of a stone as SVG: crown, profile, pavilion.

use crate::solid::Polyhedron;
use glam::{DVec2, DVec3};
use std::fmt::Write;

/// A direction to look from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum View {
    /// From above: the facets that face up.
    Crown,
    /// From below, turned about the x axis: the facets that face down.
    Pavilion,
    /// From the front (−y), table up.
    Profile,
}

impl View {
    /// Name under the drawing.
    pub fn name(self) -> &'static str {
        match self {
            View::Crown => "crown",
            View::Pavilion => "pavilion",
            View::Profile => "profile",
        }
    }

    /// Direction towards the eye.
    fn eye(self) -> DVec3 {
        match self {
            View::Crown => DVec3::Z,
            View::Pavilion => DVec3::NEG_Z,
            View::Profile => DVec3::NEG_Y,
        }
    }

    /// Picture coordinates, y downward.
    fn project(self, p: DVec3) -> DVec2 {
        match self {
            View::Crown => DVec2::new(p.x, -p.y),
            View::Pavilion => DVec2::new(p.x, p.y),
            View::Profile => DVec2::new(p.x, -p.z),
        }
    }
}

/// Inner width of a drawing in its own units; strokes are in proportion.
const WIDTH: f64 = 200.0;
const MARGIN: f64 = 4.0;

/// One view as a self-contained `<svg>` element: the outline of every facet that faces the eye.
/// All views of a stone share one scale.
pub fn svg(solid: &Polyhedron, view: View) -> String {
    let (lo, hi) = solid.bounds();
    let scale = WIDTH / (hi - lo).truncate().max_element();
    let middle = (lo + hi) * 0.5;
    let place = |p: DVec3| view.project(p - middle) * scale;
    let extent = solid.vertices.iter().map(|v| place(*v).abs()).fold(DVec2::ZERO, DVec2::max) + MARGIN;
    let mut path = String::new();
    for face in 0..solid.faces.len() {
        // a facet seen edge-on is a line that its neighbours draw
        if solid.area_vector(face).normalize_or_zero().dot(view.eye()) < 1e-9 {
            continue;
        }
        for (i, corner) in solid.polygon(face).enumerate() {
            let p = place(corner);
            let _ = write!(path, "{}{:.2} {:.2}", if i == 0 { "M" } else { "L" }, p.x, p.y);
        }
        path.push('Z');
    }
    format!(
        "<svg viewBox=\"{:.1} {:.1} {:.1} {:.1}\" role=\"img\" aria-label=\"{}\">\
         <path d=\"{path}\" fill=\"none\" stroke=\"currentColor\" stroke-width=\".7\" stroke-linejoin=\"round\"/></svg>",
        -extent.x,
        -extent.y,
        2.0 * extent.x,
        2.0 * extent.y,
        view.name()
    )
}
