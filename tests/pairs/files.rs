//! Whether a file is whole, by what it is.

use crate::bench::{Bench, Inputs};
use exr::prelude::{ReadChannels, ReadLayers};
use std::io::Cursor;
use std::path::Path;

/// What is wrong with the bytes of a file of that name; nothing if it is whole.
///
/// - `inputs`: in a folder of which designs and meshes are shown
pub fn fault(name: &Path, bytes: &[u8], inputs: &Inputs) -> Option<String> {
    // a file without extension is what it begins as
    let extension =
        name.extension().map_or_else(|| sniffed(bytes, "").into(), |e| e.to_string_lossy().to_lowercase());
    let said = |e: &dyn std::fmt::Display| Some(format!("{extension}: {e}"));
    if bytes.is_empty() {
        return Some(format!("{extension}: empty"));
    }
    match extension.as_str() {
        "png" | "apng" => png(bytes).and_then(|e| said(&e)),
        "gif" | "jpg" | "webp" => image::load_from_memory(bytes).err().and_then(|e| said(&e)),
        "exr" => exr::prelude::read()
            .no_deep_data()
            .all_resolution_levels()
            .all_channels()
            .all_layers()
            .all_attributes()
            .from_buffered(Cursor::new(bytes))
            .err()
            .and_then(|e| said(&e)),
        "json" => serde_json::from_slice::<serde_json::Value>(bytes).err().and_then(|e| said(&e)),
        "jsonl" | "ndjson" => serde_json::Deserializer::from_slice(bytes)
            .into_iter::<serde_json::Value>()
            .find_map(Result::err)
            .and_then(|e| said(&e)),
        "csv" => csv::Reader::from_reader(bytes).records().find_map(Result::err).and_then(|e| said(&e)),
        "svg" => {
            let text = String::from_utf8_lossy(bytes);
            roxmltree::Document::parse(&text).err().and_then(|e| said(&e))
        }
        "html" => {
            // behind the end the page records the command that made it
            let text = text(bytes);
            let (page, record) = text.rsplit_once("</html>").unwrap_or_default();
            let ends = record.trim().is_empty() || record.trim().starts_with("<?cutlab-record ");
            (page.is_empty() || !ends).then(|| "html: no end".into())
        }
        "pdf" => {
            let whole = bytes.starts_with(b"%PDF") && text(bytes).trim_end().ends_with("%%EOF");
            (!whole).then(|| "pdf: no begin or no end".into())
        }
        "mp4" => (bytes.get(4..8) != Some(b"ftyp")).then(|| "mp4: no ftyp".into()),
        "1" => (!text(bytes).contains(".TH cutlab")).then(|| "man page: no title".into()),
        "md" | "map" => None,
        _ => shown(name, bytes, inputs),
    }
}

/// What standard output holds, by its first bytes, as an extension.
///
/// - `otherwise`: if it is none of the kinds that can be told so
pub fn sniffed<'a>(bytes: &[u8], otherwise: &'a str) -> &'a str {
    match bytes {
        [0x89, b'P', b'N', b'G', ..] => "png",
        [0x76, 0x2f, 0x31, 0x01, ..] => "exr",
        [b'<', b's', b'v', b'g', ..] => "svg",
        _ => otherwise,
    }
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn png(bytes: &[u8]) -> Option<String> {
    if let Err(error) = image::load_from_memory_with_format(bytes, image::ImageFormat::Png) {
        return Some(error.to_string());
    }
    let end = b"IEND\xaeB`\x82";
    (!bytes.ends_with(end)).then(|| "something follows the end".into())
}

/// What `show` says against a design or a mesh.
fn shown(name: &Path, bytes: &[u8], inputs: &Inputs) -> Option<String> {
    let bench = Bench::new(inputs, &[]);
    let file = Path::new("written").with_extension(name.extension().unwrap_or_default());
    std::fs::write(bench.path().join(&file), bytes).expect("writes");
    // a glTF has its numbers in itself or beside it, and is read alike
    let words = ["show", "--json", &file.display().to_string()].map(String::from);
    let ran = bench.run(&words, 1);
    (ran.code != Some(0)).then(|| format!("not read again: {}", ran.stderr.trim()))
}

/// The width and height of a picture.
pub fn size(bytes: &[u8]) -> Option<(u32, u32)> {
    image::ImageReader::new(Cursor::new(bytes)).with_guessed_format().ok()?.into_dimensions().ok()
}
