//! STONE arguments, one grammar wherever a stone is named, which [`crate::manual::stones`] has.

pub mod options;

use crate::design::design_file::DocumentError;
use crate::design::{Design, families, library};
use crate::formats::error::FormatError;
use crate::formats::{Loaded, read_regular, read_standard_input, read_within};
use crate::limits::Limits;
use crate::parse;
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::io::ErrorKind;
use std::path::Path;

/// The STONE that is read from standard input.
pub const STANDARD_INPUT: &str = "-";

/// Opens a stone: a library cut or family, with or without parameters, or a file of any format.
///
/// A library name wins over a file of that name, which `./name` reaches. Errors are one line and
/// suggest a cut whose name is near where there is neither. Checked in `tests/formats.rs`.
pub fn open(spec: impl AsRef<OsStr>) -> Result<Loaded, FormatError> {
    open_within(spec, Limits::default())
}

/// As [`open`], within limits that may be raised.
pub fn open_within(spec: impl AsRef<OsStr>, limits: Limits) -> Result<Loaded, FormatError> {
    let spec = spec.as_ref();
    if spec == STANDARD_INPUT {
        read_standard_input(limits)
    } else {
        open_by(spec, |path| read_within(path, limits))
    }
}

/// As [`open_within`], for a stone that a file names: only a regular file is read.
pub fn open_regular(spec: impl AsRef<OsStr>, limits: Limits) -> Result<Loaded, FormatError> {
    open_by(spec.as_ref(), |path| read_regular(path, limits))
}

fn open_by(
    argument: &OsStr,
    read: impl Fn(&Path) -> Result<Loaded, FormatError>,
) -> Result<Loaded, FormatError> {
    let path = Path::new(argument);
    // a name that is not UTF-8 is a file's
    let Some(spec) = argument.to_str() else { return read(path) };
    let (name, rest) = spec.split_once(':').map_or((spec, None), |(name, rest)| (name, Some(rest)));
    if let Some(name) = cut_name(spec) {
        let design = cut(name, &parameters(spec, rest)?)
            .map_err(|cause| FormatError::Cut { file: spec.into(), cause })?;
        return Ok(Loaded { design, format: "library", warnings: Vec::new() });
    }
    let missing = match std::fs::symlink_metadata(path) {
        Ok(_) => false,
        // what there is no right to look at may be there
        Err(e) => spec.is_empty() || e.kind() != ErrorKind::PermissionDenied,
    };
    if !missing {
        return read(path);
    }
    if let Some((why, nearest)) = library::impossible(name) {
        return Err(FormatError::Impossible { spec: spec.into(), why, nearest });
    }
    if spec.contains(['/', '\\']) || Path::new(name).extension().is_some() {
        return Err(FormatError::NoSuchFile { spec: spec.into() });
    }
    Err(FormatError::NoSuchStone { spec: spec.into(), nearest: library::nearest(name) })
}

/// The cut of the library or the family that a STONE names, as it is written in the catalogue; none
/// for a file.
///
/// A name in another case is that cut's too, unless there is a file of just that name.
pub fn cut_name(spec: &str) -> Option<&'static str> {
    let name = spec.split(':').next().unwrap_or_default();
    let cut = library::canonical_name(name)?;
    (cut == name || std::fs::symlink_metadata(spec).is_err()).then_some(cut)
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
    let mut last = "";
    for part in rest.unwrap_or_default().split(',').map(str::trim).filter(|p| !p.is_empty()) {
        let wrong = |why: String| FormatError::Parameter { spec: spec.into(), found: part.into(), why };
        let Some((key, value)) = part.split_once('=') else {
            let are_digits =
                part.bytes().all(|b| b.is_ascii_digit()) && last.ends_with(|c: char| c.is_ascii_digit());
            return Err(wrong(match are_digits {
                true => format!("write decimals with a point, as {last}.{part}"),
                false => "a parameter is written as key=number".into(),
            }));
        };
        let key = key.trim().to_lowercase();
        let value =
            parse::parse_number(value, families::parameter_unit(&key)).map_err(|e| wrong(e.to_string()))?;
        if key.is_empty() {
            return Err(wrong("its key is missing".into()));
        }
        if values.insert(key.clone(), value).is_some() {
            return Err(wrong(format!("{key} is given twice")));
        }
        last = part;
    }
    Ok(values)
}
