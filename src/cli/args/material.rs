//! Arguments that name a material: one of the catalogue, or a file of the user's.

use crate::cli::limits::limits;
use crate::materials::Material;

/// Value parser of `--material`.
///
/// A file is read once: all stones of a command are of one material, whatever becomes of the file meanwhile.
pub fn material(argument: &str) -> Result<Material, String> {
    Material::open(argument, limits())
}
