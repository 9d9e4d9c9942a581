//! glTF and GLB meshes. Buffers are read from the file itself or its folder, never from elsewhere.
//!
//! glTF's +y is up and cutlab's is +z, so the stone is turned; its lengths are metres. Facet names and normals
//! travel in each primitive's `extras`: `{"facet": "main 1", "normal": [x, y, z]}`.

mod buffers;
mod document;

use super::error::{FormatError, counted, quoted_excerpt};
pub use super::glb_write::{FacetExtras, UNIT_MM};
use super::input::Input;
use super::mesh_import::{Digits, PolygonMesh, stone_from_mesh};
use super::{Format, Parsed, Writer, glb_write};
use crate::design::LengthUnit;
use crate::geometry::facet_recovery::Polygon;
use crate::limits;
use document::{GltfDocument, Node, Primitive, document};
use glam::{DMat4, DQuat, DVec3, DVec4};
use std::borrow::Cow;
use std::collections::{BTreeMap, HashSet};
use std::sync::Arc;

/// Binary glTF 2.0.
pub static GLB: Format = Format {
    name: "glb",
    extensions: &["glb"],
    about: "glTF 2.0 mesh in binary, one primitive a facet",
    sniff: |source| if source.bytes.starts_with(b"glTF") { 100 } else { 0 },
    read,
    write: Some(Writer::Mesh(glb_write::write_binary)),
    rewrite: None,
};

/// glTF 2.0 as text.
pub static GLTF: Format = Format {
    name: "gltf",
    extensions: &["gltf"],
    about: "glTF 2.0 mesh as text, one primitive a facet; written with its buffer inside",
    sniff,
    read,
    write: Some(Writer::Mesh(glb_write::write_text)),
    rewrite: None,
};

fn sniff(source: &Input) -> u8 {
    let is_json = source.beginning().trim_start().starts_with('{');
    if is_json && document::is_one(&source.text()) { 80 } else { 0 }
}

/// Wider than this, in metres, is no stone: the unit is another one, and unknown.
const WIDEST: f64 = 0.5;

struct GltfReader<'a> {
    source: &'a Input<'a>,
    document: &'a GltfDocument,
    /// The GLB's own buffer.
    inside: Option<&'a [u8]>,
    /// Buffers that were fetched, by number: only those that are needed.
    buffers: BTreeMap<usize, Cow<'a, [u8]>>,
    fetched: usize,
    mesh: PolygonMesh,
    /// Points, lines and primitives without places.
    left_out: usize,
    /// Primitives that were met: many nodes may show one mesh.
    met: usize,
    /// Nodes that were visited: in a tree none is twice.
    seen: Vec<bool>,
}

fn read(source: &Input) -> Result<Parsed, FormatError> {
    let mut mesh = mesh(source)?;
    let used = || mesh.polygons.iter().flat_map(|p| &p.corners).map(|c| mesh.vertices[*c]);
    let (low, high) =
        used().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    let widest = (high - low).max_element();
    let is_in_metres = widest < WIDEST;
    if is_in_metres {
        mesh.vertices.iter_mut().for_each(|v| *v *= UNIT_MM);
    } else if widest.is_finite() {
        mesh.warnings.push(format!("{widest:.3} m wide, as no stone is: the unit is taken as unknown"));
    }
    let known = if is_in_metres { LengthUnit::Millimetre } else { LengthUnit::Free };
    Ok(stone_from_mesh(source, &mesh)?.in_unit(known))
}

/// The mesh as it stands in the file, +z up.
pub(super) fn mesh(source: &Input) -> Result<PolygonMesh, FormatError> {
    let (document, inside, warnings) = document(source)?;
    let (buffers, seen) = (BTreeMap::new(), vec![false; document.nodes.len()]);
    let mesh = PolygonMesh { corners: Digits::F32, normals: Digits::F64, warnings, ..PolygonMesh::default() };
    let mut reader = GltfReader {
        source,
        document: &document,
        inside,
        buffers,
        fetched: 0,
        mesh,
        left_out: 0,
        met: 0,
        seen,
    };
    let upright = DMat4::from_cols(DVec4::X, DVec4::Z, DVec4::NEG_Y, DVec4::W);
    let shown = document.scene.unwrap_or_default();
    let roots: Vec<usize> = match document.scenes.get(shown) {
        Some(scene) => scene.nodes.clone(),
        None => {
            let children: HashSet<usize> = document.nodes.iter().flat_map(|n| n.children.clone()).collect();
            (0..document.nodes.len()).filter(|n| !children.contains(n)).collect()
        }
    };
    if document.scenes.len() > 1 {
        let said = format!("scene {} of {} is read", shown + 1, document.scenes.len());
        reader.mesh.warnings.push(said);
    }
    // in the file's order; a stack of our own, so that no nesting is too deep
    let mut next: Vec<(usize, DMat4)> = roots.into_iter().rev().map(|node| (node, upright)).collect();
    while let Some((index, above)) = next.pop() {
        if reader.seen.get_mut(index).is_some_and(|seen| std::mem::replace(seen, true)) {
            return Err(reader.bad("a tree of nodes", "a node twice"));
        }
        let Some(node) = document.nodes.get(index) else {
            return Err(reader.bad(&format!("a node below {}", document.nodes.len()), index.to_string()));
        };
        let world = reader.node(node, above)?;
        next.extend(node.children.iter().rev().map(|child| (*child, world)));
    }
    if reader.left_out > 0 {
        let said = format!("{} of points or lines left out", counted(reader.left_out, "primitive"));
        reader.mesh.warnings.push(said);
    }
    Ok(reader.mesh)
}

impl<'a> GltfReader<'a> {
    fn bad(&self, expected: &str, found: impl Into<String>) -> FormatError {
        self.source.at_byte(0, expected, found)
    }

    /// The meshes of one node, and the frame of its children.
    fn node(&mut self, node: &Node, above: DMat4) -> Result<DMat4, FormatError> {
        let world = above * frame(node);
        let Some(mesh) = node.mesh else { return Ok(world) };
        let Some(mesh) = self.document.meshes.get(mesh) else {
            return Err(self.bad(&format!("a mesh below {}", self.document.meshes.len()), mesh.to_string()));
        };
        const INSTANCES: &str = "EXT_mesh_gpu_instancing";
        if node.extensions.contains_key(INSTANCES) {
            return Err(self.bad("a mesh in one place", format!("{INSTANCES}, which is not read")));
        }
        if node.skin.is_some() {
            return Err(self.bad("a mesh of fixed shape", "a skin, which is not read"));
        }
        let weights = node.weights.as_ref().unwrap_or(&mesh.weights);
        for primitive in &mesh.primitives {
            if !primitive.targets.is_empty() && weights.iter().any(|w| *w != 0.0) {
                return Err(
                    self.bad("a mesh of fixed shape", "a morph target with weight, which is not read")
                );
            }
            self.primitive(primitive, world)?;
        }
        Ok(world)
    }

    fn primitive(&mut self, primitive: &Primitive, world: DMat4) -> Result<(), FormatError> {
        /// As the format numbers them; others are points and lines.
        const TRIANGLES: u64 = 4;
        const STRIP: u64 = 5;
        const FAN: u64 = 6;
        self.met += 1;
        self.source.within(&limits::POLYGONS, self.met)?;
        let mode = primitive.mode.unwrap_or(TRIANGLES);
        let corner_sets: fn(usize) -> [usize; 3] = match mode {
            TRIANGLES => |i| [3 * i, 3 * i + 1, 3 * i + 2],
            // winding alternates in a strip; it is made consistent later
            STRIP => |i| [i, i + 1, i + 2],
            FAN => |i| [0, i + 1, i + 2],
            _ => {
                self.left_out += 1;
                return Ok(());
            }
        };
        let Some(positions) = primitive.attributes.get("POSITION") else {
            self.left_out += 1;
            return Ok(());
        };
        let positions = self.accessor(*positions)?;
        if positions.shape != "VEC3" {
            return Err(self.bad("positions of three numbers", quoted_excerpt(&positions.shape)));
        }
        let packed = primitive.extensions.keys().find(|name| name.ends_with(PACKED));
        let first = self.mesh.vertices.len();
        let (kind, normalised) = (self.component(positions.component_type)?, positions.normalized);
        let bytes = self.elements(positions, 3 * kind.size(), packed)?;
        let point = |bytes: &[u8]| {
            let mut numbers = bytes.chunks_exact(kind.size()).map(|b| kind.float(normalised, b));
            world.transform_point3(DVec3::from_array([0; 3].map(|_| numbers.next().unwrap_or_default())))
        };
        let points: Vec<DVec3> = bytes.chunks_exact(3 * kind.size()).map(point).collect();
        let order: Vec<usize> = match primitive.indices {
            None => (0..points.len()).collect(),
            Some(indices) => {
                let indices = self.accessor(indices)?;
                let size = self.component(indices.component_type)?.size();
                self.elements(indices, size, packed)?.chunks_exact(size).map(unsigned).collect()
            }
        };
        if let Some(i) = order.iter().find(|&&i| i >= points.len()) {
            return Err(self.bad(&format!("an index below {}", points.len()), i.to_string()));
        }
        let triangles = if mode == TRIANGLES { order.len() / 3 } else { order.len().saturating_sub(2) };
        self.source.within(&limits::POLYGONS, self.mesh.polygons.len() + triangles)?;
        self.source.within(&limits::CORNERS, first + points.len())?;
        let FacetExtras { facet, normal } =
            serde_json::from_value(primitive.extras.clone()).unwrap_or_default();
        let name: Arc<str> = facet.into();
        // exact for our own turn of a right angle; a stated normal that does not fit is not used
        let normal = normal.map(|n| world.transform_vector3(DVec3::from_array(n)));
        self.mesh.vertices.extend(points);
        for i in 0..triangles {
            let corners = corner_sets(i).map(|k| first + order[k]).to_vec();
            self.mesh.polygons.push(Polygon { name: name.clone(), corners, normal });
        }
        Ok(())
    }
}

/// A node's own frame: its matrix, or what its parts make.
fn frame(node: &Node) -> DMat4 {
    node.matrix.map_or_else(
        || {
            DMat4::from_scale_rotation_translation(
                node.scale.map_or(DVec3::ONE, DVec3::from_array),
                node.rotation.map_or(DQuat::IDENTITY, |r| DQuat::from_array(r).normalize()),
                node.translation.map_or(DVec3::ZERO, DVec3::from_array),
            )
        },
        |matrix| DMat4::from_cols_array(&matrix),
    )
}

/// What the names of extensions end in that pack buffers: Draco's, meshopt's.
const PACKED: &str = "_compression";

/// An unsigned number of any length, least byte first.
fn unsigned(bytes: &[u8]) -> usize {
    bytes.iter().rev().fold(0, |n, &b| n << 8 | b as usize)
}
