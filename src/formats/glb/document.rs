//! What of a glTF document a stone is made of. All else is passed over unread: no material, animation or
//! accessor that is not needed can refuse a file.

use crate::formats::error::{FormatError, counted, quoted_excerpt};
use crate::formats::input::Input;
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// The document.
#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct GltfDocument {
    asset: Option<Asset>,
    extensions_required: Vec<String>,
    pub scene: Option<usize>,
    pub scenes: Vec<GltfScene>,
    pub nodes: Vec<Node>,
    pub meshes: Vec<GltfMesh>,
    pub accessors: Vec<Accessor>,
    pub buffer_views: Vec<BufferView>,
    pub buffers: Vec<Buffer>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
struct Asset {
    version: String,
    min_version: Option<String>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct GltfScene {
    pub nodes: Vec<usize>,
}

/// A node: a mesh, a frame for others, or both. Anything may be missing.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct Node {
    pub mesh: Option<usize>,
    pub children: Vec<usize>,
    pub matrix: Option<[f64; 16]>,
    pub translation: Option<[f64; 3]>,
    pub rotation: Option<[f64; 4]>,
    pub scale: Option<[f64; 3]>,
    pub skin: Option<usize>,
    pub weights: Option<Vec<f64>>,
    pub extensions: BTreeMap<String, IgnoredAny>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct GltfMesh {
    pub primitives: Vec<Primitive>,
    pub weights: Vec<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct Primitive {
    pub attributes: BTreeMap<String, usize>,
    pub indices: Option<usize>,
    pub mode: Option<u64>,
    pub targets: Vec<IgnoredAny>,
    pub extensions: BTreeMap<String, IgnoredAny>,
    pub extras: serde_json::Value,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct Accessor {
    pub buffer_view: Option<usize>,
    pub byte_offset: usize,
    pub component_type: u64,
    pub normalized: bool,
    pub count: usize,
    #[serde(rename = "type")]
    pub shape: String,
    pub sparse: Option<Sparse>,
}

#[derive(Debug, Deserialize)]
pub struct Sparse {
    pub count: usize,
    pub indices: SparsePart,
    pub values: SparsePart,
}

/// Where a sparse accessor's indices or values are.
#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct SparsePart {
    pub buffer_view: usize,
    pub byte_offset: usize,
    pub component_type: u64,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct BufferView {
    pub buffer: usize,
    pub byte_offset: usize,
    pub byte_length: usize,
    pub byte_stride: Option<usize>,
    pub extensions: BTreeMap<String, IgnoredAny>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct Buffer {
    pub uri: Option<String>,
}

/// Required extensions without which the shape is the same: looks, lights, words. Of their kind are all whose
/// names begin so.
const OF_NO_SHAPE: [&str; 8] = [
    "KHR_materials_",
    "EXT_materials_",
    "KHR_texture_",
    "EXT_texture_",
    "KHR_lights_",
    "EXT_lights_",
    "KHR_xmp",
    "KHR_mesh_quantization",
];

/// A document, the buffer inside its file, if there is one, and remarks.
pub type Opened<'s> = (GltfDocument, Option<&'s [u8]>, Vec<String>);

/// Reads the document of a glTF or GLB file.
pub fn document<'s>(source: &Input<'s>) -> Result<Opened<'s>, FormatError> {
    let mut remarks = Vec::new();
    let (json, inside): (Cow<str>, _) = if source.bytes.starts_with(b"glTF") {
        let (json, inside) = chunks(source, &mut remarks)?;
        (String::from_utf8_lossy(json), inside)
    } else {
        (source.text(), None)
    };
    let mut values = serde_json::Deserializer::from_str(&json).into_iter::<GltfDocument>();
    let broken = |said: String| source.at_byte(0, "a glTF 2.0 file", said);
    let document = match values.next() {
        Some(Ok(document)) => document,
        Some(Err(error)) => return Err(broken(error.to_string())),
        None => return Err(broken("nothing".into())),
    };
    let after =
        json.get(values.byte_offset()..).unwrap_or_default().trim_matches([' ', '\t', '\r', '\n', '\0']);
    if !after.is_empty() {
        remarks.push(format!("{} after the document passed over", counted(after.len(), "byte")));
    }
    let Some(asset) = &document.asset else { return Err(broken("no asset with a version".into())) };
    let needed = asset.min_version.as_ref().unwrap_or(&asset.version);
    if !needed.starts_with("2.") {
        return Err(broken(format!("version {}", quoted_excerpt(needed))));
    }
    let is_read = |name: &String| OF_NO_SHAPE.iter().any(|known| name.starts_with(known));
    if let Some(name) = document.extensions_required.iter().find(|name| !is_read(name)) {
        let found = format!("the required extension {}, which is not read", quoted_excerpt(name));
        return Err(source.at_byte(0, "a glTF 2.0 file without it", found));
    }
    Ok((document, inside, remarks))
}

/// The JSON chunk and the binary one. Chunks of unknown type are passed over, and so is what follows the last.
fn chunks<'s>(
    source: &Input<'s>,
    remarks: &mut Vec<String>,
) -> Result<(&'s [u8], Option<&'s [u8]>), FormatError> {
    const HEADER: usize = 12;
    let word = |at: usize| {
        let bytes = source.bytes.get(at..).and_then(|rest| rest.first_chunk::<4>());
        bytes.map(|b| u32::from_le_bytes(*b)).ok_or_else(|| source.at_byte(at, "four bytes", "the end"))
    };
    let (version, length) = (word(4)?, word(8)? as usize);
    if version != 2 {
        return Err(source.at_byte(4, "version 2 of glTF", version.to_string()));
    }
    if length < HEADER {
        return Err(source.at_byte(8, format!("a length of at least {HEADER}"), length.to_string()));
    }
    if source.bytes.len() > length {
        let extra = counted(source.bytes.len() - length, "byte");
        remarks.push(format!("{extra} after the last chunk passed over"));
    }
    let end = length.min(source.bytes.len());
    let (mut json, mut inside, mut at) = (None, None, HEADER);
    while at < end && (json.is_none() || inside.is_none()) {
        let (size, kind) = (word(at)? as usize, word(at + 4)?.to_le_bytes());
        let content = at + 8..at.saturating_add(8).saturating_add(size);
        let Some(chunk) = source.bytes.get(content.clone()) else {
            let found = format!("{} bytes", source.bytes.len() - content.start);
            return Err(source.at_byte(at, format!("a chunk of {size} bytes"), found));
        };
        match &kind {
            b"JSON" if json.is_none() => json = Some(chunk),
            b"BIN\0" if inside.is_none() => inside = Some(chunk),
            _ => {}
        }
        at = content.end;
    }
    Ok((json.ok_or_else(|| source.at_byte(HEADER, "a chunk of JSON", "none"))?, inside))
}

/// Whether JSON text is a glTF document: it has an asset. Of text that is broken, whether it seems to be one.
pub fn is_one(json: &str) -> bool {
    #[derive(Deserialize)]
    struct Top {
        asset: Option<IgnoredAny>,
    }
    match serde_json::Deserializer::from_str(json).into_iter::<Top>().next() {
        Some(Ok(top)) => top.asset.is_some(),
        Some(Err(_)) => {
            ["\"asset\"", "\"accessors\"", "\"bufferViews\""].iter().any(|key| json.contains(key))
        }
        None => false,
    }
}
