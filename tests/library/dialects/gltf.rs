//! glTF, as text and in chunks.

use super::meshes::{CORNERS, FACES};
use super::{is_octahedron, read, refused, warned};
use base64::Engine;

/// A glTF of an octahedron: with what is added to its root, its node and its primitive.
fn gltf(root: &str, node: &str, primitive: &str) -> String {
    let mut buffer: Vec<u8> = FACES.as_flattened().iter().map(|c| *c as u8).collect();
    buffer.extend(CORNERS.as_flattened().iter().flat_map(|c| (*c as f32).to_le_bytes()));
    buffer.push(0); // not a multiple of three: the text ends in signs
    let data = base64::engine::general_purpose::STANDARD.encode(buffer);
    format!(
        "{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{{\"mesh\":0{node}}}],\
         \"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":1}},\"indices\":0{primitive}}}]}}],\
         \"accessors\":[{{\"bufferView\":0,\"componentType\":5121,\"count\":24,\"type\":\"SCALAR\"}},\
         {{\"bufferView\":1,\"componentType\":5126,\"count\":6,\"type\":\"VEC3\"}}],\
         \"bufferViews\":[{{\"buffer\":0,\"byteLength\":24}},{{\"buffer\":0,\"byteOffset\":24,\"byteLength\":72}}],\
         \"buffers\":[{{\"byteLength\":96,\"uri\":\"data:;base64,{data}\"}}]{root}}}"
    )
}

/// The same as GLB, in chunks of the given kinds.
fn glb(json: &str, chunks: &[(&[u8; 4], &[u8])]) -> Vec<u8> {
    let mut body = Vec::new();
    let json = format!("{json:<width$}", width = json.len().next_multiple_of(4));
    for (kind, content) in [(b"JSON", json.as_bytes())].iter().chain(chunks) {
        body.extend((content.len() as u32).to_le_bytes());
        body.extend(*kind);
        body.extend(*content);
    }
    [&b"glTF"[..], &2u32.to_le_bytes()[..], &(12 + body.len() as u32).to_le_bytes(), &body].concat()
}

#[test]
fn a_gltf_is_read_by_what_a_stone_is_made_of() {
    let plain = gltf("", "", "");
    let required = |names: &str| format!(",\"extensionsRequired\":[{names}]");
    let inverted = ",\"scale\":[1,-1,1],\"rotation\":[0,0.6,0,0.8],\"translation\":[5,6,7]";
    let scenes = ",\"scene\":1,\"scenes\":[{\"nodes\":[]},{\"nodes\":[0]}]";
    let unused = ",\"animations\":[{\"channels\":7}],\"materials\":\"none\",\"images\":[{\"uri\":\"../x\"}],\"skins\":[{}]";
    for (what, bytes) in [
        ("plain", plain.clone().into_bytes()),
        ("a frame that turns it inside out", gltf("", inverted, "").into_bytes()),
        ("a matrix", gltf("", ",\"matrix\":[0,1,0,0, 1,0,0,0, 0,0,1,0, 9,9,9,1]", "").into_bytes()),
        ("several scenes", gltf(scenes, "", "").into_bytes()),
        (
            "looks that are required",
            gltf(&required("\"KHR_materials_ior\",\"KHR_texture_transform\""), "", "").into_bytes(),
        ),
        ("parts of no use, and damaged", gltf(unused, "", ",\"material\":99").into_bytes()),
        (
            "an accessor of no use",
            plain.replace("\"type\":\"VEC3\"}", "\"type\":\"VEC3\"},{\"componentType\":1}").into_bytes(),
        ),
        (
            "a morph target without weight",
            gltf("", ",\"weights\":[0]", ",\"targets\":[{\"POSITION\":1}]").into_bytes(),
        ),
        (
            "a compressed copy",
            gltf("", "", ",\"extensions\":{\"KHR_draco_mesh_compression\":{}}").into_bytes(),
        ),
        ("base64 without its end", plain.replace("==\"", "\"").into_bytes()),
        ("words after the end", (plain.clone() + "\nsaved").into_bytes()),
        ("chunks", glb(&plain, &[])),
        ("a chunk of unknown type", glb(&plain, &[(b"XYZ\0", &[1, 2, 3, 4]), (b"BIN\0", &[])])),
        ("bytes after the last chunk", [glb(&plain, &[]), vec![7; 9]].concat()),
    ] {
        is_octahedron(what, &read(what, "x", &bytes), 4.0 / 3.0);
    }
    warned("scenes", &read("scenes", "x", gltf(scenes, "", "").as_bytes()), "scene 2 of 2 is read");
    for (bytes, said) in [
        (gltf(&required("\"KHR_draco_mesh_compression\""), "", ""), "KHR_draco_mesh_compression"),
        (gltf(&required("\"EXT_meshopt_compression\""), "", ""), "EXT_meshopt_compression"),
        (gltf(&required("\"EXT_mesh_gpu_instancing\""), "", ""), "EXT_mesh_gpu_instancing"),
        (gltf(&required("\"ACME_shape\""), "", ""), "ACME_shape"),
        (gltf("", ",\"extensions\":{\"EXT_mesh_gpu_instancing\":{}}", ""), "EXT_mesh_gpu_instancing"),
        (gltf("", ",\"skin\":0", ""), "a skin"),
        (gltf("", ",\"weights\":[0.5]", ",\"targets\":[{\"POSITION\":1}]"), "a morph target with weight"),
        (
            gltf("", "", ",\"extensions\":{\"KHR_draco_mesh_compression\":{}}")
                .replace("\"bufferView\":1,", ""),
            "KHR_draco_mesh_compression",
        ),
        (plain.replace("\"2.0\"", "\"1.0\""), "version '1.0'"),
        (plain.replace("\"asset\"", "\"other\""), "JSON, not a design or mesh (a glTF has an 'asset')"),
    ] {
        let error = refused("x", bytes.as_bytes());
        assert!(error.contains(said) && error.len() < 200, "{error}");
    }
}

/// glTF has metres; what is wider than half of one is no stone, and its unit unknown.
#[test]
fn a_gltf_is_in_metres() {
    let node = ",\"scale\":[0.002,0.002,0.002]";
    let small = read("4 mm", "x", gltf("", node, "").as_bytes());
    assert_eq!(small.design.unit, cutlab::advanced::design::LengthUnit::Millimetre);
    is_octahedron("4 mm", &small, 4.0 / 3.0 * 8.0);
    let large = read("2 m", "x", gltf("", "", "").as_bytes());
    assert_eq!(large.design.unit, cutlab::advanced::design::LengthUnit::Free);
    warned("2 m", &large, "2.000 m wide, as no stone is");
}
