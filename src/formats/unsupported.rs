//! Unsupported formats, known and not read: formats by name, files of other kinds by how they begin; and what to
//! do instead.

use super::error::FormatError;
use super::input::Input;

struct UnsupportedFormat {
    extension: &'static str,
    /// What such a file begins with, if that tells it.
    magic: &'static str,
    format: &'static str,
    instead: &'static str,
}

const SECRET: &str = "the format is not public; export the stone as STL or OBJ, or the design as GemCad .asc";
const SCAN: &str = "a later version will; export the scan as STL or OBJ";

static UNSUPPORTED: &[UnsupportedFormat] = &[
    UnsupportedFormat { extension: "dmc", magic: "", format: ".dmc", instead: SECRET },
    UnsupportedFormat { extension: "mmd", magic: "", format: ".mmd", instead: SECRET },
    UnsupportedFormat { extension: "oxgz", magic: "", format: ".oxgz", instead: SECRET },
    UnsupportedFormat { extension: "cap", magic: "", format: ".cap", instead: SECRET },
    UnsupportedFormat { extension: "ssp", magic: "", format: ".ssp", instead: SECRET },
    UnsupportedFormat { extension: "srn", magic: "SPF ", format: "Sarine .srn", instead: SCAN },
];

/// A kind of file that holds no stone that is read.
struct FileSignature {
    /// What such a file begins with, after white space where it is text.
    magic: &'static [u8],
    /// What it is called.
    found: &'static str,
    hint: &'static str,
}

const MESH: &str = "; export the mesh as STL, OBJ or GLB";
const UNPACK: &str = "; unpack it first";
const NONE: &str = "";

static SIGNATURES: &[FileSignature] = &[
    FileSignature { magic: b"\x89PNG", found: "a picture (PNG)", hint: NONE },
    FileSignature { magic: b"\xFF\xD8\xFF", found: "a picture (JPEG)", hint: NONE },
    FileSignature { magic: b"GIF8", found: "a picture (GIF)", hint: NONE },
    FileSignature { magic: b"RIFF", found: "a picture or a film (RIFF)", hint: NONE },
    FileSignature { magic: b"v/1\x01", found: "a picture (EXR)", hint: NONE },
    FileSignature { magic: b"#?RADIANCE", found: "a picture (HDR)", hint: NONE },
    FileSignature { magic: b"%PDF", found: "a PDF document", hint: NONE },
    FileSignature { magic: b"PK\x03\x04", found: "a ZIP archive", hint: UNPACK },
    FileSignature { magic: b"\x1F\x8B", found: "a gzip archive", hint: UNPACK },
    FileSignature { magic: b"Rar!", found: "a RAR archive", hint: UNPACK },
    FileSignature { magic: b"7z\xBC\xAF", found: "a 7z archive", hint: UNPACK },
    FileSignature { magic: b"ISO-10303-21", found: "a STEP file", hint: MESH },
    FileSignature { magic: b"Kaydara FBX", found: "an FBX file", hint: MESH },
    FileSignature { magic: b"BLENDER", found: "a Blender file", hint: MESH },
    FileSignature { magic: b"3D Geometry File", found: "a Rhino file", hint: MESH },
    FileSignature { magic: b"#VRML", found: "a VRML file", hint: MESH },
    FileSignature { magic: b"OFF\n", found: "an OFF mesh", hint: MESH },
    FileSignature { magic: b"OFF\r", found: "an OFF mesh", hint: MESH },
];

/// Whether the file is a page of the web: what a site sends in place of a file that is gone.
pub fn is_web_page(source: &Input) -> bool {
    let start = source.beginning().to_ascii_lowercase();
    start.trim_start().starts_with('<')
        && ["<html", "<!doctype html", "<head", "<body"].iter().any(|t| start.contains(t))
}

/// Whether the file's extension or its beginning is one that is known and refused.
pub fn is_known(source: &Input) -> bool {
    let is_markup = source.beginning().trim_start().starts_with(['{', '<']);
    is_markup || by_extension(source).is_some() || kind(source).is_some()
}

fn kind(source: &Input) -> Option<&'static FileSignature> {
    let start = source.bytes.trim_ascii_start();
    SIGNATURES.iter().find(|k| source.bytes.starts_with(k.magic) || start.starts_with(k.magic))
}

/// What a file is called that no reader claims, and what to do instead.
fn description(source: &Input) -> (&'static str, &'static str) {
    let start = source.beginning();
    let start = start.trim_start();
    match kind(source) {
        _ if is_web_page(source) => ("a web page (HTML)", "; save the file itself, not the page about it"),
        Some(kind) => (kind.found, kind.hint),
        None if source.is_binary() => ("binary data", NONE),
        None if start.starts_with(['{', '[']) => ("JSON", " (a glTF has an 'asset')"),
        None if start.starts_with("<svg") || start.contains("<svg ") => ("a drawing (SVG)", NONE),
        None if start.starts_with('<') => ("XML", " (Gem Cut Studio's has an element 'GemCutStudio')"),
        None => ("text", " (all formats: cutlab list formats)"),
    }
}

fn by_extension(source: &Input) -> Option<&'static str> {
    let extension = source.extension();
    UNSUPPORTED.iter().find(|r| r.extension == extension).map(|r| r.format)
}

/// Whether a refused format has this extension.
pub fn has_extension(extension: &str) -> bool {
    UNSUPPORTED.iter().any(|r| r.extension == extension)
}

/// Why a file that no reader claims is not read.
pub fn error(source: &Input) -> FormatError {
    if source.bytes.iter().all(|b| *b == 0) {
        return FormatError::Empty { file: source.name.into() };
    }
    let (extension, start) = (source.extension(), source.beginning());
    let known = |r: &&UnsupportedFormat| {
        r.extension == extension || (!r.magic.is_empty() && start.trim_start().starts_with(r.magic))
    };
    match UNSUPPORTED.iter().find(known) {
        Some(r) => {
            FormatError::Unsupported { file: source.name.into(), format: r.format, instead: r.instead }
        }
        None => {
            let (found, hint) = description(source);
            FormatError::Unrecognised { file: source.name.into(), found, hint }
        }
    }
}
