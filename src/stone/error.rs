//! The error of a STONE that is no stone.

use crate::design::design_file::DocumentError;
#[cfg(feature = "files")]
use crate::formats::{FormatError, MeshFacts};
use crate::geometry::SolidError;
use crate::geometry::facet_recovery::RecoverError;
use crate::parse::did_you_mean;
#[cfg(feature = "files")]
use crate::storage::find_files::FindError;
use std::sync::Arc;

/// A STONE that could not be opened: what was asked for, what was expected, what was found.
///
/// ```
/// use cutlab::{Stone, StoneError};
///
/// let error = Stone::parse("tolkowski").unwrap_err();
/// assert!(matches!(error, StoneError::NoSuchStone { nearest: Some("tolkowsky"), .. }));
/// ```
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StoneError {
    /// A file that could not be read.
    #[cfg(feature = "files")]
    #[error(transparent)]
    Format(Box<FormatError>),
    /// Files of a folder or a pattern that could not be found.
    #[cfg(feature = "files")]
    #[error(transparent)]
    Find(#[from] FindError),
    /// A folder without a stone.
    #[error("no designs and no meshes in {place}")]
    NoStones {
        /// The folder, or several.
        place: String,
    },
    /// A cut with a wrong parameter.
    #[error("{spec}: {cause}")]
    Cut {
        /// The stone as asked for.
        spec: String,
        /// What is wrong with it.
        cause: DocumentError,
    },
    /// A closed mesh with concavities or in several parts, where a convex stone is needed.
    #[error(transparent)]
    NotConvex(Arc<StoneError>),
    /// A mesh that is no stone.
    #[error("{stone}: {cause}")]
    Mesh {
        /// The stone.
        stone: String,
        /// What is wrong with it.
        cause: RecoverError,
    },
    /// Planes that bound no stone.
    #[error("{stone}: {cause}")]
    Solid {
        /// The stone.
        stone: String,
        /// What is wrong with them.
        cause: SolidError,
    },
    /// `name:key=value` with something else in place of a `key=value`.
    #[error("stone '{spec}', at '{found}': {why}")]
    Parameter {
        /// The stone as asked for.
        spec: String,
        /// The part that is not understood.
        found: String,
        /// Why not.
        why: String,
    },
    /// A file with something behind its colon that is neither its material nor its index.
    #[error("{spec}, at '{found}': {why}")]
    Item {
        /// The stone as asked for.
        spec: String,
        /// The part that is not understood.
        found: String,
        /// What to write.
        why: String,
    },
    /// A material or an index that does not exist, or two of them.
    #[error("{spec}: {why}")]
    Material {
        /// The stone as asked for.
        spec: String,
        /// What is wrong with it.
        why: String,
    },
    /// Neither a cut nor a file.
    #[error("no cut and no file is called '{spec}'{} (all cuts: cutlab list cuts)", did_you_mean(*.nearest))]
    NoSuchStone {
        /// The stone as asked for.
        spec: String,
        /// The library's name that is probably meant.
        nearest: Option<&'static str>,
    },
    /// What can only be the name of a file, and is not.
    #[error("there is no file '{spec}'")]
    NoSuchFile {
        /// The file as asked for.
        spec: String,
    },
    /// A cut that cannot be made.
    #[error("there is no cut '{spec}': {why}; the nearest is '{nearest}'")]
    Impossible {
        /// The stone as asked for.
        spec: String,
        /// Why it cannot be made.
        why: &'static str,
        /// The library's nearest cut.
        nearest: &'static str,
    },
    /// A folder where one stone is named.
    #[error("{spec} is a folder, and here one stone is named: name a file in it")]
    Folder {
        /// The folder.
        spec: String,
    },
    /// A girdle width that is none.
    #[error("a girdle width is a number of millimetres above 0, found {found}")]
    Width {
        /// The number given.
        found: f64,
    },
}

impl StoneError {
    /// Whether the operating system refused to read what is there. A name that leads to no file is a wrong
    /// argument instead.
    pub fn is_io(&self) -> bool {
        #[cfg(feature = "files")]
        if let Some(cause) = self.io_cause() {
            use std::io::ErrorKind::{IsADirectory, NotADirectory, NotFound};
            return !matches!(cause.kind(), NotFound | NotADirectory | IsADirectory);
        }
        false
    }

    /// What is known of a file that was understood but holds no convex stone; none for every other error.
    #[cfg(feature = "files")]
    pub fn mesh_facts(&self) -> Option<MeshFacts> {
        match self {
            StoneError::Format(error) => error.mesh_facts(),
            StoneError::NotConvex(cause) => match &**cause {
                StoneError::Format(error) => error.mesh_facts(),
                _ => None,
            },
            _ => None,
        }
    }

    #[cfg(feature = "files")]
    fn io_cause(&self) -> Option<&std::io::Error> {
        match self {
            StoneError::Find(FindError::Read { cause, .. }) => Some(cause),
            StoneError::Format(error) => match &**error {
                FormatError::Read { cause, .. } => Some(cause),
                _ => None,
            },
            _ => None,
        }
    }
}

#[cfg(feature = "files")]
impl From<FormatError> for StoneError {
    fn from(error: FormatError) -> StoneError {
        StoneError::Format(Box::new(error))
    }
}
