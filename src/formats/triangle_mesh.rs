//! Triangle meshes of scenery, what stands around stones in a scene. OBJ, glTF, STL or PLY, of any shape.

use super::error::FormatError;
use super::input::Input;
use super::mesh_import::PolygonMesh;
use super::{glb, obj, ply, read_file, stl};
use crate::limits::Limits;
use crate::storage::text;
use glam::DVec3;
use std::path::Path;

/// Corners and triangles of a mesh, in the file's unit, +z up.
#[derive(Debug, Clone, Default)]
pub struct Triangles {
    /// Corners.
    pub vertices: Vec<DVec3>,
    /// Numbers of each triangle's corners.
    pub triangles: Vec<[usize; 3]>,
}

/// Reads an OBJ, glTF, GLB, STL or PLY file, a regular one; polygons become fans of triangles.
///
/// Errors name the file and the place in it.
pub fn triangles(path: &Path, limits: Limits) -> Result<Triangles, FormatError> {
    let name = text::display_name(path);
    let bytes = read_file(path, limits)?;
    triangles_from(&Input {
        name: &name,
        bytes: &bytes,
        folder: Some(path.parent().unwrap_or(Path::new(""))),
        limits,
    })
}

/// As [`triangles`], of a file's bytes.
pub fn triangles_from(source: &Input) -> Result<Triangles, FormatError> {
    let PolygonMesh { vertices, polygons, .. } =
        if [&glb::GLB, &glb::GLTF].iter().any(|f| (f.sniff)(source) > 0) {
            glb::mesh(source)?
        } else if ply::is_one(source) {
            ply::mesh(source)?
        } else if let Some(mesh) = stl::mesh(source) {
            mesh?
        } else {
            obj::mesh(source)?
        };
    let mut triangles = Vec::new();
    for p in &polygons {
        if let Some(c) = p.corners.iter().find(|c| vertices.get(**c).is_none_or(|v| !v.is_finite())) {
            return Err(source.at_byte(0, "finite corners", format!("corner {c}")));
        }
        triangles.extend((2..p.corners.len()).map(|i| [p.corners[0], p.corners[i - 1], p.corners[i]]));
    }
    if triangles.is_empty() {
        return Err(source.at_byte(0, "at least one triangle", "none"));
    }
    Ok(Triangles { vertices, triangles })
}
