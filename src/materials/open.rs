//! Materials in files: opened by path, and told from the names of the catalogue.

use super::Material;
use crate::limits::Limits;
use crate::parse::data_file::DataFileError;
use crate::parse::display_name;
use crate::storage::include;
use std::path::Path;

impl Material {
    /// The material in the file at `path`; the tables that it names lie in its folder or below.
    ///
    /// - `name`: how messages, tables and commands name the file
    /// - `regular`: whether only a regular file is read, as for one that a file names
    pub fn read(path: &Path, name: &str, regular: bool, limits: Limits) -> Result<Material, DataFileError> {
        let file = display_name(name);
        let unreadable = |problem| DataFileError::Unreadable { file: file.clone(), problem };
        let content = include::read_text(path, regular, limits).map_err(unreadable)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let material = Material::parse(&file, &content, &|table| include::read_table(folder, table, limits))?;
        Ok(Material { file: Some(name.into()), ..material })
    }
}
