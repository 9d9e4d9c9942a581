//! The record of origin in a picture, drawing or page: the command as it was typed and the hash of the canonical
//! request, by which its own output is known again.
//!
//! PNG and APNG have them as the texts `Command` and `Request`, EXR as JSON in an attribute of its first layer, SVG,
//! HTML, GIF and what else has no metadata as JSON in a processing instruction behind their end.

use super::request::RenderRequest;
use crate::batch::fingerprint::request_hash;
use crate::batch::sidecar::TableMeta;
use crate::integrators::image_io::{EXR_ATTRIBUTE, Provenance};
use crate::parse::shell;
use crate::storage::bounded_read;
use crate::storage::text::display_name;
use exr::meta::MetaData;
use exr::meta::attribute::AttributeValue;
use serde::{Deserialize, Serialize};
use std::ffi::OsString;
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

/// Options, with a value, that say where output goes, or how fast: not what it is.
const WHERE: [&str; 4] = ["-o", "--output", "-j", "--threads"];
/// The same without a value: what is said while it is made.
const HOW: [&str; 4] = ["-q", "--quiet", "--json", "--force"];

/// What stands before and after the JSON in SVG and HTML.
const BEFORE: &str = "<?cutlab-record ";
const AFTER: &str = "?>\n";

/// No record is longer, in bytes.
const LONGEST: u64 = 1 << 16;

/// The process's command line as typed.
pub fn command_line() -> String {
    let words = std::env::args_os().skip(1).map(|word| shell::quoted(&word.to_string_lossy()));
    std::iter::once("cutlab".to_string()).chain(words).collect::<Vec<_>>().join(" ")
}

/// The process's command line as records have it: without what does not change the results.
pub fn own_command() -> String {
    command_of(std::env::args_os().skip(1))
}

fn command_of(arguments: impl Iterator<Item = OsString>) -> String {
    let mut said = vec!["cutlab".to_owned()];
    let mut arguments = arguments.map(display_name);
    while let Some(argument) = arguments.next() {
        let name = argument.split('=').next().unwrap_or_default();
        if WHERE.contains(&name) && !argument.contains('=') {
            arguments.next();
        }
        let with_value = argument.starts_with("-o") || argument.starts_with("-j");
        if !with_value && !WHERE.contains(&name) && !HOW.contains(&&*argument) {
            said.push(shell::quoted(&argument));
        }
    }
    said.join(" ")
}

/// What a file says of where it comes from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Record {
    /// The command; empty if nobody typed one.
    pub command: String,
    /// Hash of the canonical request ([`request_hash`]); none of a command that makes no request.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub request: Option<String>,
}

impl From<Provenance<'_>> for Record {
    fn from(made: Provenance) -> Record {
        Record { command: made.command.into(), request: made.request.map(str::to_owned) }
    }
}

impl Record {
    /// Of a command that makes no request.
    pub fn of_command(command: impl Into<String>) -> Record {
        Record { command: command.into(), request: None }
    }

    /// Of a command that makes a request.
    pub fn of_request(command: impl Into<String>, request: &impl Serialize) -> Record {
        Record { command: command.into(), request: Some(request_hash(request)) }
    }

    /// Of what is drawn of the table that a sidecar describes.
    pub fn of_table(meta: &TableMeta) -> Record {
        let request = (!meta.request.is_null()).then(|| request_hash(&meta.request));
        Record { command: meta.command.clone(), request }
    }

    /// Of a picture that a program takes. With stones or a material that the program opened itself the request does
    /// not tell what the picture is of, and is left out.
    pub fn of_picture(request: &RenderRequest) -> Record {
        let tells_all = request.opened.is_empty() && request.options.opened_material.is_none();
        Record { command: String::new(), request: tells_all.then(|| request_hash(request)) }
    }

    /// As the metadata of a picture.
    pub fn provenance(&self) -> Provenance<'_> {
        Provenance { command: &self.command, request: self.request.as_deref(), ..Provenance::default() }
    }

    /// Whether the file at `path` was made by the same request; where either names none, by the same command.
    pub fn matches(&self, path: &Path) -> bool {
        let Some(found) = Record::read(path) else { return false };
        match (&self.request, &found.request) {
            (Some(own), Some(found)) => own == found,
            _ => self.command == found.command,
        }
    }

    /// The record of the picture, drawing or page at `path`; none if it has none that can be read.
    pub fn read(path: &Path) -> Option<Record> {
        let mut file = bounded_read::open_regular(path).ok()?;
        let mut magic = [0; 4];
        file.read_exact(&mut magic).and_then(|()| file.seek(SeekFrom::Start(0))).ok()?;
        match &magic {
            b"\x89PNG" => Record::of_png(file),
            [0x76, 0x2f, 0x31, 0x01] => Record::of_exr(file),
            _ => Record::behind_end(file),
        }
    }

    fn of_png(file: File) -> Option<Record> {
        let reader = png::Decoder::new(BufReader::new(file)).read_info().ok()?;
        let texts = &reader.info().utf8_text;
        let text = |keyword: &str| texts.iter().find(|t| t.keyword == keyword)?.get_text().ok();
        Some(Record { command: text("Command")?, request: text("Request") })
    }

    fn of_exr(file: File) -> Option<Record> {
        let meta = MetaData::read_from_buffered(BufReader::new(file), false).ok()?;
        let attributes = &meta.headers.first()?.own_attributes.other;
        let record = attributes.iter().find(|(name, _)| *name == EXR_ATTRIBUTE);
        let Some((_, AttributeValue::Text(json))) = record else { return None };
        serde_json::from_str(&json.to_string()).ok()
    }

    fn behind_end(mut file: File) -> Option<Record> {
        let length = file.metadata().ok()?.len();
        file.seek(SeekFrom::Start(length.saturating_sub(LONGEST))).ok()?;
        let mut end = Vec::new();
        file.take(LONGEST).read_to_end(&mut end).ok()?;
        let end = end.strip_suffix(AFTER.as_bytes())?;
        let begin = end.windows(BEFORE.len()).rposition(|bytes| bytes == BEFORE.as_bytes())?;
        serde_json::from_slice(&end[begin + BEFORE.len()..]).ok()
    }

    /// As it stands behind a drawing, page or GIF. Within markup it has no angle brackets of its own.
    pub fn behind(&self) -> String {
        let json = serde_json::to_string(self).unwrap_or_default();
        format!("{BEFORE}{}{AFTER}", json.replace('<', "\\u003c").replace('>', "\\u003e"))
    }

    /// An SVG drawing or HTML page with the record.
    pub fn in_markup(&self, text: String) -> String {
        text + &self.behind()
    }

    /// A PDF with the record behind its end, if that is not too long for readers to find the end.
    pub fn in_pdf(&self, mut page: Vec<u8>) -> Vec<u8> {
        /// The end is looked for in the last 1024 bytes. Source: PDF Reference 1.7 (2006), appendix H, note 18.
        const MOST: usize = 1000;
        let record = format!("\n%{}", self.behind());
        if record.len() <= MOST {
            page.extend(record.bytes());
        }
        page
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrators::Film;

    #[test]
    fn a_command_is_recorded_without_where_its_output_goes() {
        let said = |line: &str| command_of(line.split(' ').map(OsString::from));
        let plain = "cutlab report a.asc --size 8";
        for line in [
            "report a.asc --size 8 -o x",
            "report -o=x a.asc --size 8 --force",
            "-q report a.asc --output x --size 8 --json",
            "report a.asc -ox --size 8 --output=y",
            "report a.asc -j2 --size 8 -j 3 --threads=4 --threads 5 -o x",
        ] {
            assert_eq!(said(line), plain, "{line}");
        }
        assert_ne!(said("report a.asc --size 9"), plain);
    }

    #[test]
    fn drawings_and_pages_are_known_by_their_command() {
        let top = tempfile::tempdir().expect("a temporary folder");
        let path = top.path().join("x");
        let is_of = |command: &str| Record::of_command(command).matches(&path);
        for command in ["cutlab sweep cube --vary 'a?>b=1:2:1'", "cutlab sweep cube"] {
            let svg = Record::of_command(command)
                .in_markup("<svg xmlns=\"http://www.w3.org/2000/svg\"></svg>\n".into());
            roxmltree::Document::parse(&svg).expect("is XML");
            std::fs::write(&path, svg).expect("writes");
            assert!(is_of(command) && !is_of("cutlab sweep") && !is_of("cube"));
        }
        for other in ["", "x", "<svg></svg>\n", "\u{89}PNG", "v/1\u{1}", "<?cutlab-record {}?>\n"] {
            std::fs::write(&path, other).expect("writes");
            assert!(!is_of(""), "{other}");
        }
        assert!(!Record::of_command("").matches(&top.path().join("none")));
    }

    /// The request decides where both name one: words of the command that say the same make no difference.
    #[test]
    fn a_file_is_known_by_its_request() {
        let top = tempfile::tempdir().expect("a temporary folder");
        let path = top.path().join("x.svg");
        let made = Record::of_request("cutlab render cube", &1);
        std::fs::write(&path, made.in_markup("<svg/>".into())).expect("writes");
        assert_eq!(Record::read(&path), Some(made));
        assert!(Record::of_request("cutlab render cube --seed 1", &1).matches(&path));
        assert!(!Record::of_request("cutlab render cube", &2).matches(&path));
        assert!(Record::of_command("cutlab render cube").matches(&path));
    }

    #[test]
    fn pictures_are_known_by_their_command_and_request() {
        use crate::integrators::image_io::{Bits, exr, png};
        let top = tempfile::tempdir().expect("a temporary folder");
        let film = Film { width: 2, height: 1, pixels: vec![Default::default(); 2] };
        let shown = [glam::Vec3::ZERO; 2];
        for record in [Record::of_command("cutlab render a"), Record::of_request("cutlab render a", &4)] {
            let made = Provenance { rounds: Some(3), identity: Some("a frame"), ..record.provenance() };
            let files = [
                png(&shown, 2, 1, Bits::Eight, Some(made)).expect("a PNG"),
                exr(&film, &[Default::default(); 2], false, made).expect("an EXR"),
            ];
            for bytes in files {
                let path = top.path().join("p");
                std::fs::write(&path, bytes).expect("writes");
                assert_eq!(Record::read(&path).as_ref(), Some(&record));
                assert!(record.matches(&path));
                for other in ["cutlab render", "cutlab render ab", "cutlab render a --spp 4"] {
                    assert!(!Record::of_command(other).matches(&path), "{other}");
                }
            }
        }
    }

    /// A picture of stones that a program opened has no request that tells of them.
    #[test]
    fn stones_that_were_opened_are_in_no_request() {
        let request = RenderRequest::default();
        assert!(Record::of_picture(&request).request.is_some());
        let stone = crate::stone::Stone::parse("cube").expect("a cut");
        assert_eq!(Record::of_picture(&request.stone(&stone)).request, None);
    }
}
