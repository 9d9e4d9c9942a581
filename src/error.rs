//! The one error of the library's root, and its kinds.

#[cfg(feature = "files")]
use crate::batch::comparison::ComparisonError;
#[cfg(feature = "files")]
use crate::batch::merge::MergeError;
#[cfg(feature = "files")]
use crate::batch::table::TableError;
#[cfg(feature = "files")]
use crate::batch::table_job::TableJobError;
use crate::design::CutError;
use crate::design::edit::{EditError, SettingError};
use crate::design::retarget::RetargetError;
#[cfg(feature = "files")]
use crate::formats::{FormatError, MeshFacts};
use crate::geometry::SolidError;
use crate::materials::NoSuchMaterial;
#[cfg(feature = "search")]
use crate::optimise::OptimiseError;
#[cfg(feature = "render")]
use crate::photons::map_file::MapFileError;
#[cfg(feature = "render")]
use crate::render::RenderError;
#[cfg(feature = "report")]
use crate::report::ReportError;
#[cfg(feature = "render")]
use crate::scene::SceneError;
use crate::scoring::edit_report::EditScoreError;
use crate::scoring::{AttributionError, ObjectiveError, ScoreError};
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
    Render(#[from] RenderError),
    /// Of a report.
    #[cfg(feature = "report")]
    #[error(transparent)]
    Report(Box<ReportError>),
    /// Of stones beside each other.
    #[cfg(feature = "files")]
    #[error(transparent)]
    Comparison(Box<ComparisonError>),
    /// Of a table.
    #[cfg(feature = "files")]
    #[error(transparent)]
    Table(#[from] TableError),
    /// Of the parts of a table.
    #[cfg(feature = "files")]
    #[error(transparent)]
    Merge(Box<MergeError>),
    /// Of planes that bound no solid.
    #[error(transparent)]
    Solid(#[from] SolidError),
    /// Of parameters that no cut has.
    #[error(transparent)]
    Cut(#[from] CutError),
    /// Of a change of a design.
    #[error(transparent)]
    Edit(Box<EditError>),
    /// Of a design that is made for another index.
    #[error(transparent)]
    Retarget(Box<RetargetError>),
    /// Of a setting that is not understood.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// Of an objective: a metric that there is not, or that a stone does not have.
    #[error(transparent)]
    Objective(#[from] ObjectiveError),
    /// Of an optimisation.
    #[cfg(feature = "search")]
    #[error(transparent)]
    Optimise(Box<OptimiseError>),
    /// A material that there is not.
    #[error(transparent)]
    Material(#[from] NoSuchMaterial),
    /// Work that was ended early.
    #[error("cancelled")]
    Cancelled,
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
            Error::Edit(error)
                if matches!(**error, EditError::NoSuchTier { .. } | EditError::NoSuchKey { .. }) =>
            {
                ErrorKind::NotFound
            }
            Error::Objective(ObjectiveError::NoSuchMetric(_) | ObjectiveError::NoSuchQuantity { .. }) => {
                ErrorKind::NotFound
            }
            Error::Score(_)
            | Error::Objective(_)
            | Error::Solid(_)
            | Error::Cut(_)
            | Error::Edit(_)
            | Error::Retarget(_)
            | Error::Setting(_) => ErrorKind::Invalid,
            Error::Cancelled => ErrorKind::Cancelled,
            #[cfg(feature = "search")]
            Error::Optimise(error) => match &**error {
                OptimiseError::Stone(error) => of_stone(error),
                OptimiseError::Edit(EditError::NoSuchTier { .. } | EditError::NoSuchKey { .. }) => {
                    ErrorKind::NotFound
                }
                _ => ErrorKind::Invalid,
            },
            #[cfg(feature = "files")]
            Error::Format(error) => of_format(error),
            #[cfg(feature = "files")]
            Error::Write(_) => ErrorKind::Io,
            #[cfg(feature = "render")]
            Error::Render(error) => of_render(error),
            #[cfg(feature = "report")]
            Error::Report(error) => match &**error {
                ReportError::Format(error) => of_format(error),
                ReportError::Stone(error) => of_stone(error),
                ReportError::Cancelled => ErrorKind::Cancelled,
                ReportError::Write(_) => ErrorKind::Io,
                _ => ErrorKind::Invalid,
            },
            #[cfg(feature = "files")]
            Error::Comparison(error) => match **error {
                ComparisonError::Cancelled => ErrorKind::Cancelled,
                _ => ErrorKind::Invalid,
            },
            #[cfg(feature = "files")]
            Error::Table(_) => ErrorKind::Invalid,
            #[cfg(feature = "files")]
            Error::Merge(error) => of_parts(error),
        }
    }
}

#[cfg(feature = "files")]
impl Error {
    /// What is known of the mesh, where a file was understood but holds no convex stone; none for every other failure.
    pub fn mesh_facts(&self) -> Option<MeshFacts> {
        match self {
            Error::Format(error) => error.mesh_facts(),
            Error::Stone(error) => error.mesh_facts(),
            _ => None,
        }
    }

    /// The file that could not be written, if that is what went wrong.
    pub fn not_written(&self) -> Option<&WriteError> {
        match self {
            Error::Write(error) | Error::Format(FormatError::Write(error)) => Some(error),
            Error::Merge(error) => match &**error {
                MergeError::Write(error) => Some(error),
                _ => None,
            },
            #[cfg(feature = "render")]
            Error::Render(RenderError::Write(error) | RenderError::PhotonMap(MapFileError::Write(error))) => {
                Some(error)
            }
            #[cfg(feature = "report")]
            Error::Report(error) => match &**error {
                ReportError::Write(error) => Some(error),
                _ => None,
            },
            _ => None,
        }
    }
}

impl From<EditScoreError> for Error {
    fn from(error: EditScoreError) -> Error {
        match error {
            EditScoreError::Stone(error) => error.into(),
            EditScoreError::Cancelled => Error::Cancelled,
        }
    }
}

impl From<AttributionError> for Error {
    fn from(error: AttributionError) -> Error {
        match error {
            AttributionError::Stone(error) => error.into(),
            AttributionError::Edit(error) => error.into(),
            AttributionError::Objective(error) => error.into(),
            AttributionError::Cancelled => Error::Cancelled,
        }
    }
}

impl From<RetargetError> for Error {
    fn from(error: RetargetError) -> Error {
        match error {
            RetargetError::Edit(error) => error.into(),
            error => Error::Retarget(Box::new(error)),
        }
    }
}

#[cfg(feature = "search")]
impl From<OptimiseError> for Error {
    fn from(error: OptimiseError) -> Error {
        Error::Optimise(Box::new(error))
    }
}

impl From<EditError> for Error {
    fn from(error: EditError) -> Error {
        Error::Edit(Box::new(error))
    }
}

impl From<StoneError> for Error {
    fn from(error: StoneError) -> Error {
        Error::Stone(Box::new(error))
    }
}

#[cfg(feature = "files")]
impl From<FindError> for Error {
    fn from(error: FindError) -> Error {
        StoneError::from(error).into()
    }
}

#[cfg(feature = "files")]
impl From<MergeError> for Error {
    fn from(error: MergeError) -> Error {
        Error::Merge(Box::new(error))
    }
}

#[cfg(feature = "report")]
impl From<ReportError> for Error {
    fn from(error: ReportError) -> Error {
        Error::Report(Box::new(error))
    }
}

#[cfg(feature = "files")]
impl From<ComparisonError> for Error {
    fn from(error: ComparisonError) -> Error {
        match error {
            ComparisonError::Stone(error) => error.into(),
            ComparisonError::Score(error) => error.into(),
            other => Error::Comparison(Box::new(other)),
        }
    }
}

#[cfg(feature = "files")]
impl From<TableJobError> for Error {
    fn from(error: TableJobError) -> Error {
        match error {
            TableJobError::Write(error) => error.into(),
            TableJobError::Table(error) => error.into(),
        }
    }
}

#[cfg(feature = "render")]
impl From<SceneError> for Error {
    fn from(error: SceneError) -> Error {
        Error::Render(error.into())
    }
}

#[cfg(feature = "render")]
impl From<MapFileError> for Error {
    fn from(error: MapFileError) -> Error {
        Error::Render(error.into())
    }
}

fn of_stone(error: &StoneError) -> ErrorKind {
    match error {
        #[cfg(feature = "files")]
        StoneError::Format(error) => of_format(error),
        #[cfg(feature = "files")]
        StoneError::Find(error) => of_search(error),
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

#[cfg(feature = "files")]
fn of_search(error: &FindError) -> ErrorKind {
    match error {
        FindError::Read { cause, .. } => of_reading(cause),
        FindError::NoMatch(_) => ErrorKind::NotFound,
        FindError::NotUtf8(_) | FindError::Broken(_) => ErrorKind::Invalid,
    }
}

#[cfg(feature = "files")]
fn of_parts(error: &MergeError) -> ErrorKind {
    match error {
        MergeError::Read { cause, .. } => of_reading(cause),
        MergeError::Write(_) => ErrorKind::Io,
        MergeError::Find(error) => of_search(error),
        MergeError::NoPart(_) | MergeError::Missing(..) => ErrorKind::NotFound,
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
fn of_render(error: &RenderError) -> ErrorKind {
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
