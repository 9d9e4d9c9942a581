//! What each format's own specification, or its author's reader, allows beyond what most files hold: every such
//! file reads as the plain one. What is not used refuses no file; what is required and not read refuses it by
//! name.

mod designs;
mod gltf;
mod meshes;
mod strangers;

use cutlab::advanced::formats::{self, Loaded};
use cutlab::advanced::stone::Stone;

fn read(what: &str, name: &str, bytes: &[u8]) -> Loaded {
    formats::read_bytes(name, bytes, None).unwrap_or_else(|e| panic!("{what}: {e}"))
}

fn refused(name: &str, bytes: &[u8]) -> String {
    formats::read_bytes(name, bytes, None).map(|i| i.format).expect_err("is refused").to_string()
}

fn encoded(spec: &str, format: &str) -> Vec<u8> {
    formats::encode(&Stone::parse(spec).and_then(Stone::into_design).expect("a library cut"), format)
        .expect("is written")
}

fn is_octahedron(what: &str, stone: &Loaded, volume: f64) {
    assert_eq!(stone.design.facets().count(), 8, "{what}");
    let found = stone.design.solid().expect("closed").volume();
    assert!((found / volume - 1.0).abs() < 1e-6, "{what}: {found}");
}

fn warned(what: &str, stone: &Loaded, said: &str) {
    assert!(stone.warnings.iter().any(|w| w.contains(said)), "{what}: {:?}", stone.warnings);
}
