//! What cutlab knows and does not read: formats by name, files of other kinds by how they begin; and what to
//! do instead.

use super::error::FormatError;
use super::source::Source;

struct Refused {
    extension: &'static str,
    /// What such a file begins with, if that tells it.
    magic: &'static str,
    format: &'static str,
    instead: &'static str,
}

const SECRET: &str = "the format is not public; export the stone as STL or OBJ, or the design as GemCad .asc";
const SCAN: &str = "a later version will; export the scan as STL or OBJ";

static REFUSED: &[Refused] = &[
    Refused { extension: "dmc", magic: "", format: ".dmc", instead: SECRET },
    Refused { extension: "mmd", magic: "", format: ".mmd", instead: SECRET },
    Refused { extension: "oxgz", magic: "", format: ".oxgz", instead: SECRET },
    Refused { extension: "cap", magic: "", format: ".cap", instead: SECRET },
    Refused { extension: "ssp", magic: "", format: ".ssp", instead: SECRET },
    Refused { extension: "srn", magic: "SPF ", format: "Sarine .srn", instead: SCAN },
];

/// A kind of file that holds no stone that is read.
struct Kind {
    /// What such a file begins with, after white space where it is text.
    magic: &'static [u8],
    /// What it is called.
    found: &'static str,
    hint: &'static str,
}

const MESH: &str = "; export the mesh as STL, OBJ or GLB";
const UNPACK: &str = "; unpack it first";
const NONE: &str = "";

static KINDS: &[Kind] = &[
    Kind { magic: b"\x89PNG", found: "a picture (PNG)", hint: NONE },
    Kind { magic: b"\xFF\xD8\xFF", found: "a picture (JPEG)", hint: NONE },
    Kind { magic: b"GIF8", found: "a picture (GIF)", hint: NONE },
    Kind { magic: b"RIFF", found: "a picture or a film (RIFF)", hint: NONE },
    Kind { magic: b"v/1\x01", found: "a picture (EXR)", hint: NONE },
    Kind { magic: b"#?RADIANCE", found: "a picture (HDR)", hint: NONE },
    Kind { magic: b"%PDF", found: "a PDF document", hint: NONE },
    Kind { magic: b"PK\x03\x04", found: "a ZIP archive", hint: UNPACK },
    Kind { magic: b"\x1F\x8B", found: "a gzip archive", hint: UNPACK },
    Kind { magic: b"Rar!", found: "a RAR archive", hint: UNPACK },
    Kind { magic: b"7z\xBC\xAF", found: "a 7z archive", hint: UNPACK },
    Kind { magic: b"ISO-10303-21", found: "a STEP file", hint: MESH },
    Kind { magic: b"Kaydara FBX", found: "an FBX file", hint: MESH },
    Kind { magic: b"BLENDER", found: "a Blender file", hint: MESH },
    Kind { magic: b"3D Geometry File", found: "a Rhino file", hint: MESH },
    Kind { magic: b"#VRML", found: "a VRML file", hint: MESH },
    Kind { magic: b"OFF\n", found: "an OFF mesh", hint: MESH },
    Kind { magic: b"OFF\r", found: "an OFF mesh", hint: MESH },
];

/// Whether the file is a page of the web: what a site sends in place of a file that is gone.
pub fn is_web_page(source: &Source) -> bool {
    let start = source.beginning().to_ascii_lowercase();
    start.trim_start().starts_with('<')
        && ["<html", "<!doctype html", "<head", "<body"].iter().any(|t| start.contains(t))
}

/// Whether the file's ending or its beginning is one that is known and refused.
pub fn is_known(source: &Source) -> bool {
    let is_markup = source.beginning().trim_start().starts_with(['{', '<']);
    is_markup || by_name(source).is_some() || kind(source).is_some()
}

fn kind(source: &Source) -> Option<&'static Kind> {
    let start = source.bytes.trim_ascii_start();
    KINDS.iter().find(|k| source.bytes.starts_with(k.magic) || start.starts_with(k.magic))
}

/// What a file is called that no reader claims, and what to do instead.
fn found(source: &Source) -> (&'static str, &'static str) {
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

fn by_name(source: &Source) -> Option<&'static str> {
    let ending = source.extension();
    REFUSED.iter().find(|r| r.extension == ending).map(|r| r.format)
}

/// Whether a refused format has this ending.
pub fn has_ending(ending: &str) -> bool {
    REFUSED.iter().any(|r| r.extension == ending)
}

/// Why a file that no reader claims is not read.
pub fn why(source: &Source) -> FormatError {
    if source.bytes.iter().all(|b| *b == 0) {
        return FormatError::Empty { file: source.name.into() };
    }
    let (ending, start) = (source.extension(), source.beginning());
    let known = |r: &&Refused| {
        r.extension == ending || (!r.magic.is_empty() && start.trim_start().starts_with(r.magic))
    };
    match REFUSED.iter().find(known) {
        Some(r) => FormatError::Refused { file: source.name.into(), format: r.format, instead: r.instead },
        None => {
            let (found, hint) = found(source);
            FormatError::Unrecognised { file: source.name.into(), found, hint }
        }
    }
}
