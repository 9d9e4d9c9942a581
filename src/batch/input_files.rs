//! Input files of a request: what they held when the work was begun, and whether they still do.

use super::fingerprint::{FileDigest, Fingerprint};
use super::table_job::RowStatus;
use crate::limits::Limits;
use crate::materials::Material;
use crate::scoring::ScoreRow;
use crate::stone::grammar::STANDARD_INPUT;
use crate::stone::{StoneOptions, StoneSpec};
use serde::Serialize;
use std::collections::BTreeMap;
use std::ffi::{OsStr, OsString};
use std::path::PathBuf;

/// What a table or a report is a function of.
pub struct InputFiles {
    /// In one word: the fingerprint of the request and of what its files hold.
    pub identity: String,
    /// The stones that are files, with what they held when the work was begun.
    files: BTreeMap<OsString, (PathBuf, FileDigest)>,
    limits: Limits,
}

impl InputFiles {
    /// Those of a request.
    ///
    /// - `options`: of the request; a material in a file is read
    /// - `stones`: those of the request, one by one
    pub fn new<'a>(
        request: &impl Serialize,
        options: &StoneOptions,
        stones: impl IntoIterator<Item = &'a OsStr>,
    ) -> InputFiles {
        let limits = options.limits;
        let (mut identity, mut files) = (Fingerprint::of_request(request), BTreeMap::new());
        add_material(&mut identity, options.asked_material().ok().flatten().as_ref());
        for stone in stones {
            identity.add(stone.as_encoded_bytes());
            let parts = StoneSpec::parse_within(stone, limits).ok();
            add_material(&mut identity, parts.as_ref().and_then(StoneSpec::material));
            if stone == STANDARD_INPUT {
                identity.add_file(&FileDigest::of_standard_input(limits));
            }
            if let Some(file) = parts.and_then(|parts| parts.file()) {
                let held = FileDigest::of_file(&file, limits);
                identity.add_file(&held);
                files.insert(stone.to_owned(), (file, held));
            }
        }
        InputFiles { identity: identity.hex(), files, limits }
    }

    /// What has become of the file of `stone` since; none if it holds what it held, or the stone is no file.
    pub fn change_of(&self, stone: &OsStr) -> Option<FileChange> {
        let (file, held) = self.files.get(stone)?;
        let now = FileDigest::of_file(file, self.limits);
        let changed = if now.is_readable() { FileChange::Replaced } else { FileChange::Vanished };
        (now != *held).then_some(changed)
    }

    /// The row of `stone`, unless its file has changed since the table was begun: the row is then not
    /// one of this table.
    pub fn checked(&self, stone: &OsStr, scored: (ScoreRow, RowStatus)) -> (ScoreRow, RowStatus) {
        let (mut row, outcome) = scored;
        let Some(change) = self.change_of(stone) else { return (row, outcome) };
        let (what, outcome) = match change {
            FileChange::Replaced => ("was replaced", RowStatus::Failed),
            // it was read in time
            FileChange::Vanished if row.scores.iter().any(Option::is_some) => return (row, outcome),
            FileChange::Vanished => ("has vanished", RowStatus::IoError),
        };
        row.scores.fill(None);
        row.samples.clear();
        row.error = Some(format!("the file {what} since the table was begun: start again"));
        (row, outcome)
    }
}

/// What may become of a file while work goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileChange {
    /// It holds something else.
    Replaced,
    /// It cannot be read any more.
    Vanished,
}

/// Adds what the file of a user's material holds, tables beside it included.
fn add_material(identity: &mut Fingerprint, material: Option<&Material>) {
    if let Some(material) = material.filter(|m| m.file.is_some()) {
        identity.add(format!("{material:?}"));
    }
}
