//! glTF written, binary or text: one node turned upright, one mesh, one primitive a facet.
//!
//! Positions are `f32` in metres, glTF's unit, and shared by all facets. No normals are stored: glTF then
//! asks for flat shading, which is what facets want. The material is a clear or coloured dielectric: index
//! of refraction, full transmission, and a volume without which renderers take it for a thin sheet.

use super::error::FormatError;
use super::mesh_export::MeshExport;
use crate::color::Illuminant;
use crate::materials::Material;
use ::gltf::binary::{Glb, Header};
use ::gltf::json::accessor::{ComponentType, GenericComponentType, Type};
use ::gltf::json::extensions::material as khr;
use ::gltf::json::material::{PbrBaseColorFactor, PbrMetallicRoughness, StrengthFactor};
use ::gltf::json::validation::{Checked, USize64};
use ::gltf::json::{self, Index, Root, buffer, mesh, serialize};
use base64::Engine;
use glam::DVec3;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// The surface as a GLB file.
pub fn write_binary(surface: &MeshExport) -> Result<Vec<u8>, FormatError> {
    let (root, mut bin) = parts(surface)?;
    let fail = |problem: String| failed(surface, problem);
    let mut text = serialize::to_string(&root).map_err(|e| fail(e.to_string()))?.into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    bin.resize(bin.len().next_multiple_of(4), 0);
    let length = u32::try_from(12 + 8 + text.len() + 8 + bin.len()).map_err(|e| fail(e.to_string()))?;
    let header = Header { magic: *b"glTF", version: 2, length };
    Glb { header, json: Cow::Owned(text), bin: Some(Cow::Owned(bin)) }
        .to_vec()
        .map_err(|e| fail(e.to_string()))
}

/// The surface as a glTF file that holds its buffer itself.
pub fn write_text(surface: &MeshExport) -> Result<Vec<u8>, FormatError> {
    let (mut root, bin) = parts(surface)?;
    let data = base64::engine::general_purpose::STANDARD.encode(bin);
    root.buffers[0].uri = Some(format!("data:application/octet-stream;base64,{data}"));
    Ok(serialize::to_string(&root).map_err(|e| failed(surface, e.to_string()))?.into_bytes())
}

fn failed(surface: &MeshExport, problem: String) -> FormatError {
    FormatError::Encode { name: surface.name.clone(), format: "glTF", problem }
}

/// The document and its buffer.
fn parts(surface: &MeshExport) -> Result<(Root, Vec<u8>), FormatError> {
    let metres = surface.unit_mm() / UNIT_MM;
    let metric = |v: &DVec3| (*v * metres).as_vec3().to_array();
    let positions: Vec<[f32; 3]> = surface.vertices.iter().map(metric).collect();
    let mut bin: Vec<u8> = positions.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    let positions_end = bin.len();

    let mut root = Root::default();
    root.asset.generator = Some("cutlab".into());
    let buffer = root.push(json::Buffer {
        byte_length: USize64(0),
        name: None,
        uri: None,
        extensions: None,
        extras: None,
    });
    let position_view = root.push(view(buffer, 0, positions_end, buffer::Target::ArrayBuffer));
    let index_view = root.push(view(buffer, positions_end, 0, buffer::Target::ElementArrayBuffer));
    let mut at = accessor(position_view, 0, positions.len(), ComponentType::F32, Type::Vec3);
    at.min = Some(json::Value::from(extreme(&positions, f32::min).to_vec()));
    at.max = Some(json::Value::from(extreme(&positions, f32::max).to_vec()));
    let position = root.push(at);
    let height =
        surface.vertices.iter().map(|v| v.z).fold((f64::MAX, f64::MIN), |(l, h), z| (l.min(z), h.max(z)));
    root.extensions_used.extend(EXTENSIONS.map(String::from));
    let material = root.push(dielectric(&surface.material, ((height.1 - height.0) * metres) as f32));

    let mut primitives = Vec::with_capacity(surface.facets.len());
    let mut of_facet = vec![Vec::new(); surface.facets.len()];
    surface.triangles.iter().for_each(|(facet, t)| of_facet[*facet].extend(t.map(|c| c as u32)));
    for ((label, normal), corners) in surface.facets.iter().zip(&of_facet) {
        let start = bin.len();
        bin.extend(corners.iter().flat_map(|c| c.to_le_bytes()));
        let offset = start - positions_end;
        let indices =
            root.push(accessor(index_view, offset, corners.len(), ComponentType::U32, Type::Scalar));
        let said = FacetExtras { facet: label.clone(), normal: Some(normal.to_array()) };
        primitives.push(mesh::Primitive {
            attributes: BTreeMap::from([(Checked::Valid(mesh::Semantic::Positions), position)]),
            indices: Some(indices),
            material: Some(material),
            mode: Checked::Valid(mesh::Mode::Triangles),
            targets: None,
            extensions: None,
            extras: Some(serde_json::value::to_raw_value(&said).map_err(|e| failed(surface, e.to_string()))?),
        });
    }
    root.buffers[0].byte_length = USize64(bin.len() as u64);
    root.buffer_views[1].byte_length = USize64((bin.len() - positions_end) as u64);
    let mesh = root.push(json::Mesh {
        name: Some(surface.name.clone()),
        primitives,
        weights: None,
        extensions: None,
        extras: None,
    });
    // our +z becomes glTF's +y
    let upright = [1., 0., 0., 0., 0., 0., -1., 0., 0., 1., 0., 0., 0., 0., 0., 1.];
    let node = root.push(json::Node { mesh: Some(mesh), matrix: Some(upright), ..json::Node::default() });
    root.scene = Some(root_scene(&mut root, node));

    Ok((root, bin))
}

/// The extensions that [`dielectric`] uses. Readers that do not know them show a white stone.
const EXTENSIONS: [&str; 3] = ["KHR_materials_ior", "KHR_materials_transmission", "KHR_materials_volume"];

/// A smooth transparent material.
///
/// - `thickness`: of the stone, in metres, for renderers that do not follow light through it
///
/// Its attenuation is the material's colour by daylight at [`DEPTH_MM`], in linear sRGB.
fn dielectric(material: &Material, thickness: f32) -> json::Material {
    /// Depth at which the colour is given, mm.
    const DEPTH_MM: f64 = 10.0;
    let left = |nm: f32| (-DEPTH_MM * material.absorption_per_mm(f64::from(nm))).exp() as f32;
    let colour = match material.is_clear() {
        true => [1.0; 3],
        false => Illuminant::daylight().linear_srgb(left).to_array().map(|x| x.clamp(0.0, 1.0)),
    };
    let extensions = json::extensions::material::Material {
        ior: Some(khr::Ior { ior: khr::IndexOfRefraction(material.index_d() as f32), extras: None }),
        transmission: Some(khr::Transmission {
            transmission_factor: khr::TransmissionFactor(1.0),
            ..Default::default()
        }),
        volume: Some(khr::Volume {
            thickness_factor: khr::ThicknessFactor(thickness),
            attenuation_distance: khr::AttenuationDistance((DEPTH_MM / UNIT_MM) as f32),
            attenuation_color: khr::AttenuationColor(colour),
            ..Default::default()
        }),
    };
    json::Material {
        name: Some(material.name.to_string()),
        pbr_metallic_roughness: PbrMetallicRoughness {
            base_color_factor: PbrBaseColorFactor([1.0; 4]),
            metallic_factor: StrengthFactor(0.0),
            roughness_factor: StrengthFactor(0.0),
            ..Default::default()
        },
        extensions: Some(extensions),
        ..Default::default()
    }
}

fn root_scene(root: &mut Root, node: Index<json::Node>) -> Index<json::Scene> {
    root.push(json::Scene { nodes: vec![node], name: None, extensions: None, extras: None })
}

fn view(buffer: Index<json::Buffer>, start: usize, length: usize, target: buffer::Target) -> buffer::View {
    buffer::View {
        buffer,
        byte_length: USize64(length as u64),
        byte_offset: Some(USize64(start as u64)),
        byte_stride: None,
        name: None,
        target: Some(Checked::Valid(target)),
        extensions: None,
        extras: None,
    }
}

fn accessor(
    view: Index<buffer::View>,
    offset: usize,
    count: usize,
    component: ComponentType,
    kind: Type,
) -> json::Accessor {
    json::Accessor {
        buffer_view: Some(view),
        byte_offset: Some(USize64(offset as u64)),
        count: USize64(count as u64),
        component_type: Checked::Valid(GenericComponentType(component)),
        type_: Checked::Valid(kind),
        min: None,
        max: None,
        name: None,
        normalized: false,
        sparse: None,
        extensions: None,
        extras: None,
    }
}

fn extreme(positions: &[[f32; 3]], pick: fn(f32, f32) -> f32) -> [f32; 3] {
    let start = positions.first().copied().unwrap_or_default();
    positions.iter().fold(start, |m, p| [0, 1, 2].map(|k| pick(m[k], p[k])))
}

/// Length of glTF's unit, the metre, in millimetres.
pub const UNIT_MM: f64 = 1000.0;

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
