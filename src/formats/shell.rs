//! What every mesh format does with the polygons it has read: make a design of them.

use super::Reading;
use super::error::FormatError;
use super::source::Source;
use crate::cut::Design;
use crate::solid::recover::{Polygon, RecoverError, facets_of_polygons};
use glam::DVec3;

/// Stated normals of text formats in full `f64` must fit their corners within this part of the
/// mesh's diagonal: well above rounding, below what six or nine decimals give.
pub const STATED_IN_F64: f64 = 1e-11;

/// The same for normals and corners in `f32`: a few roundings of the largest coordinate.
pub const STATED_IN_F32: f64 = 3e-7;

/// A merge tolerance beyond this is worth telling: the mesh is coarser than `f32`.
const COARSE: f64 = 2e-6;

/// The design of a mesh's facets. Facets keep their names; the design gets the file's.
pub fn design_of_mesh(
    source: &Source,
    vertices: &[DVec3],
    polygons: &[Polygon],
    stated_within: f64,
) -> Result<Reading, FormatError> {
    let (design, warnings) = recovered(&source.stem(), vertices, polygons, stated_within)
        .map_err(|cause| FormatError::Mesh { file: source.name.into(), cause })?;
    Ok(Reading { design, warnings })
}

/// As [`design_of_mesh`], for a reader that has several meshes to try.
pub fn recovered(
    name: &str,
    vertices: &[DVec3],
    polygons: &[Polygon],
    stated_within: f64,
) -> Result<(Design, Vec<String>), RecoverError> {
    let found = facets_of_polygons(vertices, polygons, stated_within)?;
    let tolerance = found.tolerance;
    let design = Design::of_facets(name, found.stone()?);
    let mut warnings = Vec::new();
    if tolerance > COARSE {
        warnings
            .push(format!("coarse mesh: faces were taken as coplanar within {tolerance:.0e} of its size"));
    }
    Ok((design, warnings))
}
