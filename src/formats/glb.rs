//! glTF and GLB meshes. Buffers are read from the file itself or its folder, never from elsewhere.
//!
//! glTF's +y is up and cutlab's is +z, so the stone is turned. Facet names and normals travel in
//! each primitive's `extras`: `{"facet": "main 1", "normal": [x, y, z]}`.

use super::error::{FormatError, shown};
use super::shell::{STATED_IN_F32, design_of_mesh};
use super::source::Source;
use super::{Format, Reading, Writer, beside, glb_write};
use crate::solid::recover::Polygon;
use crate::store::limits;
use ::gltf::accessor::sparse::IndexType;
use ::gltf::accessor::{DataType, Dimensions};
use ::gltf::buffer::View;
use ::gltf::json::Value;
use ::gltf::json::validation::Checked;
use ::gltf::mesh::Mode;
use ::gltf::{Accessor, Document, Gltf, Node, Primitive, Semantic, buffer};
use base64::Engine;
use glam::{DMat4, DVec3, DVec4};
use std::collections::HashSet;
use std::sync::Arc;

/// Binary glTF 2.0.
pub static GLB: Format = Format {
    name: "glb",
    extensions: &["glb"],
    about: "glTF 2.0 mesh in binary, one primitive a facet",
    sniff: |source| if source.bytes.starts_with(b"glTF") { 100 } else { 0 },
    read,
    write: Some(Writer::Mesh(glb_write::write_binary)),
};

/// glTF 2.0 as text.
pub static GLTF: Format = Format {
    name: "gltf",
    extensions: &["gltf"],
    about: "glTF 2.0 mesh as text, one primitive a facet; written with its buffer inside",
    sniff,
    read,
    write: Some(Writer::Mesh(glb_write::write_text)),
};

/// Length of glTF's unit, the metre, in millimetres.
pub const UNIT_MM: f64 = 1000.0;

/// A stone wider than this (mm) was hardly modelled in metres.
const WIDEST_MM: f64 = 300.0;

fn sniff(source: &Source) -> u8 {
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
    /// Primitives that were met: many nodes may show one mesh.
    met: usize,
    /// Nodes that were visited: in a tree none is twice.
    seen: Vec<bool>,
}

fn read(source: &Source) -> Result<Reading, FormatError> {
    let (vertices, polygons, left_out) = polygons(source)?;
    let mut reading = design_of_mesh(source, &vertices, &polygons, STATED_IN_F32)?;
    reading.design = reading.design.scaled_to_mm(UNIT_MM);
    if left_out > 0 {
        reading.warnings.push(format!("{left_out} primitives of points or lines left out"));
    }
    let width = reading.design.solid().map_or(0.0, |solid| solid.width());
    if width > WIDEST_MM {
        reading
            .warnings
            .push(format!("the stone is {width:.0} mm wide if the file is in metres, glTF's unit"));
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
        met: 0,
        seen: vec![false; gltf.nodes().len()],
    };
    let mut read = 0;
    for buffer in gltf.buffers() {
        let bytes = match buffer.source() {
            buffer::Source::Bin => blob.take().unwrap_or_default(),
            buffer::Source::Uri(uri) => reader.fetch(uri)?,
        };
        read += bytes.len();
        source.within(&limits::FILE, read)?;
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
    // in the file's order; a stack of our own, so that no nesting is too deep
    let mut next: Vec<(Node, DMat4)> = roots.into_iter().rev().map(|node| (node, upright)).collect();
    while let Some((node, above)) = next.pop() {
        let world = reader.node(&node, above)?;
        let first = next.len();
        next.extend(node.children().map(|child| (child, world)));
        next[first..].reverse();
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
    let mut root = document.into_json();
    let mut used = root.meshes.iter().flat_map(|m| &m.primitives).flat_map(|p| p.attributes.values());
    if let Some(index) = used.find(|index| index.value() >= root.accessors.len()) {
        let expected = format!("an accessor below {}", root.accessors.len());
        return Err(source.at_byte(0, expected, index.value().to_string()));
    }
    // what is asked of a strict file and of no use here: bounds of the places, and extensions other
    // than those that leave the buffers unreadable
    root.extensions_required.retain(|name| name.ends_with("_compression"));
    let places = root.meshes.iter().flat_map(|m| &m.primitives).flat_map(|p| &p.attributes);
    let places = places.filter(|(key, _)| **key == Checked::Valid(Semantic::Positions));
    for place in places.map(|(_, index)| index.value()).collect::<Vec<_>>() {
        let accessor = &mut root.accessors[place];
        for bound in [&mut accessor.min, &mut accessor.max] {
            bound.get_or_insert_with(|| Value::from(vec![0.0; 3]));
        }
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
        beside::fetch(self.source, &unescaped(uri))
            .ok_or_else(|| self.bad("a buffer in the file's own folder", shown(uri)))?
    }

    /// The meshes of one node, and the frame of its children.
    fn node(&mut self, node: &Node, above: DMat4) -> Result<DMat4, FormatError> {
        if self.seen.get_mut(node.index()).is_none_or(|seen| std::mem::replace(seen, true)) {
            return Err(self.bad("a tree of nodes", "a node twice"));
        }
        let matrix = node.transform().matrix().map(|column| column.map(f64::from));
        let world = above * DMat4::from_cols_array_2d(&matrix);
        for primitive in node.mesh().iter().flat_map(|m| m.primitives()) {
            self.primitive(&primitive, world)?;
        }
        Ok(world)
    }

    fn primitive(&mut self, primitive: &Primitive, world: DMat4) -> Result<(), FormatError> {
        self.met += 1;
        self.source.within(&limits::POLYGONS, self.met)?;
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
        if positions.dimensions() != Dimensions::Vec3 {
            return Err(self.bad("positions of three numbers", format!("{:?}", positions.dimensions())));
        }
        let first = self.vertices.len();
        let (kind, normalised) = (positions.data_type(), positions.normalized());
        let bytes = self.elements(&positions)?;
        let point = |bytes: &[u8]| {
            let mut numbers = bytes.chunks_exact(kind.size()).map(|b| float(kind, normalised, b));
            world.transform_point3(DVec3::from_array([0; 3].map(|_| numbers.next().unwrap_or_default())))
        };
        let points: Vec<DVec3> = bytes.chunks_exact(positions.size()).map(point).collect();
        let order: Vec<usize> = match primitive.indices() {
            None => (0..points.len()).collect(),
            Some(indices) => self.elements(&indices)?.chunks_exact(indices.size()).map(unsigned).collect(),
        };
        if let Some(i) = order.iter().find(|&&i| i >= points.len()) {
            return Err(self.bad(&format!("an index below {}", points.len()), i.to_string()));
        }
        let triangles = match primitive.mode() {
            Mode::Triangles => order.len() / 3,
            _ => order.len().saturating_sub(2),
        };
        self.source.within(&limits::POLYGONS, self.polygons.len() + triangles)?;
        self.source.within(&limits::CORNERS, first + points.len())?;
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

    /// The bytes of every element, one after the other, with what a sparse accessor replaces.
    fn elements(&self, accessor: &Accessor) -> Result<Vec<u8>, FormatError> {
        let (size, count) = (accessor.size(), accessor.count());
        self.source.within(&limits::CORNERS, count)?;
        let sparse = accessor.sparse();
        let mut all = match (accessor.view(), &sparse) {
            (Some(view), _) => self.packed(&view, accessor.offset(), size, count)?,
            (None, Some(_)) => vec![0; size * count],
            (None, None) => return Err(self.bad("uncompressed buffers", "an accessor without one")),
        };
        if let Some(sparse) = sparse {
            let (indices, values) = (sparse.indices(), sparse.values());
            let wide = match indices.index_type() {
                IndexType::U8 => 1,
                IndexType::U16 => 2,
                IndexType::U32 => 4,
            };
            let replaced = sparse.count().min(count);
            let places = self.packed(&indices.view(), indices.offset(), wide, replaced)?;
            let values = self.packed(&values.view(), values.offset(), size, replaced)?;
            for (place, value) in places.chunks_exact(wide).map(unsigned).zip(values.chunks_exact(size)) {
                let Some(element) = all.get_mut(place.saturating_mul(size)..).and_then(|e| e.get_mut(..size))
                else {
                    return Err(self.bad(&format!("a sparse index below {count}"), place.to_string()));
                };
                element.copy_from_slice(value);
            }
        }
        Ok(all)
    }

    /// The bytes of `count` elements of a view, all of them known to lie in the buffer.
    fn packed(&self, view: &View, offset: usize, size: usize, count: usize) -> Result<Vec<u8>, FormatError> {
        let stride = view.stride().unwrap_or(size).max(size);
        let buffer = self.buffers.get(view.buffer().index()).map_or(&[][..], |b| b);
        let end = view.offset().checked_add(view.length());
        let bytes = end.and_then(|end| buffer.get(view.offset()..end)).and_then(|v| v.get(offset..));
        let needed = count.saturating_sub(1).checked_mul(stride).and_then(|n| n.checked_add(size));
        match (bytes, needed) {
            _ if count == 0 => Ok(Vec::new()),
            (Some(bytes), Some(needed)) if needed <= bytes.len() => {
                Ok((0..count).flat_map(|i| &bytes[i * stride..i * stride + size]).copied().collect())
            }
            _ => {
                Err(self
                    .bad(&format!("a buffer that holds {count} elements"), format!("{} bytes", buffer.len())))
            }
        }
    }
}

/// An unsigned number of any length, least byte first.
fn unsigned(bytes: &[u8]) -> usize {
    bytes.iter().rev().fold(0, |n, &b| n << 8 | b as usize)
}

/// A coordinate; quantised ones (KHR_mesh_quantization) are whole numbers, or, normalised, parts of
/// the largest.
fn float(kind: DataType, normalised: bool, bytes: &[u8]) -> f64 {
    let at = |i: usize| bytes.get(i).copied().unwrap_or_default();
    let (value, most) = match kind {
        DataType::F32 => return f32::from_le_bytes([0, 1, 2, 3].map(at)).into(),
        DataType::I8 => (i8::from_le_bytes([at(0)]).into(), f64::from(i8::MAX)),
        DataType::U8 => (at(0).into(), f64::from(u8::MAX)),
        DataType::I16 => (i16::from_le_bytes([0, 1].map(at)).into(), f64::from(i16::MAX)),
        DataType::U16 => (u16::from_le_bytes([0, 1].map(at)).into(), f64::from(u16::MAX)),
        DataType::U32 => (u32::from_le_bytes([0, 1, 2, 3].map(at)).into(), f64::from(u32::MAX)),
    };
    if normalised { f64::max(value / most, -1.0) } else { value }
}

/// The URI with `%20` and its like as the bytes they stand for.
fn unescaped(uri: &str) -> String {
    let mut parts = uri.split('%');
    let mut bytes = parts.next().unwrap_or_default().as_bytes().to_vec();
    for part in parts {
        match part.get(..2).and_then(|hex| u8::from_str_radix(hex, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                bytes.extend(&part.as_bytes()[2..]);
            }
            None => {
                bytes.push(b'%');
                bytes.extend(part.as_bytes());
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}
