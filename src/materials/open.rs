//! Materials in files: opened by path, and told from the names of the catalogue.

use super::Material;
use crate::parse::data_file::DataFileError;
use crate::storage::{include, text};
use std::path::Path;

/// Whether a material's name is that of a file, whatever the catalogue has: it has a `/` or ends in `.toml`.
pub fn is_path(name: &str) -> bool {
    name.contains(['/', std::path::MAIN_SEPARATOR]) || name.to_lowercase().ends_with(".toml")
}

impl Material {
    /// The material in the file at `path`; the tables that it names lie in its folder or below.
    ///
    /// - `name`: how messages, tables and commands name the file
    /// - `regular`: whether only a regular file is read, as for one that a file names
    pub fn read(path: &Path, name: &str, regular: bool) -> Result<Material, DataFileError> {
        let file = text::display_name(name);
        let unreadable = |problem| DataFileError::Unreadable { file: file.clone(), problem };
        let content = include::read_text(path, regular).map_err(unreadable)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let material = Material::parse(&file, &content, &|table| include::read_table(folder, table))?;
        Ok(Material { file: Some(name.into()), ..material })
    }
}
