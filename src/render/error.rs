//! The error of a picture that cannot be taken or written.

use crate::integrators::image_io::EncodeError;
use crate::photons::map_file::MapFileError;
use crate::scene::SceneError;
use crate::stone::StoneError;
use crate::storage::atomic_write::WriteError;

/// A picture that could not be taken or written.
///
/// ```
/// use cutlab::{RenderError, RenderRequest};
///
/// assert!(matches!(RenderRequest::scene("beach"), Err(RenderError::Request(_))));
/// ```
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// A request that cannot be carried out, and what to do instead.
    #[error("{0}")]
    Request(String),
    /// A stone that could not be opened.
    #[error(transparent)]
    Stone(Box<StoneError>),
    /// A scene that could not be read or built.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A photon map that could not be read or written.
    #[error(transparent)]
    PhotonMap(#[from] MapFileError),
    /// A picture that does not fit into its format.
    #[error(transparent)]
    Encode(#[from] EncodeError),
    /// A file that could not be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// The work was ended early by [`crate::progress::Progress::is_cancelled`].
    #[error("cancelled")]
    Cancelled,
}

impl From<StoneError> for RenderError {
    fn from(error: StoneError) -> RenderError {
        RenderError::Stone(Box::new(error))
    }
}
