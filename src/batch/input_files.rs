//! Input files of a table: what they held when it was begun, and whether they still do.

use super::fingerprint::{FileDigest, Fingerprint};
use super::request::TableRequest;
use super::table_job::RowStatus;
use crate::limits::Limits;
use crate::materials::Material;
use crate::scoring::ScoreRow;
use crate::stone::StoneSpec;
use crate::stone::grammar::STANDARD_INPUT;
use std::collections::BTreeMap;
use std::ffi::{OsStr, OsString};
use std::path::PathBuf;

/// What a table is a function of.
pub struct InputFiles {
    /// In one word: the fingerprint of the request and of what its files hold.
    pub identity: String,
    /// The stones that are files, with what they held when the table was begun.
    files: BTreeMap<OsString, (PathBuf, FileDigest)>,
    limits: Limits,
}

impl InputFiles {
    /// Those of a table of these stones.
    pub fn new<'a>(request: &TableRequest, stones: impl Iterator<Item = &'a OsStr>) -> InputFiles {
        let limits = request.options().limits;
        let (mut identity, mut files) = (Fingerprint::of_request(request), BTreeMap::new());
        add_material(&mut identity, request.options().asked_material().ok().flatten().as_ref());
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

    /// The row of `stone`, unless its file has changed since the table was begun: the row is then not
    /// one of this table.
    pub fn checked(&self, stone: &OsStr, scored: (ScoreRow, RowStatus)) -> (ScoreRow, RowStatus) {
        let (mut row, outcome) = scored;
        let Some((file, held)) = self.files.get(stone) else { return (row, outcome) };
        let now = FileDigest::of_file(file, self.limits);
        let read_in_time = !now.is_readable() && row.scores.iter().any(Option::is_some);
        if now == *held || read_in_time {
            return (row, outcome);
        }
        let (what, outcome) = match now.is_readable() {
            true => ("was replaced", RowStatus::Failed),
            false => ("has vanished", RowStatus::IoError),
        };
        row.scores.fill(None);
        row.samples.clear();
        row.error = Some(format!("the file {what} since the table was begun: start again"));
        (row, outcome)
    }
}

/// Adds what the file of a user's material holds, tables beside it included.
fn add_material(identity: &mut Fingerprint, material: Option<&Material>) {
    if let Some(material) = material.filter(|m| m.file.is_some()) {
        identity.add(format!("{material:?}"));
    }
}
