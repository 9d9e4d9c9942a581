//! What a changed stone is written as: in its own file's format that file with the change in it, else anew.

use super::stone_report::ReportError;
use super::target_format::TargetFormat;
use crate::design::Design;
use crate::design::design_file::DesignFile;
use crate::formats::write_back::Change;
use crate::formats::{Encoded, Input};
use crate::limits::{FILE, Limits};
use crate::report::diagram::Paper;
use crate::stone::grammar::STANDARD_INPUT;
use crate::stone::{Stone, StoneSpec};
use crate::storage::text::display_name;
use crate::storage::{bounded_read, stdin};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// The name of cutlab's own format.
const TOML: &str = "toml";

/// The format that a changed stone has on a stream unless it is said.
pub fn usual_format(stone: &Stone) -> &'static str {
    let own = TargetFormat::by_name(stone.format());
    if own.is_ok() { stone.format() } else { TOML }
}

/// The bytes of a changed stone's file; what had no room in it is among the remarks.
///
/// - `spec`: the STONE; if it is a file of the target's format, the change goes back into that
/// - `changed`: the design of `stone`, changed
///
/// A design of a family, whose parameters alone changed, is written as such to cutlab's own format. Checked in
/// `tests/program/edit.rs`.
pub fn encode(
    spec: &OsStr,
    stone: &Stone,
    changed: &Design,
    target: TargetFormat,
    limits: Limits,
) -> Result<Encoded, ReportError> {
    let TargetFormat::Format(format) = target else {
        return target.encoded(changed, stone.given_material(), Paper::A4);
    };
    let mut changed = changed.clone();
    if let Some(material) = stone.given_material() {
        changed.refractive_index = changed.refractive_index.filter(|_| false).or(Some(material.index_d()));
    }
    if format.name == stone.format()
        && let Some((path, bytes)) = own_file(spec, limits)
    {
        let name = display_name(&path);
        let file = Input { name: &name, bytes: &bytes, folder: path.parent(), limits };
        let parameters = changed.family.as_ref().map(|family| family.given.clone()).unwrap_or_default();
        let change = Change { parameters, ..Change::new(&changed) };
        return Ok(change.write_back(&file)?);
    }
    if format.name == TargetFormat::by_name(TOML)?.format_name()
        && let Some(file) = DesignFile::of_family(&changed)
    {
        return Ok(Encoded { bytes: file.to_toml().into_bytes(), remarks: Vec::new() });
    }
    target.encoded(&changed, stone.given_material(), Paper::A4)
}
