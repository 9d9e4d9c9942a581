//! The drawings: two plans with the wheel around them, two side views, names in the facets.

use super::labels;
use super::projection::{self, DiagramView, VisibleFacet};
use super::rows::{DiagramRow, LISTED};
use super::sheet::{self, FACET, OUTLINE, Sheet};
use super::wheel;
use crate::design::{Gear, Zone};
use crate::geometry::Polyhedron;
use crate::geometry::measure::convex_hull;
use crate::report::svg_canvas::Element;
use glam::{DVec2, DVec3};

/// Size of names on the girdle in mm, and how many of a tier are named there.
const GIRDLE: f64 = 2.0;
const GIRDLE_NAMES: usize = 24;

/// Room between the stone and the wheel, for the names of girdle facets, in mm.
const RING: f64 = 4.6;

/// A stone to draw, and how large.
pub struct StoneViews<'a> {
    /// Its solid.
    pub solid: &'a Polyhedron,
    /// Its tiers.
    pub rows: &'a [DiagramRow],
    /// Its wheel.
    pub gear: Gear,
    /// Middle of its box, in the design's unit. The wheel stands about it: an index is a direction.
    middle: DVec3,
    /// Farthest corner from there, seen from above.
    reach: f64,
    /// For each face the number of its row.
    row_of: Vec<Option<usize>>,
}

/// A view in its place on the page.
struct PlacedView {
    view: DiagramView,
    facets: Vec<VisibleFacet>,
    outline: Vec<DVec2>,
}

impl<'a> StoneViews<'a> {
    /// The stone with its tiers.
    pub fn new(solid: &'a Polyhedron, rows: &'a [DiagramRow], gear: Gear) -> StoneViews<'a> {
        let (lo, hi) = solid.bounds();
        let middle = (lo + hi) * 0.5;
        let reach = solid.outline().iter().map(|p| p.distance(middle.truncate())).fold(0.0, f64::max);
        let mut row_of = vec![None; solid.faces.len()];
        for (number, row) in rows.iter().enumerate() {
            row.faces.iter().for_each(|&face| row_of[face] = Some(number));
        }
        StoneViews { solid, rows, gear, middle, reach, row_of }
    }

    /// Scale in mm to the design's unit at which a plan with its wheel is `side` mm wide.
    pub fn scale(&self, side: f64) -> f64 {
        (0.5 * side - wheel::OUTSIDE - wheel::INSIDE - RING) / self.reach
    }

    /// Extent of a side view in the design's unit.
    pub fn extent(&self, view: DiagramView) -> DVec2 {
        let (lo, hi) = self.solid.bounds();
        (view.project(hi) - view.project(lo)).abs()
    }

    /// The view with the stone's middle at `at` on the page.
    fn placed(&self, view: DiagramView, at: DVec2, scale: f64) -> PlacedView {
        let place = |p: DVec2| at + (p - view.project(self.middle)) * scale;
        let mut facets = view.facets(self.solid);
        facets.iter_mut().flat_map(|f| &mut f.corners).for_each(|p| *p = place(*p));
        let outline = convex_hull(self.solid.vertices.iter().map(|v| place(view.project(*v))).collect());
        PlacedView { view, facets, outline }
    }

    /// A plan with its wheel, `side` mm wide, its middle at `at`; the codes of tiers that are too
    /// small for a name there are given back.
    pub fn plan(&self, pen: &mut Sheet, view: DiagramView, at: DVec2, side: f64) -> Vec<&'a str> {
        let placed = self.placed(view, at, self.scale(side));
        let side_of = |zone| match view {
            DiagramView::Pavilion => matches!(zone, Zone::Pavilion | Zone::Culet | Zone::Girdle),
            _ => matches!(zone, Zone::Crown | Zone::Table | Zone::Girdle),
        };
        // a girdle of many flats would mark every tooth
        let rows = self.rows.iter().filter(|r| side_of(r.zone) && r.indices.len() <= LISTED);
        let mut cut: Vec<f64> = rows.flat_map(|r| r.indices.iter().copied()).collect();
        cut.sort_by(f64::total_cmp);
        cut.dedup_by(|a, b| (*a - *b).abs() < 0.005);
        wheel::draw(pen, self.gear, view, at, 0.5 * side - wheel::OUTSIDE, &cut);
        self.lines(pen, &placed);
        self.girdle_names(pen, view, at, self.scale(side));
        self.names(pen, &placed)
    }

    /// A side view, its middle at `at`.
    pub fn side(&self, pen: &mut Sheet, view: DiagramView, at: DVec2, scale: f64) {
        let placed = self.placed(view, at, scale);
        self.lines(pen, &placed);
        self.names(pen, &placed);
    }

    fn lines(&self, pen: &mut Sheet, placed: &PlacedView) {
        let name = placed.view.name();
        let facets = projection::path(placed.facets.iter().map(|f| f.corners.as_slice()));
        pen.named_lines(&format!("{name}-facets"), facets, FACET);
        pen.named_lines(&format!("{name}-outline"), projection::path([placed.outline.as_slice()]), OUTLINE);
    }

    /// The codes of the tiers inside their facets; those that found no room are given back.
    fn names(&self, pen: &mut Sheet, placed: &PlacedView) -> Vec<&'a str> {
        let mut nowhere = Vec::new();
        let mut names = Element::group().id(&format!("{}-names", placed.view.name()));
        for (number, row) in self.rows.iter().enumerate() {
            let own = placed.facets.iter().filter(|f| self.row_of[f.face] == Some(number));
            let polygons: Vec<&[DVec2]> = own.map(|f| f.corners.as_slice()).collect();
            let plan = matches!(placed.view, DiagramView::Crown | DiagramView::Pavilion);
            let mut labels = labels::place(&row.code, &polygons, plan);
            if row.zone == Zone::Girdle && row.faces.len() > GIRDLE_NAMES {
                labels.sort_by(|a, b| b.size.total_cmp(&a.size));
                labels.truncate(1);
            }
            if labels.is_empty() && !polygons.is_empty() {
                nowhere.push(row.code.as_str());
            }
            labels.iter().for_each(|l| names.push(sheet::name(l.at, l.size, l.along, &row.code)));
        }
        pen.push(names);
        nowhere
    }

    /// The codes of girdle facets outside the edges that they are in a plan. Where a name would run
    /// into another it is left out, but every tier has its first.
    fn girdle_names(&self, pen: &mut Sheet, view: DiagramView, at: DVec2, scale: f64) {
        let mut boxes: Vec<(DVec2, DVec2)> = Vec::new();
        let rows = self.rows.iter().filter(|r| r.zone == Zone::Girdle);
        let most = rows.clone().map(|r| r.faces.len()).max().unwrap_or_default();
        for turn in 0..most {
            for row in
                rows.clone().filter(|r| turn < if r.faces.len() > GIRDLE_NAMES { 1 } else { r.faces.len() })
            {
                let face = row.faces[turn];
                let corners: Vec<DVec3> = self.solid.polygon(face).collect();
                let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
                let out = view.project(self.solid.area_vector(face)).normalize_or_zero();
                let half = labels::half_box(&row.code) * GIRDLE;
                let middle =
                    at + view.project(middle - self.middle) * scale + out * (out.abs().dot(half) + 0.7);
                let apart = |(other, its): &(DVec2, DVec2)| {
                    let gap = (*other - middle).abs() - *its - half;
                    gap.max_element() > 0.5
                };
                if boxes.iter().all(apart) {
                    pen.push(sheet::name(middle, GIRDLE, DVec2::X, &row.code));
                    boxes.push((middle, half));
                }
            }
        }
    }
}
