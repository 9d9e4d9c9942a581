//! The command and the request that a picture carries: what decides its bytes, and nothing else.

use crate::cli::limits::limits;
use crate::render::RenderRequest;
use crate::stone::StoneSpec;
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
        let bare = if arg.starts_with('-') { arg } else { bare(&arg) };
        said.push(if bare.contains(' ') { format!("'{bare}'") } else { bare });
    }
    said.join(" ")
}

/// The request with bare file names, as the command has them: a picture is the same wherever its files lie.
pub fn without_folders(request: &RenderRequest) -> RenderRequest {
    let mut request = request.clone();
    request.stones = request.stones.iter().map(|stone| bare(stone)).collect();
    request.scene = bare(&request.scene);
    request.options.material = request.options.material.map(|material| bare(&material));
    request.panorama = request.panorama.and_then(|path| path.file_name().map(Into::into));
    request.allow_outside = false;
    request
}

/// A path or a STONE without its folder; what a stone is made of stays.
fn bare(argument: &str) -> String {
    if !argument.contains('/') {
        return argument.into();
    }
    let Ok(spec) = StoneSpec::parse_within(argument, limits()) else { return argument.into() };
    let name = Path::new(spec.base()).file_name().unwrap_or(spec.base());
    spec.applied_to(name.into()).to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::Record;

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

    #[test]
    fn requests_are_the_same_wherever_files_lie() {
        let of = |stone: &str, scene: &str| {
            let mut request = RenderRequest::default().stones([stone]).panorama(format!("{stone}.exr"));
            request.scene = scene.into();
            Record::of_request("", &without_folders(&request))
        };
        assert_eq!(of("/home/me/a.asc", "x/b.toml"), of("a.asc", "b.toml"));
        assert_ne!(of("/home/me/a.asc", "x/b.toml"), of("a.asc", "c.toml"));
    }
}
