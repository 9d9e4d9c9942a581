//! Arguments that name a material: one of the catalogue, or a file of the user's.

use crate::materials::{MATERIALS, Material, open};
use crate::parse;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Mutex;

/// Value parser of `--material`.
///
/// A file is read once and kept for the rest of the process: all stones of a command are of one material,
/// whatever becomes of the file meanwhile.
pub fn material(argument: &str) -> Result<&'static Material, String> {
    static READ: Mutex<BTreeMap<String, &'static Material>> = Mutex::new(BTreeMap::new());
    if !open::is_path(argument) {
        if let Some(material) = Material::by_name(argument) {
            return Ok(material);
        }
        if !Path::new(argument).is_file() {
            let near = parse::nearest_name(argument, MATERIALS.iter().map(|m| m.name.as_ref()));
            let near = parse::did_you_mean(near);
            return Err(format!("no material is called '{argument}'{near} (all: cutlab list materials)"));
        }
    }
    let read = || Material::read(Path::new(argument), argument, false).map_err(|e| e.to_string());
    let Ok(mut known) = READ.lock() else { return Ok(Box::leak(Box::new(read()?))) };
    if let Some(material) = known.get(argument) {
        return Ok(material);
    }
    let material: &'static Material = Box::leak(Box::new(read()?));
    known.insert(argument.to_owned(), material);
    Ok(material)
}
