//! Orientation: whether a stone stands with its table up, and which way is up otherwise.
//!
//! Every measure and score takes +z for the direction through the table. A design file has it so by
//! definition, a mesh by luck.

use super::symmetry::{self, Symmetry};
use super::tiers::Zone;
use crate::geometry::{ClosedMesh, Polyhedron};
use glam::{DMat3, DQuat, DVec3};

/// Facets and corners whose directions are tried as axes of the stone, the largest and farthest first.
const TRIED: usize = 24;

/// A facet with this many times the area of any other is the table of a stone without symmetry.
const LARGEST: f64 = 2.0;

/// A flat at the bottom with this many times the area of the one on top is no culet.
const NO_CULET: f64 = 1.5;

/// Directions that differ by less than this (0.06°) are one.
const ONE_DIRECTION: f64 = 1e-3;

/// How [`doubt`] begins.
pub const MAX_TRUSTED_DEVIATION_DEG: &str = "the stone does not stand table up";

/// The rotation about the origin that turns the direction `up` to +z.
pub fn turned_up(up: DVec3) -> DMat3 {
    // half a turn has no shortest way: about x, so that left and right change places with front and back
    if up.normalize().distance(DVec3::NEG_Z) < 1e-12 {
        return DMat3::from_cols(DVec3::X, DVec3::NEG_Y, DVec3::NEG_Z);
    }
    DMat3::from_quat(DQuat::from_rotation_arc(up.normalize(), DVec3::Z))
}

/// Why a stone seems not to stand table up, in words; none if it does, or if nothing tells.
///
/// A stone is doubted if it is symmetric about another axis and not about z, if by far its largest facet
/// is not horizontal, or if the flat at its bottom is larger than its table and has facets
/// around it. Checked in `tests/program/orientation.rs` on every cut of the library.
pub fn doubt(solid: &Polyhedron) -> Option<String> {
    let faces = Faces::new(solid);
    if faces.is_upside_down() {
        return said("the flat below is larger than the one on top".into());
    }
    let upright = about(solid, DVec3::Z).order;
    if upright == 1 {
        let axis = faces.axes(solid).into_iter().find(|a| about(solid, *a).order > 1);
        if let Some(axis) = axis {
            let off = axis.truncate().length().atan2(axis.z.abs()).to_degrees();
            return said(format!("its axis of symmetry leans by {off:.1}°"));
        }
    }
    faces.leaning().and_then(said)
}

fn said(why: String) -> Option<String> {
    Some(format!("{MAX_TRUSTED_DEVIATION_DEG}: {why}; --align or --up turns it"))
}

/// As [`doubt`], of a stone with concavities, whose symmetry is not looked for.
pub fn doubt_of_body(body: &ClosedMesh) -> Option<String> {
    let faces = Faces::from_areas(body.area_vectors());
    if faces.is_upside_down() {
        return said("the flat below is larger than the one on top".into());
    }
    faces.leaning().and_then(said)
}

/// The direction that is up in the frame of a stone with concavities: the normal of its largest facet.
pub fn up_of_body(body: &ClosedMesh) -> DVec3 {
    Faces::from_areas(body.area_vectors()).sorted.first().map_or(DVec3::Z, |(_, normal)| *normal)
}

/// The direction that is up in the stone's own frame: its axis of highest symmetry, or of a stone without
/// one the normal of its largest facet.
///
/// Of the axis's ends that one is up which has the larger flat with facets around it; without such flats
/// the one that is nearer to z.
pub fn up_of(solid: &Polyhedron) -> DVec3 {
    let faces = Faces::new(solid);
    let best = |best: (usize, DVec3), axis: DVec3| {
        let order = about(solid, axis).order;
        if order > best.0 { (order, axis) } else { best }
    };
    let (order, axis) = faces.axes(solid).into_iter().fold((about(solid, DVec3::Z).order, DVec3::Z), best);
    if order == 1 {
        return faces.sorted.first().map_or(DVec3::Z, |(_, normal)| *normal);
    }
    let axis = if axis.z < -ONE_DIRECTION { -axis } else { axis };
    let turned = Faces::new(&rotated(solid, turned_up(axis)));
    if turned.is_upside_down() { -axis } else { axis }
}

/// Symmetry about an axis through the stone.
fn about(solid: &Polyhedron, axis: DVec3) -> Symmetry {
    let width = solid.bounding_sphere().1;
    symmetry::measure(&rotated(solid, turned_up(axis)), super::proportions::SLIVER * width * width)
}

fn rotated(solid: &Polyhedron, rotation: DMat3) -> Polyhedron {
    let vertices = solid.vertices.iter().map(|v| rotation * *v).collect();
    Polyhedron { vertices, ..solid.clone() }
}

/// Areas and normals of the facets, the largest first.
struct Faces {
    sorted: Vec<(f64, DVec3)>,
}

impl Faces {
    fn new(solid: &Polyhedron) -> Faces {
        Faces::from_areas((0..solid.faces.len()).map(|f| solid.area_vector(f)).collect())
    }

    fn from_areas(areas: Vec<DVec3>) -> Faces {
        let mut sorted: Vec<(f64, DVec3)> =
            areas.into_iter().map(|v| (v.length(), v.normalize_or_zero())).collect();
        sorted.sort_by(|a, b| b.0.total_cmp(&a.0));
        Faces { sorted }
    }

    /// How far by far the largest facet is from horizontal, in words, if it is not.
    fn leaning(&self) -> Option<String> {
        let [(largest, normal), (next, _)] = *self.sorted.first_chunk::<2>()?;
        if [Zone::Table, Zone::Culet].contains(&Zone::from_normal(normal)) || largest <= LARGEST * next {
            return None;
        }
        let off = normal.truncate().length().atan2(normal.z).to_degrees();
        Some(format!("its largest facet leans by {off:.1}°"))
    }

    /// Area of the largest facet of a zone.
    fn largest(&self, zone: Zone) -> f64 {
        self.sorted.iter().find(|(_, n)| Zone::from_normal(*n) == zone).map_or(0.0, |(area, _)| *area)
    }

    fn has(&self, zone: Zone) -> bool {
        self.largest(zone) > 0.0
    }

    /// Whether the largest facet is a flat below, larger than that on top, with slanting facets around it
    /// as a table has; the base of a rose cut has none.
    fn is_upside_down(&self) -> bool {
        let (largest, normal) = self.sorted.first().copied().unwrap_or_default();
        let is_flat_below = Zone::from_normal(normal) == Zone::Culet;
        is_flat_below && self.has(Zone::Pavilion) && largest > NO_CULET * self.largest(Zone::Table)
    }

    /// Directions that an axis of the stone may have: normals of facets, and corners seen from its middle.
    fn axes(&self, solid: &Polyhedron) -> Vec<DVec3> {
        let (_, middle) = solid.volume_and_centre();
        let mut corners: Vec<DVec3> = solid.vertices.iter().map(|v| *v - middle).collect();
        corners.sort_by(|a, b| b.length().total_cmp(&a.length()));
        let mut axes: Vec<DVec3> = Vec::new();
        for group in [self.sorted.iter().map(|(_, n)| *n).collect(), corners] {
            let most = axes.len() + TRIED;
            for axis in group.iter().filter_map(|v| v.try_normalize()) {
                let is_new = axes.iter().all(|a| a.cross(axis).length() > ONE_DIRECTION);
                if is_new && axes.len() < most {
                    axes.push(axis);
                }
            }
        }
        axes
    }
}
