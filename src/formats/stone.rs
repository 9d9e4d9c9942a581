//! The one grammar for stones, wherever cutlab is told one: `round-brilliant`,
//! `round-brilliant:crown-angle=35,table=57`, or a file.

use super::error::FormatError;
use super::{Imported, read, read_regular};
use crate::cut::document::DocumentError;
use crate::cut::{Design, families, library};
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::Path;

/// Opens a stone: a library cut or family, with or without parameters, or a file of any format.
///
/// A library name wins over a file of that name, which `./name` reaches. Errors are one line and
/// name the nearest cut where there is neither. Checked in `tests/formats.rs`.
pub fn open(spec: impl AsRef<OsStr>) -> Result<Imported, FormatError> {
    open_by(spec.as_ref(), read)
}

/// As [`open`], for a stone that a file names: only a regular file is read.
pub fn open_regular(spec: impl AsRef<OsStr>) -> Result<Imported, FormatError> {
    open_by(spec.as_ref(), read_regular)
}

fn open_by(
    argument: &OsStr,
    read: fn(&Path) -> Result<Imported, FormatError>,
) -> Result<Imported, FormatError> {
    let path = Path::new(argument);
    // a name that is not UTF-8 is a file's
    let Some(spec) = argument.to_str() else { return read(path) };
    let (name, rest) = spec.split_once(':').map_or((spec, None), |(name, rest)| (name, Some(rest)));
    let known = library::names().any(|n| n == name) || families::FAMILIES.iter().any(|f| f.name == name);
    if known {
        let design = cut(name, &parameters(spec, rest)?)
            .map_err(|cause| FormatError::Cut { file: spec.into(), cause })?;
        return Ok(Imported { design, format: "library", warnings: Vec::new() });
    }
    if !spec.is_empty() && std::fs::symlink_metadata(path).is_ok() {
        return read(path);
    }
    if let Some((why, nearest)) = library::impossible(name) {
        return Err(FormatError::Impossible { spec: spec.into(), why, nearest });
    }
    Err(FormatError::NoSuchStone { spec: spec.into(), nearest: library::nearest(name) })
}

fn cut(name: &str, values: &BTreeMap<String, f64>) -> Result<Design, DocumentError> {
    library::design(name, values).unwrap_or_else(|| Ok(families::build(name, values)?))
}

/// The parameters in what stands behind the colon of a STONE.
pub fn parameters_of(items: &str) -> Result<BTreeMap<String, f64>, FormatError> {
    parameters(items, Some(items))
}

/// `key=value,key=value`; nothing after the colon is no parameter.
fn parameters(spec: &str, rest: Option<&str>) -> Result<BTreeMap<String, f64>, FormatError> {
    let mut values = BTreeMap::new();
    for part in rest.unwrap_or_default().split(',').map(str::trim).filter(|p| !p.is_empty()) {
        let wrong = || FormatError::Parameter { spec: spec.into(), found: part.into() };
        let (key, value) = part.split_once('=').ok_or_else(wrong)?;
        let value: f64 = value.trim().parse().map_err(|_| wrong())?;
        if key.trim().is_empty() || values.insert(key.trim().to_owned(), value).is_some() {
            return Err(wrong());
        }
    }
    Ok(values)
}
