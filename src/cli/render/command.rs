//! The command that a picture carries: what decides its bytes, and nothing else.

use std::path::Path;

/// Options, with a value, that do not change a picture.
const SILENT: [&str; 5] = ["-o", "--output", "--photon-map", "-j", "--threads"];
/// The same without a value.
const SILENT_FLAGS: [&str; 6] = ["-q", "--quiet", "--json", "--passes", "--force", "--allow-outside"];

/// The process's command line without output names; paths are bare file names.
pub fn normalised() -> String {
    normalise(std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned()))
}

fn normalise(args: impl Iterator<Item = String>) -> String {
    let mut said = vec!["cutlab".to_string()];
    let mut args = args.peekable();
    while let Some(arg) = args.next() {
        let name = arg.split('=').next().unwrap_or_default();
        if SILENT.contains(&name) {
            if !arg.contains('=') {
                args.next();
            }
            continue;
        }
        let with_value = arg.starts_with("-o") || arg.starts_with("-j");
        if with_value || SILENT_FLAGS.contains(&arg.as_str()) {
            continue;
        }
        let bare = if arg.contains('/') && !arg.starts_with('-') {
            Path::new(&arg).file_name().map_or(arg.clone(), |n| n.to_string_lossy().into_owned())
        } else {
            arg
        };
        said.push(if bare.contains(' ') { format!("'{bare}'") } else { bare });
    }
    said.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_outputs_and_folders_are_left_out() {
        let said = |line: &str| normalise(line.split(' ').map(String::from));
        let plain = "cutlab render stone.asc --scene table --spp 4";
        for line in [
            "render /home/me/stone.asc --scene table --spp 4 -o a.png",
            "render stone.asc --scene table --photon-map x.map --spp 4 --output=b.png -q",
            "render ../stone.asc -oc.png --scene table --spp 4 --json",
            "render stone.asc -j2 --scene table --threads=3 --spp 4 -j 4",
        ] {
            assert_eq!(said(line), plain);
        }
    }
}
