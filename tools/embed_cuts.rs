//! Build script: turns every `cuts/NAME.toml` into a (name, text) entry of the library, and gives
//! the program an identifier of the sources that it is built from.

use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};
use std::{env, fs};

/// What decides the numbers that a build computes: its sources, designs and dependencies.
const SOURCES: [&str; 4] = ["src", "cuts", "Cargo.toml", "Cargo.lock"];

fn main() {
    println!("cargo::rerun-if-changed=tools/embed_cuts.rs");
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").expect("cargo sets it"));
    embed_cuts(&root.join("cuts"));
    println!("cargo::rustc-env=CUTLAB_BUILD={}", build_id(&root));
}

/// Twelve hexadecimal digits of a SHA-256 over the names and contents of all [`SOURCES`]: the same on
/// every machine that builds them.
fn build_id(root: &Path) -> String {
    let mut digest = Sha256::new();
    for source in SOURCES.iter().filter(|s| root.join(s).exists()) {
        println!("cargo::rerun-if-changed={source}");
        for path in files(&root.join(source)) {
            let name = path.strip_prefix(root).expect("inside the package").display().to_string();
            let content = fs::read(&path).expect("a source can be read");
            for part in [name.replace('\\', "/").as_bytes(), &content] {
                digest.update((part.len() as u64).to_le_bytes());
                digest.update(part);
            }
        }
    }
    digest.finalize().iter().take(6).map(|byte| format!("{byte:02x}")).collect()
}

/// Every file at or below `path`, in the order of their names.
fn files(path: &Path) -> Vec<PathBuf> {
    if path.is_file() {
        return vec![path.to_owned()];
    }
    let entries = fs::read_dir(path).expect("a source folder can be listed");
    let mut entries: Vec<_> = entries.map(|entry| entry.expect("can be listed").path()).collect();
    entries.sort();
    entries.iter().flat_map(|entry| files(entry)).collect()
}

fn embed_cuts(folder: &Path) {
    let mut files: Vec<_> = fs::read_dir(folder)
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
