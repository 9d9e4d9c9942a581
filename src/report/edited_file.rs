//! What a changed stone is written as: in its own file's format that file with the change in it, else anew.

use super::diagram::Paper;
use super::stone_report::ReportError;
use super::target_format::TargetFormat;
use crate::design::Design;
use crate::design::design_file::DesignFile;
use crate::formats::write_back::Change;
use crate::formats::{Encoded, Input};
use crate::limits::{FILE, Limits};
use crate::materials::Material;
use crate::stone::grammar::STANDARD_INPUT;
use crate::stone::{Stone, StoneSpec};
use crate::storage::text::display_name;
use crate::storage::{bounded_read, stdin};
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::PathBuf;

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
/// - `stone`: as it was
/// - `changed`: its design, changed
/// - `material`: what it is of, if that was asked for
///
/// A design of a family, of which parameters alone changed, is written as such to cutlab's own format. Checked in
/// `tests/program/edit.rs`.
pub fn encode(
    (spec, stone): (&OsStr, &Stone),
    changed: &Design,
    material: Option<&Material>,
    target: TargetFormat,
    limits: Limits,
) -> Result<Encoded, ReportError> {
    let TargetFormat::Format(format) = target else {
        return target.encoded(changed, material, Paper::A4);
    };
    if format.name == stone.format()
        && is_facet_by_facet(stone, changed)
        && let Some((path, bytes)) = own_file(spec, limits)
    {
        let mut changed = changed.clone();
        if let Some(material) = material {
            changed.refractive_index = Some(material.index_d());
        }
        let name = display_name(&path);
        let file = Input { name: &name, bytes: &bytes, folder: path.parent(), limits };
        let change = Change { parameters: new_parameters(stone, &changed), ..Change::new(&changed) };
        return Ok(change.write_back(&file)?);
    }
    match family_file(changed, material).filter(|_| format.extensions.contains(&TOML)) {
        Some(file) => Ok(Encoded { bytes: file.to_toml().into_bytes(), remarks: Vec::new() }),
        None => target.encoded(changed, material, Paper::A4),
    }
}

/// Whether the facets stand for those of the file, each with its angle: a stone that was turned has none.
fn is_facet_by_facet(stone: &Stone, changed: &Design) -> bool {
    let same = |was: &Design| was.facets().count() == changed.facets().count();
    stone.design().is_some_and(same) && changed.tiers.iter().any(|tier| tier.angle_deg.is_some())
}

/// The file that a STONE names, or standard input, and what it holds.
fn own_file(spec: &OsStr, limits: Limits) -> Option<(PathBuf, Vec<u8>)> {
    let spec = StoneSpec::parse_within(spec, limits).ok()?;
    if spec.base() == STANDARD_INPUT {
        return Some((PathBuf::from("standard input"), stdin::bytes(limits).ok()?.ok()?));
    }
    let path = spec.file()?;
    let bytes = bounded_read::read(&path, limits, &FILE).ok()?.ok()?;
    Some((path, bytes))
}

/// The parameters of the family that are not as they were.
fn new_parameters(stone: &Stone, changed: &Design) -> BTreeMap<String, f64> {
    let was = |key: &String| stone.design()?.family.as_ref()?.given.get(key).copied();
    let given = changed.family.iter().flat_map(|family| family.given.clone());
    given.filter(|(key, value)| was(key) != Some(*value)).collect()
}

/// The design file of a family with its parameters and the index of what it is of; none of a design that is not
/// a family's any more.
fn family_file(design: &Design, material: Option<&Material>) -> Option<DesignFile> {
    let family = design.family.as_ref()?;
    Some(DesignFile {
        name: design.name.clone(),
        source: design.source.clone(),
        refractive_index: material.map(Material::index_d).or(design.refractive_index),
        family: Some(family.name.clone()),
        parameters: family.given.clone(),
        ..DesignFile::default()
    })
}
