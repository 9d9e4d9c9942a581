//! The one error of every reader and writer. Each is one line.

use crate::design::design_file::DocumentError;
use crate::geometry::SolidError;
use crate::geometry::facet_recovery::RecoverError;
use crate::limits::Exceeded;
use crate::storage::atomic_write::WriteError;

/// A stone that could not be read or written: which file, where in it, what was expected and what
/// was found.
///
/// ```
/// use cutlab::{FormatError, Stone, StoneError};
///
/// let error = Stone::from_bytes("broken.asc", b"", None).unwrap_err();
/// let StoneError::Format(error) = error else { panic!("{error}") };
/// assert!(matches!(*error, FormatError::Empty { .. }));
/// assert_eq!(error.to_string(), "broken.asc: the file is empty");
/// ```
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FormatError {
    /// The operating system refused.
    #[error("cannot read {file}: {cause}")]
    Read {
        /// The file.
        file: String,
        /// What the operating system said.
        cause: std::io::Error,
    },
    /// A file of more bytes than are read.
    #[error("{file}: {cause}")]
    TooLarge {
        /// The file.
        file: String,
        /// The limit.
        cause: Exceeded,
    },
    /// More of something than is read.
    #[error("{place}: {cause}")]
    Limit {
        /// The file, and the line if there is one.
        place: String,
        /// The limit.
        cause: Exceeded,
    },
    /// A text file that breaks off or says something else than its format allows.
    #[error("{file}, line {line}: expected {expected}, found {found}")]
    Line {
        /// The file.
        file: String,
        /// The line, from 1.
        line: usize,
        /// What should stand there.
        expected: String,
        /// What stands there.
        found: String,
    },
    /// A binary file that breaks off or says something else than its format allows.
    #[error("{file}, byte {offset}: expected {expected}, found {found}")]
    Byte {
        /// The file.
        file: String,
        /// Offset from the file's start.
        offset: usize,
        /// What should stand there.
        expected: String,
        /// What stands there.
        found: String,
    },
    /// A file of no bytes, or of NUL only.
    #[error("{file}: the file is empty")]
    Empty {
        /// The file.
        file: String,
    },
    /// Content of no format that is read. It is a stranger's, and not shown.
    #[error("{file}: {found}, not a design or mesh{hint}")]
    Unrecognised {
        /// The file.
        file: String,
        /// What it is, as far as it tells.
        found: &'static str,
        /// What to do instead, after a semicolon; or nothing.
        hint: &'static str,
    },
    /// A format known by name that cutlab does not read.
    #[error("{file}: {format} files are not read: {instead}")]
    Unsupported {
        /// The file.
        file: String,
        /// The format's name.
        format: &'static str,
        /// What to do instead.
        instead: &'static str,
    },
    /// Understood, but its planes or its mesh are no convex stone.
    #[error("{cause}")]
    NoStone {
        /// Name of the format.
        format: &'static str,
        /// How many facets it lists, if it lists facets.
        facets: Option<usize>,
        /// What is wrong with it: [`FormatError::Solid`] or [`FormatError::Mesh`].
        cause: Box<FormatError>,
    },
    /// A mesh that is no convex stone.
    #[error("{file}: {cause}")]
    Mesh {
        /// The file.
        file: String,
        /// What is wrong with it.
        cause: RecoverError,
    },
    /// Planes that bound no stone.
    #[error("{file}: {cause}")]
    Solid {
        /// The file, or the design's name when writing.
        file: String,
        /// What is wrong with them.
        cause: SolidError,
    },
    /// A design file or a library cut with a wrong tier, parameter or value.
    #[error("{file}: {cause}")]
    Cut {
        /// The file or the stone as asked for.
        file: String,
        /// What is wrong with it.
        cause: DocumentError,
    },
    /// A format or extension that is not written.
    #[error(
        "cannot write '{asked}': its extension must be one of {}{}",
        .known.join(", "),
        also_drawn(.known)
    )]
    NoWriter {
        /// The file or format asked for.
        asked: String,
        /// The extensions that are written.
        known: Vec<&'static str>,
    },
    /// A design that does not fit into the format.
    #[error("cannot write {name} as {format}: {problem}")]
    Encode {
        /// The design.
        name: String,
        /// The format.
        format: &'static str,
        /// Why.
        problem: String,
    },
    /// The operating system refused.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// How many characters of a file an error shows.
const SHOWN: usize = 40;

/// The start of `text` in quotes, control characters escaped, for an error's single line.
pub(super) fn quoted_excerpt(text: &str) -> String {
    if text.is_empty() {
        return "the end".into();
    }
    format!("'{}'", cut(text, SHOWN))
}

/// As [`quoted_excerpt`], without quotes and of up to three times as many characters: for what is said in part in our
/// own words.
pub(super) fn shortened(text: &str) -> String {
    cut(text, 3 * SHOWN)
}

/// Who draws diagrams, after a semicolon; nothing where the extensions of diagrams are listed.
fn also_drawn(known: &[&str]) -> &'static str {
    if known.contains(&"svg") { "" } else { "; cutlab generate also draws diagrams (.svg, .pdf, .png)" }
}

/// `1 byte`, `2 bytes`.
pub(super) fn counted(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

fn cut(text: &str, most: usize) -> String {
    let mut start = String::new();
    for c in text.chars().take(most) {
        if c.is_control() { start.extend(c.escape_default()) } else { start.push(c) }
    }
    if text.chars().nth(most).is_some() {
        start.push('…');
    }
    start
}

impl FormatError {
    /// Adds to a stone that is none what is known of its file; leaves other errors as they are.
    pub(super) fn in_format(self, format: &'static str, facets: Option<usize>) -> FormatError {
        match self {
            FormatError::Mesh { .. } | FormatError::Solid { .. } => {
                FormatError::NoStone { format, facets, cause: Box::new(self) }
            }
            other => other,
        }
    }
}
