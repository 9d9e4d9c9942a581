//! The folder of real designs and meshes.

use std::path::{Path, PathBuf};

/// `$CUTLAB_CORPUS`, or `../shared/corpus` beside the package. Where there is none, that is printed: the test has
/// nothing to check.
pub fn corpus() -> Option<PathBuf> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder =
        std::env::var_os("CUTLAB_CORPUS").map_or_else(|| here.join("../shared/corpus"), PathBuf::from);
    if !folder.join("geometry.csv").is_file() {
        println!("no corpus at {}: set CUTLAB_CORPUS; nothing was checked", folder.display());
        return None;
    }
    Some(folder)
}
