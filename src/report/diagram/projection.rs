//! The four views of a stone: which facets each shows, and where their corners fall on the page.

use crate::design::Zone;
use crate::geometry::Polyhedron;
use crate::report::svg_canvas::{Element, PathData};
use glam::{DVec2, DVec3};

/// A direction to look from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DiagramView {
    /// From above, the front (−y, where index 0 of most gears stands) at the foot of the page.
    Crown,
    /// From below, the stone turned over left to right, so that the front stays at the foot.
    Pavilion,
    /// From the front (−y), table up.
    Side,
    /// From the right (+x), table up.
    End,
}

/// A facet as a view shows it.
#[derive(Debug, Clone)]
pub struct VisibleFacet {
    /// Number of the solid's face.
    pub face: usize,
    /// Its corners, y downward.
    pub corners: Vec<DVec2>,
}

/// A facet whose normal is nearer than this to the plane of a side view is a line there: 0.06°.
const EDGE_ON: f64 = 1e-3;

impl DiagramView {
    /// Name under the drawing.
    pub fn name(self) -> &'static str {
        match self {
            DiagramView::Crown => "crown",
            DiagramView::Pavilion => "pavilion",
            DiagramView::Side => "side",
            DiagramView::End => "end",
        }
    }

    /// Page coordinates in the design's unit, y downward.
    pub fn project(self, p: DVec3) -> DVec2 {
        match self {
            DiagramView::Crown => DVec2::new(p.x, -p.y),
            DiagramView::Pavilion => DVec2::new(-p.x, -p.y),
            DiagramView::Side => DVec2::new(p.x, -p.z),
            DiagramView::End => DVec2::new(p.y, -p.z),
        }
    }

    /// Whether a facet with unit normal `n` is drawn. A stone is convex: what faces the eye is seen
    /// whole, all else is hidden. Girdle facets are lines in the two plans.
    fn shows(self, n: DVec3) -> bool {
        match self {
            DiagramView::Crown => matches!(Zone::from_normal(n), Zone::Table | Zone::Crown),
            DiagramView::Pavilion => matches!(Zone::from_normal(n), Zone::Pavilion | Zone::Culet),
            DiagramView::Side => n.y < -EDGE_ON,
            DiagramView::End => n.x > EDGE_ON,
        }
    }

    /// The facets of the solid that the view shows, in the order of its faces.
    pub fn facets(self, solid: &Polyhedron) -> Vec<VisibleFacet> {
        (0..solid.faces.len())
            .filter(|&face| self.shows(solid.area_vector(face).normalize_or_zero()))
            .map(|face| VisibleFacet {
                face,
                corners: solid.polygon(face).map(|p| self.project(p)).collect(),
            })
            .collect()
    }
}

/// Closed polygons as path data, to a hundredth of the unit.
pub fn path<'a>(polygons: impl IntoIterator<Item = &'a [DVec2]>) -> PathData {
    polygons.into_iter().fold(PathData::new(2), |path, corners| path.polygon(corners.iter().copied()))
}

/// One view as a drawing in the colour of the page that it stands in, without names. All views of a stone
/// share one scale: 200 units are its greatest extent in plan.
pub fn drawing(solid: &Polyhedron, view: DiagramView) -> Element {
    const WIDTH: f64 = 200.0;
    const MARGIN: f64 = 4.0;
    let (lo, hi) = solid.bounds();
    let scale = WIDTH / (hi - lo).truncate().max_element();
    let middle = view.project((lo + hi) * 0.5);
    let place = |p: DVec2| (p - middle) * scale;
    let extent = place(view.project(lo)).abs() + MARGIN;
    let placed: Vec<Vec<DVec2>> =
        view.facets(solid).iter().map(|f| f.corners.iter().map(|p| place(*p)).collect()).collect();
    let lines = Element::path(path(placed.iter().map(Vec::as_slice)));
    Element::drawing(-extent, 2.0 * extent)
        .attribute("role", "img")
        .attribute("aria-label", view.name())
        .with(lines.fill("none").stroke("currentColor", 0.7).round_joins())
}
