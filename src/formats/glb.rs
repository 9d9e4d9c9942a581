//! glTF and GLB meshes. Buffers are read from the file itself or its folder, never from elsewhere.
//!
//! glTF's +y is up and cutlab's is +z, so the stone is turned. Facet names and normals travel in
//! each primitive's `extras`: `{"facet": "main 1", "normal": [x, y, z]}`.

use super::error::{FormatError, shown};
use super::shell::{STATED_IN_F32, design_of_mesh};
use super::source::Source;
use super::{Format, Reading, beside, glb_write};
use crate::solid::recover::{MOST_POLYGONS, Polygon};
use ::gltf::accessor::{DataType, Dimensions};
use ::gltf::mesh::Mode;
use ::gltf::{Accessor, Document, Gltf, Node, Primitive, Semantic, buffer};
use base64::Engine;
use glam::{DMat4, DVec3, DVec4};
use std::collections::HashSet;
use std::sync::Arc;

/// glTF 2.0 meshes, written as GLB with one primitive a facet.
pub static FORMAT: Format = Format {
    name: "glb",
    extensions: &["glb", "gltf"],
    about: "glTF 2.0 mesh, text or binary, one primitive a facet; written as GLB",
    sniff,
    read,
    write: Some(glb_write::write),
};

/// Deepest nesting of nodes; a real file has a dozen.
const DEEPEST: usize = 64;

fn sniff(source: &Source) -> u8 {
    if source.bytes.starts_with(b"glTF") {
        return 100;
    }
    let start = source.beginning();
    let json = start.trim_start().starts_with('{');
    match json {
        true if start.contains("\"asset\"") || start.contains("\"accessors\"") => 80,
        true => 30,
        false => 0,
    }
}

/// What a facet's primitive says about itself.
#[derive(Debug, Default, serde::Serialize, serde::Deserialize)]
pub struct FacetExtras {
    /// The facet's name.
    #[serde(default)]
    pub facet: String,
    /// Its outward normal in the mesh's own frame, in full `f64`.
    #[serde(default)]
    pub normal: Option<[f64; 3]>,
}

struct Reader<'a> {
    source: &'a Source<'a>,
    buffers: Vec<Vec<u8>>,
    vertices: Vec<DVec3>,
    polygons: Vec<Polygon>,
    left_out: usize,
    /// Nodes that were visited: in a tree none is twice.
    seen: Vec<bool>,
}

fn read(source: &Source) -> Result<Reading, FormatError> {
    let (vertices, polygons, left_out) = polygons(source)?;
    let mut reading = design_of_mesh(source, &vertices, &polygons, STATED_IN_F32)?;
    if left_out > 0 {
        reading.warnings.push(format!("{left_out} primitives of points or lines left out"));
    }
    Ok(reading)
}

/// The mesh as it stands in the file, +z up, and how many primitives were left out.
pub(super) fn polygons(source: &Source) -> Result<(Vec<DVec3>, Vec<Polygon>, usize), FormatError> {
    let (gltf, mut blob) = document(source)?;
    let mut reader = Reader {
        source,
        buffers: Vec::new(),
        vertices: Vec::new(),
        polygons: Vec::new(),
        left_out: 0,
        seen: vec![false; gltf.nodes().len()],
    };
    for buffer in gltf.buffers() {
        let bytes = match buffer.source() {
            buffer::Source::Bin => blob.take().unwrap_or_default(),
            buffer::Source::Uri(uri) => reader.fetch(uri)?,
        };
        reader.buffers.push(bytes);
    }
    let upright = DMat4::from_cols(DVec4::X, DVec4::Z, DVec4::NEG_Y, DVec4::W);
    let roots: Vec<Node> = match gltf.default_scene().or_else(|| gltf.scenes().next()) {
        Some(scene) => scene.nodes().collect(),
        None => {
            let children: HashSet<usize> =
                gltf.nodes().flat_map(|n| n.children()).map(|n| n.index()).collect();
            gltf.nodes().filter(|n| !children.contains(&n.index())).collect()
        }
    };
    for node in roots {
        reader.node(&node, upright, 0)?;
    }
    Ok((reader.vertices, reader.polygons, reader.left_out))
}

/// The document and its binary part. What makes `gltf` panic instead of refusing is refused first:
/// a GLB shorter than its header, positions in an accessor that is not there.
fn document(source: &Source) -> Result<(Document, Option<Vec<u8>>), FormatError> {
    /// Bytes of magic, version and length.
    const HEADER: u32 = 12;
    let length = source.bytes.strip_prefix(b"glTF").and_then(|b| b.get(4..8)?.try_into().ok());
    if let Some(length) = length.map(u32::from_le_bytes).filter(|&n| n < HEADER) {
        return Err(source.at_byte(8, format!("a length of at least {HEADER}"), length.to_string()));
    }
    let bad = |error: ::gltf::Error| source.at_byte(0, "a glTF 2.0 file", shown(&error.to_string()));
    let Gltf { document, blob } = Gltf::from_slice_without_validation(source.bytes).map_err(bad)?;
    let root = document.into_json();
    let mut used = root.meshes.iter().flat_map(|m| &m.primitives).flat_map(|p| p.attributes.values());
    if let Some(index) = used.find(|index| index.value() >= root.accessors.len()) {
        let expected = format!("an accessor below {}", root.accessors.len());
        return Err(source.at_byte(0, expected, index.value().to_string()));
    }
    Ok((Document::from_json(root).map_err(bad)?, blob))
}

impl Reader<'_> {
    fn bad(&self, expected: &str, found: impl Into<String>) -> FormatError {
        self.source.at_byte(0, expected, found)
    }

    fn fetch(&self, uri: &str) -> Result<Vec<u8>, FormatError> {
        if let Some(data) = uri.strip_prefix("data:") {
            let (_, data) = data.split_once(";base64,").unwrap_or(("", ""));
            return base64::engine::general_purpose::STANDARD
                .decode(data)
                .map_err(|error| self.bad("a buffer in base64", error.to_string()));
        }
        beside::fetch(self.source, uri)
            .ok_or_else(|| self.bad("a buffer in the file's own folder", shown(uri)))?
    }

    fn node(&mut self, node: &Node, above: DMat4, depth: usize) -> Result<(), FormatError> {
        let again = self.seen.get_mut(node.index()).is_none_or(|seen| std::mem::replace(seen, true));
        if again || depth > DEEPEST {
            let found = if again { "a node twice".into() } else { format!("more than {DEEPEST} levels") };
            return Err(self.bad("a tree of nodes", found));
        }
        let matrix = node.transform().matrix().map(|column| column.map(f64::from));
        let world = above * DMat4::from_cols_array_2d(&matrix);
        for primitive in node.mesh().iter().flat_map(|m| m.primitives()) {
            self.primitive(&primitive, world)?;
        }
        for child in node.children() {
            self.node(&child, world, depth + 1)?;
        }
        Ok(())
    }

    fn primitive(&mut self, primitive: &Primitive, world: DMat4) -> Result<(), FormatError> {
        let corner_sets: fn(usize) -> [usize; 3] = match primitive.mode() {
            Mode::Triangles => |i| [3 * i, 3 * i + 1, 3 * i + 2],
            // winding alternates in a strip; it is made consistent later
            Mode::TriangleStrip => |i| [i, i + 1, i + 2],
            Mode::TriangleFan => |i| [0, i + 1, i + 2],
            _ => {
                self.left_out += 1;
                return Ok(());
            }
        };
        let positions = primitive
            .get(&Semantic::Positions)
            .ok_or_else(|| self.bad("positions in every primitive", "none"))?;
        if (positions.data_type(), positions.dimensions()) != (DataType::F32, Dimensions::Vec3) {
            return Err(self.bad("positions as three f32", format!("{:?}", positions.data_type())));
        }
        let first = self.vertices.len();
        let mut points = Vec::new();
        self.elements(&positions, |bytes| {
            let float = |k: usize| f32::from_le_bytes([0, 1, 2, 3].map(|b| bytes[4 * k + b])) as f64;
            points.push(world.transform_point3(DVec3::new(float(0), float(1), float(2))));
        })?;
        let order: Vec<usize> = match primitive.indices() {
            None => (0..points.len()).collect(),
            Some(indices) => {
                let mut order = Vec::new();
                self.elements(&indices, |bytes| {
                    order.push(bytes.iter().rev().fold(0, |n, &b| n << 8 | b as usize));
                })?;
                order
            }
        };
        if let Some(i) = order.iter().find(|&&i| i >= points.len()) {
            return Err(self.bad(&format!("an index below {}", points.len()), i.to_string()));
        }
        let triangles = match primitive.mode() {
            Mode::Triangles => order.len() / 3,
            _ => order.len().saturating_sub(2),
        };
        if self.polygons.len() + triangles > MOST_POLYGONS || first + points.len() > 3 * MOST_POLYGONS {
            return Err(self.bad(&format!("at most {MOST_POLYGONS} triangles"), "more"));
        }
        let extras = primitive.extras().as_ref().and_then(|e| serde_json::from_str(e.get()).ok());
        let FacetExtras { facet, normal } = extras.unwrap_or_default();
        let name: Arc<str> = facet.into();
        // exact for our own turn of a right angle; a stated normal that does not fit is not used
        let normal = normal.map(|n| world.transform_vector3(DVec3::from_array(n)));
        self.vertices.extend(points);
        for i in 0..triangles {
            let corners = corner_sets(i).map(|k| first + order[k]).to_vec();
            self.polygons.push(Polygon { name: name.clone(), corners, normal });
        }
        Ok(())
    }

    /// Calls `each` with the bytes of every element, all of them known to lie in the buffer.
    fn elements(&self, accessor: &Accessor, mut each: impl FnMut(&[u8])) -> Result<(), FormatError> {
        let Some(view) = accessor.view().filter(|_| accessor.sparse().is_none()) else {
            return Err(self.bad("plain, uncompressed buffers", "a sparse or compressed accessor"));
        };
        let (size, count) = (accessor.size(), accessor.count());
        let stride = view.stride().unwrap_or(size).max(size);
        let buffer = self.buffers.get(view.buffer().index()).map_or(&[][..], |b| b);
        let end = view.offset().checked_add(view.length());
        let bytes =
            end.and_then(|end| buffer.get(view.offset()..end)).and_then(|v| v.get(accessor.offset()..));
        let needed = count.saturating_sub(1).checked_mul(stride).and_then(|n| n.checked_add(size));
        match (bytes, needed) {
            (Some(bytes), Some(needed)) if count == 0 || needed <= bytes.len() => {
                (0..count).for_each(|i| each(&bytes[i * stride..i * stride + size]));
                Ok(())
            }
            _ => {
                Err(self
                    .bad(&format!("a buffer that holds {count} elements"), format!("{} bytes", buffer.len())))
            }
        }
    }
}
