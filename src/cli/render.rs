//! `cutlab render`: a photon-mapped picture of a stone, or an animation.

mod choices;
mod command;
mod options;
mod progress;

use super::args::stone;
use super::console::Console;
use super::exit_code::{self, CliError, ExitStatus};
use super::outputs::Outputs;
use crate::batch::fingerprint::Fingerprint;
use crate::cli::limits::limits;
use crate::design::USUAL_WIDTH_MM;
use crate::integrators::image_io::Provenance;
use crate::photons::map_file;
use crate::render::{self, OutputTarget, Record, request};
use crate::scene::SceneFile;
use crate::stone::{Stone, StoneSpec, grammar};
use crate::storage::atomic_write;
pub use options::RenderArgs;
use progress::PictureProgress;
use std::ffi::{OsStr, OsString};
use std::path::Path;

/// Takes the picture or pictures.
pub fn run(args: &RenderArgs, console: &Console) -> Result<ExitStatus, CliError> {
    let file = request::open_scene(&args.scene, limits())?;
    let output = args.output.clone().unwrap_or_else(|| default_name(args, &file).into());
    let target = OutputTarget::new(&output, args.frames.is_some(), args.passes)?;
    let mut request = args.request();
    let photon_map = args.photon_map.as_deref();
    let conflict =
        glare_without_equals(args).or_else(|| render::first_conflict(&request, &target, photon_map, &file));
    if let Some(problem) = conflict {
        return Err(CliError::input(problem));
    }
    let size = request.picture_size(&file, target.kind())?;
    let mut outputs = Outputs::reading_stones(&args.stones, console);
    outputs.reads(Path::new(&args.scene));
    file.files().iter().chain(&args.hdr).for_each(|read| outputs.reads(read));
    let record = Record::of_request(command::normalised(), &command::without_folders(&request));
    if let Some(map) = photon_map {
        outputs.claim(map, |_| true)?; // a map that is another's is refused by its reader
    }
    for file in target.files(args.frames, args.passes) {
        outputs.claim(&file, |there| record.matches(there))?;
    }
    request.opened = open_stones(args, console)?;
    let scene = request.build(&file, size)?;
    // what another version made, or was made of files that have changed since, is of no use
    let asked = Fingerprint::of_request(&request).hex();
    let identity = format!("request {asked}, scene {:08x}", map_file::checksum(&scene));
    let is_kept = args.frames.is_some() || (args.stops.progressive && !atomic_write::is_stream(&output));
    if is_kept {
        exit_code::mark_resumable();
    }
    let made = Provenance { identity: Some(&identity), ..record.provenance() };
    let progress = PictureProgress::new(console);
    let files =
        render::to_files(&request, (&scene, size), &target, (photon_map, args.passes), made, &progress)?;
    if atomic_write::is_stdout(&output) {
        return Ok(ExitStatus::Done); // the picture is the whole of what standard output gets
    }
    if console.json {
        console.print_json(&files.iter().map(stone::display_name).collect::<Vec<_>>())?;
    } else {
        files.iter().for_each(|f| console.note(&format!("wrote {}", stone::display_name(f))));
    }
    Ok(ExitStatus::Done)
}

/// A name that tells the stones with their parameters, what they are made of, their size and the scene:
/// pictures of different things have different names.
fn default_name(args: &RenderArgs, file: &SceneFile) -> OsString {
    let first = args.stones.is_empty().then(|| file.first_cut()).flatten();
    let stones = args.stones.iter().map(OsString::as_os_str).chain(first.map(OsStr::new));
    let mut parts: Vec<OsString> = stones.map(stone_name).collect();
    parts.extend(args.stone_args.material.as_ref().map(|m| m.name.as_ref().into()));
    parts.extend(args.stone_args.ri.map(|n| format!("n{n}").into()));
    parts.extend(args.size.map(|mm| format!("{mm}mm").into()));
    parts.push(file.name.clone().into());
    let mut name = parts.join(OsStr::new("-"));
    name.push(if args.frames.is_some() { ".gif" } else { ".png" });
    name
}

/// `round-brilliant:table=60` as `round-brilliant-table60`, `D.asc:material=topaz` as `D-materialtopaz`.
fn stone_name(spec: &OsStr) -> OsString {
    let text = spec.to_str().filter(|_| grammar::is_cut(spec));
    let parameters = text.and_then(|text| text.split_once(':')).map(|(_, rest)| rest.to_owned());
    let of_file = || {
        StoneSpec::parse_within(spec, limits()).map_or_else(|_| String::new(), |spec| spec.own().join(","))
    };
    let given = parameters.unwrap_or_else(of_file);
    let fit = |c: char| c.is_alphanumeric() || c == '.' || c == '-';
    let told = given.split(',').map(|p| p.chars().filter(|c| fit(*c)).collect::<String>());
    let told = told.filter(|p| !p.is_empty()).map(OsString::from);
    std::iter::once(grammar::file_stem(spec)).chain(told).collect::<Vec<_>>().join(OsStr::new("-"))
}

/// The stones, opened, with what is to be said of them.
fn open_stones(args: &RenderArgs, console: &Console) -> Result<Vec<Stone>, CliError> {
    let open = |spec: &OsString| {
        let stone = Stone::open(spec, &args.stone_args.options(args.size))?;
        stone.warnings().iter().for_each(|w| console.note(&format!("note: {w}")));
        if stone.given_material().is_none() && stone.material().bare_index().is_some() {
            let why = stone.material().no_dispersion();
            console.note_of_one(
                &format!("{}: a picture without fire and colour, for {why}", stone.name()),
                &why,
            );
        }
        if stone.lacks_size() {
            console.note(&format!(
                "note: {} has no size, which its colour depends on: taken as {USUAL_WIDTH_MM} mm wide; --size MM sets it",
                stone.convex_design()?.name
            ));
        }
        Ok(stone.with_width_for_colour()?)
    };
    args.stones.iter().map(open).collect()
}

/// `--glare 8`: the number counts as a STONE.
fn glare_without_equals(args: &RenderArgs) -> Option<String> {
    let number = args.stones.iter().filter_map(|s| s.to_str()).find(|s| s.parse::<f32>().is_ok())?;
    args.glare.is_some().then(|| format!("--glare takes its number after '=': --glare={number}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_parameters() {
        assert_eq!(stone_name(OsStr::new("round-brilliant")), "round-brilliant");
        assert_eq!(
            stone_name(OsStr::new("round-brilliant:table=60, crown-angle=34.5")),
            "round-brilliant-table60-crown-angle34.5"
        );
        // a file's own name is no parameter: all of it tells
        assert_eq!(stone_name(OsStr::new("designs/my:stone=1.asc")), "my:stone=1");
    }
}
