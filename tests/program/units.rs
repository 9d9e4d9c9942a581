//! Units of files: what is read in one is shown in the same, and written in the other's, for stones and for
//! meshes that are none.

use crate::bench::Bench;
use serde_json::Value;

fn shown(bench: &Bench, file: &str) -> Value {
    let (said, _) = bench.ends(0, &["show", "--json", file]);
    let sheets: Value = serde_json::from_str(&said).expect("JSON");
    sheets[0].clone()
}

fn near(found: &Value, wanted: f64, what: &str) {
    let found = found.as_f64().unwrap_or_else(|| panic!("{what}: {found}"));
    assert!((found / wanted - 1.0).abs() < 1e-6, "{what}: {found}, not {wanted}");
}

/// A prism of 6 × 6 × 4 with a pit in its top: 120 in its own unit cubed.
const DENTED: &str = "v -3 -3 -2\nv 3 -3 -2\nv 3 3 -2\nv -3 3 -2\nv -3 -3 2\nv 3 -3 2\nv 3 3 2\nv -3 3 2\nv 0 0 0\n\
    f 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 9\nf 6 7 9\nf 7 8 9\nf 8 5 9\n";

/// An octahedron of corners at 1, whose numbers are no metres: no stone is 2 m wide.
#[test]
fn a_gltf_too_wide_for_metres_is_shown_in_its_own_numbers() {
    let bench = Bench::new();
    let corners: [[f32; 3]; 6] =
        [[1., 0., 0.], [-1., 0., 0.], [0., 1., 0.], [0., -1., 0.], [0., 0., 1.], [0., 0., -1.]];
    let faces: [u8; 24] = [0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5];
    let mut buffer = faces.to_vec();
    buffer.extend(corners.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
    std::fs::write(bench.path("b.bin"), buffer).expect("writes");
    let json = r#"{"asset":{"version":"2.0"},"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":1},"indices":0}]}],
        "accessors":[{"bufferView":0,"componentType":5121,"count":24,"type":"SCALAR"},
            {"bufferView":1,"componentType":5126,"count":6,"type":"VEC3"}],
        "bufferViews":[{"buffer":0,"byteLength":24},{"buffer":0,"byteOffset":24,"byteLength":72}],
        "buffers":[{"byteLength":96,"uri":"b.bin"}]}"#;
    std::fs::write(bench.path("wide.gltf"), json).expect("writes");
    let sheet = shown(&bench, "wide.gltf");
    assert_eq!(sheet["unit"], "file");
    near(&sheet["volume"], 4.0 / 3.0, "volume");
    near(&sheet["width"], 2f64.sqrt(), "width");
    bench.good(&["import", "-q", "wide.gltf", "-o", "wide.obj"]);
    near(&shown(&bench, "wide.obj")["volume"], 4.0 / 3.0, "volume as OBJ");
}

#[test]
fn a_mesh_with_a_dent_keeps_its_size_through_gltf() {
    let bench = Bench::new();
    std::fs::write(bench.path("dented.obj"), DENTED).expect("writes");
    bench.good(&["import", "-q", "dented.obj", "--size", "6", "-o", "dented.glb"]);
    let sheet = shown(&bench, "dented.glb");
    assert_eq!(sheet["unit"], "mm");
    near(&sheet["volume"], 120.0, "cubic millimetres");
    near(&sheet["box"][1][0], 3.0, "millimetres");
    let (said, _) = bench.ends(0, &["show", "dented.glb"]);
    assert!(said.contains("6.000000 × 6.000000 × 4.000000 mm") && said.contains("120.000"), "{said}");
    for file in ["again.glb", "again.obj"] {
        bench.good(&["import", "-q", "dented.glb", "-o", file]);
        near(&shown(&bench, file)["volume"], 120.0, file);
    }
    // the colour depends on the size that the file states
    let absorbed = |stone: &str, more: &[&str]| {
        let words = ["score", "-q", stone, "--material", "ruby", "--metrics", "absorbed", "--error", "0.01"];
        let (table, _) = bench.ends(0, &[&words, more].concat());
        table
            .lines()
            .nth(1)
            .and_then(|row| row.split(',').nth(3))
            .expect("a score")
            .parse::<f64>()
            .expect("a number")
    };
    // GLB holds corners in f32
    let [stated, asked] = [absorbed("dented.glb", &[]), absorbed("dented.obj", &["--size", "6"])];
    assert!((stated - asked).abs() < 1e-6, "{stated} {asked}");
    let usual = absorbed("dented.obj", &[]);
    assert!((stated - usual).abs() > 1e-3, "6.5 mm where no size is known: {stated} {usual}");
}
