//! The header of a PLY file: its kind, and its elements with their properties.

use crate::formats::error::FormatError;
use crate::formats::input::{Input, lines};
use crate::limits;

/// How the values after the header are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Storage {
    /// Words.
    Text,
    /// Binary, least byte first.
    Little,
    /// Binary, greatest byte first.
    Big,
}

/// Type of a stored number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum PlyScalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl PlyScalar {
    fn by_name(word: &str) -> Option<PlyScalar> {
        Some(match word {
            "char" | "int8" => PlyScalar::I8,
            "uchar" | "uint8" => PlyScalar::U8,
            "short" | "int16" => PlyScalar::I16,
            "ushort" | "uint16" => PlyScalar::U16,
            "int" | "int32" => PlyScalar::I32,
            "uint" | "uint32" => PlyScalar::U32,
            "float" | "float32" => PlyScalar::F32,
            "double" | "float64" => PlyScalar::F64,
            _ => return None,
        })
    }
}

/// One property of an element.
#[derive(Debug)]
pub struct Property {
    pub name: String,
    pub kind: PlyScalar,
    /// Type of the length, if the property is a list.
    pub length: Option<PlyScalar>,
}

/// One element: so many rows of its properties.
#[derive(Debug)]
pub struct PlyElement {
    pub name: String,
    pub count: u64,
    pub properties: Vec<Property>,
    /// The line that declares it.
    pub line: usize,
}

/// What the header says, and where it ends.
#[derive(Debug)]
pub struct Header {
    pub storage: Storage,
    pub elements: Vec<PlyElement>,
    /// What follows `comment facet` on each such line: the facets' names, as cutlab writes them.
    pub facet_names: Vec<String>,
    /// Offset of the first byte after the header.
    pub end: usize,
    /// Number of the first line after it.
    pub line: usize,
}

/// Whether the file begins as a PLY file does.
pub fn begins(source: &Input) -> bool {
    let start = source.beginning();
    lines(&start).next().is_some_and(|(_, first)| first.trim_end() == "ply" && start.len() > first.len())
}

/// Whether the header says that values are words.
pub fn says_text(source: &Input) -> bool {
    let mut said = None;
    for (_, line) in lines(&source.beginning()) {
        match line.split_whitespace().next() {
            Some("format") => said = said.or(Some(line.trim_start().starts_with("format ascii"))),
            Some("end_header") => break,
            _ => {}
        }
    }
    said == Some(true)
}

impl Header {
    /// Whether values are words.
    pub fn is_text(&self) -> bool {
        self.storage == Storage::Text
    }

    /// Reads the header.
    ///
    /// - `bytes`: the file's, or those of its decoded text
    pub fn parse(source: &Input, bytes: &[u8]) -> Result<Header, FormatError> {
        let mut header =
            Header { storage: Storage::Text, elements: Vec::new(), facet_names: Vec::new(), end: 0, line: 0 };
        let mut storage = None;
        loop {
            let Some((line, after)) = line_at(bytes, header.end) else {
                return Err(source.at_line(header.line + 1, "end_header", ""));
            };
            header.end = after;
            header.line += 1;
            let text = String::from_utf8_lossy(line);
            let wrong = |expected: &str| source.at_line(header.line, expected, text.trim());
            let words: Vec<&str> = text.split_whitespace().collect();
            match words[..] {
                ["format", kind, ..] => {
                    storage = Some(match kind {
                        "ascii" => Storage::Text,
                        "binary_little_endian" => Storage::Little,
                        "binary_big_endian" => Storage::Big,
                        _ => return Err(wrong("format ascii, binary_little_endian or binary_big_endian")),
                    });
                }
                ["element", name, count] => {
                    let count = count.parse().map_err(|_| wrong("element NAME COUNT"))?;
                    source.within_at(header.line, &limits::PLY_PARTS, header.elements.len() + 1)?;
                    let (name, line) = (name.into(), header.line);
                    header.elements.push(PlyElement { name, count, properties: Vec::new(), line });
                }
                ["property", ref rest @ ..] => {
                    let (length, kind, name) = match rest {
                        ["list", length, kind, name] => {
                            (Some(PlyScalar::by_name(length)), PlyScalar::by_name(kind), name)
                        }
                        [kind, name] => (None, PlyScalar::by_name(kind), name),
                        _ => return Err(wrong("property TYPE NAME or property list TYPE TYPE NAME")),
                    };
                    let (Some(kind), false, Some(element)) =
                        (kind, length == Some(None), header.elements.last_mut())
                    else {
                        return Err(wrong("a property of a known type after its element"));
                    };
                    source.within_at(header.line, &limits::PLY_PARTS, element.properties.len() + 1)?;
                    element.properties.push(Property {
                        name: (*name).into(),
                        kind,
                        length: length.flatten(),
                    });
                }
                ["comment", "facet", ref name @ ..] => header.facet_names.push(name.join(" ")),
                ["end_header"] => break,
                ["ply" | "comment" | "obj_info", ..] | [] => {}
                _ => return Err(wrong("format, element, property, comment or end_header")),
            }
        }
        header.storage = storage
            .ok_or_else(|| source.at_line(header.line, "a line 'format …' before it", "end_header"))?;
        let face = |e: &PlyElement| matches!(&*e.name, "face" | "tristrips") && e.count > 0;
        if !header.elements.iter().any(face) {
            // a scan as a grid of ranges, a cloud of points
            let others: Vec<&str> = header.elements.iter().map(|e| &*e.name).collect();
            let found = format!("end_header after {}", others.join(", "));
            return Err(source.at_line(header.line, "an element 'face' before it", &found));
        }
        header.line += 1;
        Ok(header)
    }
}

/// The line that begins at `at`, without its end, and where the next begins.
fn line_at(bytes: &[u8], at: usize) -> Option<(&[u8], usize)> {
    let rest = bytes.get(at..)?;
    let end = rest.iter().position(|b| matches!(b, b'\n' | b'\r'))?;
    // where lines end in a lone CR, a byte like LF after the last is the first of the values
    let first = bytes.iter().position(|b| matches!(b, b'\n' | b'\r')).unwrap_or_default();
    let pairs = bytes[first..].starts_with(b"\n") || bytes[first..].starts_with(b"\r\n");
    let long = if pairs && rest[end..].starts_with(b"\r\n") { 2 } else { 1 };
    Some((&rest[..end], at + end + long))
}
