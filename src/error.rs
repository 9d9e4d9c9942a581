//! The one error of the library's root, and its kinds.

#[cfg(feature = "files")]
use crate::formats::FormatError;
use crate::materials::NoSuchMaterial;
use crate::scoring::ScoreError;
use crate::stone::StoneError;
#[cfg(feature = "files")]
use crate::storage::atomic_write::WriteError;
#[cfg(feature = "files")]
use crate::storage::find_files::FindError;
#[cfg(feature = "files")]
use std::io::ErrorKind as IoErrorKind;

/// What went wrong: one sentence that names the file, line, facet or option, what was expected and what was
/// found. [`Error::kind`] tells what to do about it.
///
/// ```
/// use cutlab::{Error, ErrorKind, Stone};
///
/// let error = Error::from(Stone::parse("round-briliant").unwrap_err());
/// assert_eq!(error.kind(), ErrorKind::NotFound);
/// assert!(error.to_string().contains("did you mean 'round-brilliant'"));
/// ```
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Of a stone.
    #[error(transparent)]
    Stone(Box<StoneError>),
    /// Of scores.
    #[error(transparent)]
    Score(#[from] ScoreError),
    /// Of a design or a mesh that is read or written.
    #[cfg(feature = "files")]
    #[error(transparent)]
    Format(#[from] FormatError),
    /// Of a file that is written.
    #[cfg(feature = "files")]
    #[error(transparent)]
    Write(#[from] WriteError),
    /// Of a picture.
    #[cfg(feature = "render")]
    #[error(transparent)]
    Render(#[from] crate::render::RenderError),
    /// A material that there is not.
    #[error(transparent)]
    Material(#[from] NoSuchMaterial),
}

/// Kinds of errors.
///
/// ```
/// use cutlab::{Error, ErrorKind, Material};
///
/// assert_eq!(Error::from(Material::named("rubby").unwrap_err()).kind(), ErrorKind::NotFound);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ErrorKind {
    /// A name that nothing has, or a file that is not there: ask for another.
    NotFound,
    /// Content or an argument that is wrong: mend it.
    Invalid,
    /// More than is read: raise the limits.
    Limit,
    /// The operating system refused: look at rights and room.
    Io,
    /// The work was ended early, as it was asked to.
    Cancelled,
}

impl Error {
    /// What to do about it.
    pub fn kind(&self) -> ErrorKind {
        match self {
            Error::Stone(error) => of_stone(error),
            Error::Score(ScoreError::NoSuchMetric { .. }) | Error::Material(_) => ErrorKind::NotFound,
            Error::Score(_) => ErrorKind::Invalid,
            #[cfg(feature = "files")]
            Error::Format(error) => of_format(error),
            #[cfg(feature = "files")]
            Error::Write(_) => ErrorKind::Io,
            #[cfg(feature = "render")]
            Error::Render(error) => of_render(error),
        }
    }
}

impl From<StoneError> for Error {
    fn from(error: StoneError) -> Error {
        Error::Stone(Box::new(error))
    }
}

fn of_stone(error: &StoneError) -> ErrorKind {
    match error {
        #[cfg(feature = "files")]
        StoneError::Format(error) => of_format(error),
        #[cfg(feature = "files")]
        StoneError::Find(FindError::Read { cause, .. }) => of_reading(cause),
        #[cfg(feature = "files")]
        StoneError::Find(FindError::NoMatch(_)) => ErrorKind::NotFound,
        StoneError::NoSuchStone { .. }
        | StoneError::NoSuchFile { .. }
        | StoneError::NoStones { .. }
        | StoneError::Impossible { .. } => ErrorKind::NotFound,
        _ => ErrorKind::Invalid,
    }
}

#[cfg(feature = "files")]
fn of_format(error: &FormatError) -> ErrorKind {
    match error {
        FormatError::Read { cause, .. } => of_reading(cause),
        FormatError::Write(_) => ErrorKind::Io,
        FormatError::Limit { .. } | FormatError::TooLarge { .. } => ErrorKind::Limit,
        _ => ErrorKind::Invalid,
    }
}

/// A name that leads to no file is to be mended; a file that is there and cannot be read is not.
#[cfg(feature = "files")]
fn of_reading(cause: &std::io::Error) -> ErrorKind {
    match cause.kind() {
        IoErrorKind::NotFound | IoErrorKind::NotADirectory | IoErrorKind::IsADirectory => ErrorKind::NotFound,
        _ => ErrorKind::Io,
    }
}

#[cfg(feature = "render")]
fn of_render(error: &crate::render::RenderError) -> ErrorKind {
    use crate::photons::map_file::MapFileError;
    use crate::render::RenderError;
    use crate::scene::SceneError;
    match error {
        RenderError::Stone(error) => of_stone(error),
        RenderError::Scene(SceneError::Read { cause, .. })
        | RenderError::PhotonMap(MapFileError::Read { cause, .. }) => of_reading(cause),
        RenderError::Scene(SceneError::Limit { .. }) => ErrorKind::Limit,
        RenderError::Write(_) | RenderError::PhotonMap(MapFileError::Write(_)) => ErrorKind::Io,
        RenderError::Cancelled => ErrorKind::Cancelled,
        _ => ErrorKind::Invalid,
    }
}
