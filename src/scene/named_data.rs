//! Materials and illuminants that a scene names: of the catalogues, or in files beside the scene.

use super::field_error::{FieldError, field_error, require_name};
use super::file_access::Files;
use crate::color::Illuminant;
use crate::color::illuminants::ILLUMINANTS;
use crate::limits::Limits;
use crate::materials::{MATERIALS, Material, is_path};
use std::path::PathBuf;
use std::sync::Arc;

/// The material called `name`.
pub(super) fn material(name: &str, files: &Files, limits: Limits) -> Result<Material, FieldError> {
    const KEY: &str = "material";
    if let Some(path) = file(KEY, name, Material::by_name(name).is_some(), files)? {
        return Material::read(&path, name, true, limits).map_err(|e| field_error(KEY, e.to_string()));
    }
    let all: Vec<&str> = MATERIALS.iter().map(|m| m.name.as_ref()).collect();
    require_name(KEY, Material::by_name(name), name, &all).cloned()
}

/// The illuminant called `name`; equal energy if there is no name.
pub(super) fn illuminant(
    key: &'static str,
    name: Option<&str>,
    files: &Files,
    limits: Limits,
) -> Result<Arc<Illuminant>, FieldError> {
    let Some(name) = name else { return Ok(Illuminant::equal_energy()) };
    if let Some(path) = file(key, name, Illuminant::by_name(name).is_some(), files)? {
        return Illuminant::read(&path, name, limits)
            .map(Arc::new)
            .map_err(|e| field_error(key, e.to_string()));
    }
    let all: Vec<&str> = ILLUMINANTS.iter().map(|i| i.name.as_ref()).collect();
    require_name(key, Illuminant::by_name(name), name, &all)
}

/// The file that a name stands for, if it does: a path always does, another name where the catalogue does not
/// have it and there is such a file.
fn file(key: &'static str, name: &str, is_known: bool, files: &Files) -> Result<Option<PathBuf>, FieldError> {
    if is_path(name) {
        return files.find(key, name).map(Some);
    }
    Ok(files.find(key, name).ok().filter(|path| !is_known && path.is_file()))
}
