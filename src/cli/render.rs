//! `cutlab render`: a photon-mapped picture of a stone, or an animation.

mod choices;
mod command;
mod default_name;
mod options;
mod stones;

use super::args::stone;
use super::console::Console;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::interrupt;
use super::outputs::Outputs;
use super::progress::BarProgress;
use crate::batch::fingerprint::Fingerprint;
use crate::cli::limits::limits;
use crate::integrators::image_io::Provenance;
use crate::photons::map_file;
use crate::render::{self, OutputTarget, Record, request};
use crate::storage::atomic_write;
pub use options::RenderArgs;
use std::path::Path;

/// Takes the picture or pictures.
pub fn run(args: &RenderArgs, console: &Console) -> Result<ExitStatus, CliError> {
    let file = request::open_scene(&args.scene, limits())?;
    let output = args.output.clone().unwrap_or_else(|| default_name::default_name(args, &file).into());
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
    request.opened = stones::open(args, console)?;
    let scene = request.build(&file, size)?;
    // what another version made, or was made of files that have changed since, is of no use
    let asked = Fingerprint::of_request(&request).hex();
    let identity = format!("request {asked}, scene {:08x}", map_file::checksum(&scene));
    let is_kept = args.frames.is_some() || (args.stops.progressive && !atomic_write::is_stream(&output));
    if is_kept {
        interrupt::mark_resumable();
    }
    let made = Provenance { identity: Some(&identity), ..record.provenance() };
    let progress = BarProgress::new(console);
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

/// `--glare 8`: the number counts as a STONE.
fn glare_without_equals(args: &RenderArgs) -> Option<String> {
    let number = args.stones.iter().filter_map(|s| s.to_str()).find(|s| s.parse::<f32>().is_ok())?;
    args.glare.is_some().then(|| format!("--glare takes its number after '=': --glare={number}"))
}
