//! One picture, or the frames of an animation, to files. An animation that was interrupted goes on at
//! the first frame that is missing.
//!
//! A frame says in its `Command` what it was made by and from; one process at a time makes an animation.
//! Frames of a film wait as PNG in a hidden folder and are read back one by one when all are there, so
//! that memory holds one of them.

use super::picture::{self, PictureFile, PictureProgress};
use super::target::{OutputLock, OutputTarget, PictureKind};
use super::{RenderArgs, command};
use crate::batch::fingerprint::BUILD;
use crate::cli::console::Console;
use crate::cli::exit_code::CliError;
use crate::cli::outputs::record;
use crate::integrators::animation::{self, FrameTiming, Turn};
use crate::integrators::image_io::{EncodeError, Provenance};
use crate::integrators::{PhotonMaps, RenderSettings, mp4};
use crate::photons::map_file;
use crate::scene::Scene;
use crate::storage::atomic_write::{self, WriteError};
use std::io::Write;
use std::path::PathBuf;

/// Takes one picture, or all frames that are not there yet; returns the files.
pub fn render(
    args: &RenderArgs,
    scene: &Scene,
    settings: RenderSettings,
    target: &OutputTarget,
    console: &Console,
) -> Result<Vec<PathBuf>, CliError> {
    let command = command::normalised();
    // what another version made, or was made of files that have changed since, is of no use
    let identity =
        format!("{command} # {} {BUILD}, scene {:08x}", env!("CARGO_PKG_VERSION"), map_file::checksum(scene));
    match args.frames {
        None => one(args, scene, settings, target, (&command, &identity), console),
        Some(frames) => all(args, scene, settings, target, frames, &identity, console),
    }
}

fn one(
    args: &RenderArgs,
    scene: &Scene,
    mut settings: RenderSettings,
    target: &OutputTarget,
    (command, identity): (&str, &str),
    console: &Console,
) -> Result<Vec<PathBuf>, CliError> {
    let goes_on = args.stops.progressive && !atomic_write::is_stream(target.path());
    let alone = if goes_on || target.has_leftovers() { Some(target.lock(goes_on, console)?) } else { None };
    let progress = PictureProgress::Single(console);
    let mut maps = None;
    settings.tone.stops = picture::exposure(args, scene, &mut maps, &settings, &progress)?;
    let mut file = PictureFile::new(args, target.path(), target.kind(), command);
    picture::render(scene, maps, &settings, &mut file, identity, &progress)?;
    alone.map_or(Ok(()), OutputLock::ends)?;
    Ok(file.written)
}

fn all(
    args: &RenderArgs,
    scene: &Scene,
    mut settings: RenderSettings,
    target: &OutputTarget,
    frames: u32,
    command: &str,
    console: &Console,
) -> Result<Vec<PathBuf>, CliError> {
    let alone = target.lock(true, console)?;
    let alpha = scene.cut_out && picture::is_transparent(args);
    let pixels = settings.width * settings.height;
    let finished = |number| target.finished(number, (args.passes, alpha), command, pixels);
    let bar = console.progress((frames * settings.height) as usize, "frames");
    // where only the camera moves, the light stands still
    let still = args.turn == Turn::Camera;
    let mut kept: Option<PhotonMaps> = None;
    let mut stops = None;
    let mut files = Vec::new();
    for frame in 0..frames {
        let path = target.frame(frame);
        let progress = PictureProgress::Frame { console, bar: &bar, frame, frames };
        if finished(frame).is_some() {
            files.extend(PictureFile::new(args, &path, target.kind(), command).names());
            bar.set_position(u64::from(frame + 1) * u64::from(settings.height));
            bar.reset_eta();
            continue;
        }
        // the exposure is that of the scene at rest, for every frame alike
        if stops.is_none() {
            stops = Some(picture::exposure(args, scene, &mut kept, &settings, &progress)?);
        }
        settings.tone.stops = stops.unwrap_or_default();
        let moved = animation::scene_at(scene, args.turn, args.rock, frame, frames);
        let maps = if still { kept.take() } else { None };
        let mut file = PictureFile::new(args, &path, target.kind(), command);
        kept = picture::render(&moved, maps, &settings, &mut file, command, &progress)?;
        bar.set_position(u64::from(frame + 1) * u64::from(settings.height));
        files.extend(file.written);
    }
    bar.finish_and_clear();
    if target.kind().is_film() {
        let sign = console.spinner("putting the frames together");
        let mut pictures = (0..frames).map(|n| finished(n).ok_or(EncodeError::Frame(n)));
        let film = AnimationFrames { size: (settings.width, settings.height), frames, alpha, args, command };
        atomic_write::stream(target.path(), |out| {
            let fail = |error| WriteError { path: target.path().into(), cause: io_error(error) };
            film.write(target.kind(), &mut pictures, out).map_err(fail)
        })?;
        sign.finish_and_clear();
        files = vec![target.path().into()];
    }
    alone.ends()?;
    Ok(files)
}

/// An animation in one file.
struct AnimationFrames<'a> {
    size: (u32, u32),
    frames: u32,
    alpha: bool,
    args: &'a RenderArgs,
    command: &'a str,
}

impl AnimationFrames<'_> {
    fn write(
        &self,
        kind: PictureKind,
        pictures: &mut animation::Frames,
        out: &mut dyn Write,
    ) -> Result<(), EncodeError> {
        let pace = self.args.fps.map_or_else(|| FrameTiming::of_turn(self.frames), FrameTiming::of_rate);
        let made = Provenance { command: self.command, rounds: None };
        let record = record::behind(&command::normalised());
        match kind {
            PictureKind::Gif => {
                animation::gif(pictures, self.size, pace, out)?;
                Ok(out.write_all(record.as_bytes())?)
            }
            PictureKind::Mp4 => {
                mp4::mp4(pictures, self.size, pace, made, out)?;
                // a box that players pass over
                let length = (record.len() + 8) as u32;
                Ok(out.write_all(&[&length.to_be_bytes(), &b"free"[..], record.as_bytes()].concat())?)
            }
            _ => animation::apng(pictures, self.frames, self.size, self.alpha, pace, made, out),
        }
    }
}

/// What the operating system said, if it did.
fn io_error(error: EncodeError) -> std::io::Error {
    match error {
        EncodeError::Write(cause) | EncodeError::Png(png::EncodingError::IoError(cause)) => cause,
        EncodeError::Gif(image::ImageError::IoError(cause)) => cause,
        other => std::io::Error::other(other),
    }
}
