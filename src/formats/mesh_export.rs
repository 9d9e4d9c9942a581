//! Mesh export, a stone's surface as the mesh formats write it: of a design, or of a mesh that is no convex stone.

use super::error::FormatError;
use crate::design::{Design, LengthUnit, USUAL_WIDTH_MM};
use crate::geometry::ClosedMesh;
use crate::geometry::measure::{calipers, convex_hull};
use crate::materials::Material;
use glam::DVec3;

/// Corners nearer than this, in parts of the stone's diagonal, are written as one: planes of a design
/// with so many decimals miss their common corners by about as much, and nearer corners would
/// coincide in `f32` and leave triangles without area.
const ONE_CORNER: f64 = 2e-7;

/// Polygons and triangles of one closed surface, each part of a facet.
#[derive(Debug)]
pub struct MeshExport {
    /// The stone's name.
    pub name: String,
    /// Unit of the corners.
    pub unit: LengthUnit,
    /// What the stone is made of.
    pub material: Material,
    /// Corners.
    pub vertices: Vec<DVec3>,
    /// Name and outward unit normal of each facet.
    pub facets: Vec<(String, DVec3)>,
    /// Facet and corner numbers of each polygon, counter-clockwise seen from outside.
    pub polygons: Vec<(usize, Vec<usize>)>,
    /// The same surface in triangles.
    pub triangles: Vec<(usize, [usize; 3])>,
}

impl MeshExport {
    /// The solid of the design's planes: one polygon a facet.
    ///
    /// - `material`: what it is made of; none takes the index that the design was drawn for, or diamond
    pub fn from_design(design: &Design, material: Option<&Material>) -> Result<MeshExport, FormatError> {
        let exact =
            design.solid().map_err(|cause| FormatError::Solid { file: design.name.clone(), cause })?;
        let (low, high) = exact.bounds();
        let solid = exact.welded(ONE_CORNER * (high - low).length());
        let (labels, planes, mesh) = (facet_labels(design), design.planes(), solid.triangulate());
        Ok(MeshExport {
            name: design.name.clone(),
            unit: design.unit,
            material: material.cloned().unwrap_or_else(|| Material::drawn_for(design.refractive_index)),
            facets: solid.faces.iter().map(|f| (labels[f.plane].clone(), planes[f.plane].normal)).collect(),
            polygons: solid.faces.iter().map(|f| f.corners.clone()).enumerate().collect(),
            triangles: mesh.faces.into_iter().zip(mesh.triangles).collect(),
            vertices: solid.vertices,
        })
    }

    /// Length of the corners' unit in millimetres; a surface without unit is taken as
    /// [`USUAL_WIDTH_MM`] wide.
    pub fn unit_mm(&self) -> f64 {
        match self.unit {
            LengthUnit::Millimetre => 1.0,
            LengthUnit::Free => {
                let outline = convex_hull(self.vertices.iter().map(|v| v.truncate()).collect());
                USUAL_WIDTH_MM / calipers(&outline).0
            }
        }
    }

    /// The triangles of a mesh, ordered by facet.
    ///
    /// - `unit`: of the mesh's corners
    pub fn from_closed_mesh(name: &str, body: &ClosedMesh, unit: LengthUnit) -> MeshExport {
        let mut triangles: Vec<_> = body.facet_of.iter().copied().zip(body.triangles.clone()).collect();
        triangles.sort_by_key(|(facet, _)| *facet);
        let label = |(i, name): (usize, &String)| {
            if name.is_empty() { format!("facet {}", i + 1) } else { name.clone() }
        };
        let labels = body.facets.iter().map(|f| &f.name).enumerate().map(label);
        MeshExport {
            name: name.into(),
            unit,
            material: Material::drawn_for(None),
            vertices: body.vertices.clone(),
            facets: labels.zip(body.facets.iter().map(|f| f.normal)).collect(),
            polygons: triangles.iter().map(|(f, t)| (*f, t.to_vec())).collect(),
            triangles,
        }
    }
}

/// A name for each facet, in the order of [`Design::facets`]: see [`crate::design::Tier::labels`].
pub(super) fn facet_labels(design: &Design) -> Vec<String> {
    design.tiers.iter().enumerate().flat_map(|(t, tier)| tier.labels(t + 1)).collect()
}
