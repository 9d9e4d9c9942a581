//! The command that a picture, drawing or page records, by which its own output is known again.
//!
//! PNG and APNG have it as the text `Command`, EXR as the comment of its first layer, SVG, HTML and GIF
//! as a processing instruction behind their end.

use crate::parse::shell;
use crate::storage::bounded_read;
use crate::storage::text::display_name;
use exr::meta::MetaData;
use std::ffi::OsString;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

/// Options, with a value, that say where output goes, or how fast: not what it is.
const WHERE: [&str; 4] = ["-o", "--output", "-j", "--threads"];
/// The same without a value: what is said while it is made.
const HOW: [&str; 4] = ["-q", "--quiet", "--json", "--force"];

/// What stands before and after the command in SVG and HTML.
const BEFORE: &str = "<?cutlab-command ";
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

/// An SVG drawing or HTML page with its command recorded.
pub fn recorded(text: String, command: &str) -> String {
    text + &behind(command)
}

/// A PDF with its command recorded behind its end, if that is not too long for readers to find the end.
pub fn in_pdf(mut page: Vec<u8>, command: &str) -> Vec<u8> {
    /// The end is looked for in the last 1024 bytes. Source: PDF Reference 1.7 (2006), appendix H, note 18.
    const MOST: usize = 1000;
    let record = format!("\n%{}", behind(command));
    if record.len() <= MOST {
        page.extend(record.bytes());
    }
    page
}

/// What stands behind a drawing, page or GIF and records its command.
pub fn behind(command: &str) -> String {
    format!("{BEFORE}{}{AFTER}", escaped(command))
}

/// Text within markup, which has no control characters.
fn escaped(text: &str) -> String {
    let text: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    maud::html! { (text) }.into_string()
}

/// Whether the picture, drawing or page at `path` was made by `command`.
pub fn is_of(path: &Path, command: &str) -> bool {
    let Ok(mut file) = bounded_read::open_regular(path) else { return false };
    let mut magic = [0; 4];
    if file.read_exact(&mut magic).and_then(|()| file.seek(SeekFrom::Start(0))).is_err() {
        return false;
    }
    // a frame's record goes on with what it was made from, a progressive picture's with its rounds
    let made_by = |said: &str| {
        let rest = said.strip_prefix(command);
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(" # ") || rest.starts_with('\n'))
    };
    match &magic {
        b"\x89PNG" => {
            let reader = png::Decoder::new(BufReader::new(file)).read_info();
            let text = reader.ok().and_then(|reader| {
                let said = reader.info().utf8_text.iter().find(|t| t.keyword == "Command")?;
                said.get_text().ok()
            });
            text.is_some_and(|said| made_by(&said))
        }
        [0x76, 0x2f, 0x31, 0x01] => {
            let meta = MetaData::read_from_buffered(BufReader::new(file), false);
            let comment = meta.ok().and_then(|m| m.headers.first()?.own_attributes.comments.clone());
            comment.is_some_and(|said| made_by(&said.to_string()))
        }
        _ => {
            let length = file.metadata().map_or(0, |m| m.len());
            let mut end = Vec::new();
            let from = SeekFrom::Start(length.saturating_sub(LONGEST));
            let read = file.seek(from).and_then(|_| file.take(LONGEST).read_to_end(&mut end));
            read.is_ok() && end.ends_with(behind(command).as_bytes())
        }
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
        for command in ["cutlab sweep cube --vary 'a?>b=1:2:1'", "cutlab sweep cube"] {
            let svg = recorded("<svg xmlns=\"http://www.w3.org/2000/svg\"></svg>\n".into(), command);
            roxmltree::Document::parse(&svg).expect("is XML");
            std::fs::write(&path, svg).expect("writes");
            assert!(is_of(&path, command) && !is_of(&path, "cutlab sweep") && !is_of(&path, "cube"));
        }
        for other in ["", "x", "<svg></svg>\n", "\u{89}PNG", "v/1\u{1}"] {
            std::fs::write(&path, other).expect("writes");
            assert!(!is_of(&path, ""), "{other}");
        }
        assert!(!is_of(&top.path().join("none"), ""));
    }

    #[test]
    fn pictures_are_known_by_their_command() {
        use crate::integrators::image_io::{Bits, Provenance, exr, png};
        let top = tempfile::tempdir().expect("a temporary folder");
        let film = Film { width: 2, height: 1, pixels: vec![Default::default(); 2] };
        let made = Provenance { command: "cutlab render a --spp 4", rounds: Some(3) };
        let shown = [glam::Vec3::ZERO; 2];
        let files = [
            png(&shown, 2, 1, Bits::Eight, Some(made)).expect("a PNG"),
            exr(&film, &[Default::default(); 2], false, made).expect("an EXR"),
        ];
        for bytes in files {
            let path = top.path().join("p");
            std::fs::write(&path, bytes).expect("writes");
            assert!(is_of(&path, made.command));
            for other in ["cutlab render a", "cutlab render a --spp 40", "cutlab render a --spp"] {
                assert!(!is_of(&path, other), "{other}");
            }
        }
    }
}
