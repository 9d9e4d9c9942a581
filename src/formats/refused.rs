//! Formats that cutlab knows by name and does not read, and what to do instead.

use super::error::{FormatError, shown};
use super::source::Source;
use super::{FORMATS, Format};

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

/// Whether the file's ending is one of a refused format.
pub fn by_name(source: &Source) -> Option<&'static str> {
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
        None => FormatError::Unrecognised {
            file: source.name.into(),
            found: shown(&start.chars().take(24).collect::<String>()),
            known: FORMATS.iter().map(|f: &&Format| f.name).collect(),
        },
    }
}
