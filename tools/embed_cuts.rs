//! Build script: turns every `cuts/NAME.toml` into a (name, text) entry of the library.

use std::path::Path;
use std::{env, fs};

fn main() {
    println!("cargo::rerun-if-changed=cuts");
    println!("cargo::rerun-if-changed=tools/embed_cuts.rs");
    let root = env::var("CARGO_MANIFEST_DIR").expect("cargo sets it");
    let folder = Path::new(&root).join("cuts");
    let mut files: Vec<_> = fs::read_dir(&folder)
        .expect("cuts/ is part of the package")
        .map(|entry| entry.expect("cuts/ can be listed").path())
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .collect();
    files.sort();
    let mut code = String::from(
        "/// Every cut: its name and its TOML text.\nstatic EMBEDDED_CUTS: &[(&str, &str)] = &[\n",
    );
    for path in &files {
        let text = fs::read_to_string(path).expect("a cut is UTF-8");
        if let Err(error) = toml::from_str::<toml::Table>(&text) {
            panic!("{}: {error}", path.display());
        }
        let name = path.file_stem().expect("has a name").to_string_lossy();
        code += &format!("    ({name:?}, include_str!({:?})),\n", path.display().to_string());
    }
    code += "];\n";
    fs::write(Path::new(&env::var("OUT_DIR").expect("cargo sets it")).join("embedded_cuts.rs"), code)
        .expect("the build folder can be written");
}
