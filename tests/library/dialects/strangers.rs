//! Files that are no stones.

use super::refused;

/// Files of other kinds under every extension: one line that says what they are, and shows nothing of them.
#[test]
fn strangers_files_are_named_and_not_shown() {
    let secret = "root:x:0:0:root";
    let passwd = format!("{secret}:/root:/bin/bash\ndaemon:x:1:1:daemon:/usr/sbin:/usr/sbin/nologin\n");
    let page = format!(
        "\n<!DOCTYPE html>\n<html><head><title>{secret}</title></head><body><pre>\na -42 0.5 96 24\nv 1 0 0\n</pre></body></html>"
    );
    let junk: Vec<u8> = (0..5000u32).map(|i| (i.wrapping_mul(2654435761) >> 13) as u8).collect();
    for (what, bytes, said) in [
        ("passwd", passwd.into_bytes(), "text, not a design or mesh"),
        ("page", page.into_bytes(), "a web page (HTML)"),
        ("table", format!("{{\"stone\":\"{secret}\"}}").into_bytes(), "JSON, not a design or mesh"),
        ("picture", [b"\x89PNG\r\n\x1a\n", &junk[..]].concat(), "a picture (PNG)"),
        ("archive", [b"PK\x03\x04", &junk[..]].concat(), "a ZIP archive"),
        ("drawing", format!("<svg xmlns=\"s\"><text>{secret}</text></svg>").into_bytes(), "a drawing (SVG)"),
        ("XML", format!("<?xml version=\"1.0\"?><a>{secret}</a>").into_bytes(), "XML, not a design or mesh"),
        ("junk", junk, ""),
    ] {
        for extension in
            ["asc", "gem", "gcs", "obj", "stl", "ply", "glb", "gltf", "toml", "txt", "pbrt", "xyz"]
        {
            let error = refused(&format!("stone.{extension}"), &bytes);
            assert!(error.len() < 200 && !error.contains('\n'), "{what}.{extension}: {error}");
            assert!(!error.contains(secret), "{what}.{extension}: {error}");
            assert!(
                error.contains(said) || ["obj", "toml"].contains(&extension),
                "{what}.{extension}: {error}"
            );
        }
    }
}
