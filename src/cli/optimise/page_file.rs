//! The page of `cutlab optimise -o FOLDER`.

use crate::cli::error::CliError;
use crate::cli::outputs::Outputs;
use crate::optimise::OptimiseRequest;
use crate::progress::Progress;
use crate::render::{Record, record};
use crate::report::optimised_page::{OptimisedPage, USUAL_SIDE};
use crate::storage::atomic_write;
use std::path::{Path, PathBuf};

/// Where the page goes, and what it is made by.
pub struct OptimisedPageFile {
    path: PathBuf,
    /// Pixels across each picture.
    side: u32,
    record: Record,
}

impl OptimisedPageFile {
    /// Of what was asked for; none without a folder.
    ///
    /// - `width`: pixels across each picture, if somebody says
    /// - `made_by`: request and identity of the optimisation
    pub fn new(
        folder: Option<&Path>,
        width: Option<u32>,
        made_by: (&OptimiseRequest, &str),
    ) -> Result<Option<OptimisedPageFile>, CliError> {
        match (folder, width) {
            (None, Some(_)) => {
                Err(CliError::input("--width is of the pictures of a page: -o FOLDER writes one"))
            }
            (None, None) => Ok(None),
            (Some(folder), width) => Ok(Some(OptimisedPageFile {
                path: folder.join("index.html"),
                side: width.unwrap_or(USUAL_SIDE),
                record: Record::of_request(record::own_command(), &(made_by, width)),
            })),
        }
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Takes the place of the file.
    ///
    /// - `is_begun`: whether the same optimisation was begun or made there; a page of it is replaced if its
    ///   pictures were as large
    pub fn claim(&self, is_begun: bool, outputs: &mut Outputs) -> Result<(), CliError> {
        outputs.claim(&self.path, |there| is_begun && self.record.matches(there))
    }

    /// Makes the page and writes it.
    pub fn write(&self, page: OptimisedPage, progress: &dyn Progress) -> Result<(), CliError> {
        let page = OptimisedPage { command: self.record.command.clone(), side: self.side, ..page };
        let text = self.record.in_markup(page.html(progress)?);
        Ok(atomic_write::write(&self.path, text.as_bytes())?)
    }
}
