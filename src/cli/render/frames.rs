//! One picture, or the frames of an animation, to files. An animation that was interrupted goes on at
//! the first frame that is missing.
//!
//! A frame says in its `Command` what it was made by and from; one process at a time makes an animation.
//! Frames of a film wait as PNG in a hidden folder and are read back one by one when all are there, so
//! that memory holds one of them.

use super::picture::{self, File, Progress};
use super::target::{Alone, Kind, Target};
use super::{Args, command};
use crate::cli::console::Console;
use crate::cli::outcome::Failure;
use crate::cli::outputs::record;
use crate::photons::file;
use crate::render::animation::{self, Pace, Turn};
use crate::render::write::{EncodeError, Made};
use crate::render::{Maps, Settings, mp4};
use crate::scene::Scene;
use crate::store::replace::{self, WriteError};
use crate::study::identity::BUILD;
use std::io::Write;
use std::path::PathBuf;

/// Takes one picture, or all frames that are not there yet; returns the files.
pub fn take(
    args: &Args,
    scene: &Scene,
    settings: Settings,
    target: &Target,
    console: &Console,
) -> Result<Vec<PathBuf>, Failure> {
    let command = command::normalised();
    // what another version made, or was made of files that have changed since, is of no use
    let identity =
        format!("{command} # {} {BUILD}, scene {:08x}", env!("CARGO_PKG_VERSION"), file::checksum(scene));
    match args.frames {
        None => one(args, scene, settings, target, (&command, &identity), console),
        Some(frames) => all(args, scene, settings, target, frames, &identity, console),
    }
}

fn one(
    args: &Args,
    scene: &Scene,
    mut settings: Settings,
    target: &Target,
    (command, identity): (&str, &str),
    console: &Console,
) -> Result<Vec<PathBuf>, Failure> {
    let goes_on = args.stops.progressive && !replace::is_stream(target.path());
    let alone = if goes_on || target.has_leftovers() { Some(target.alone(goes_on, console)?) } else { None };
    let progress = Progress::Single(console);
    let mut maps = None;
    settings.tone.stops = picture::exposure(args, scene, &mut maps, &settings, &progress)?;
    let mut file = File::new(args, target.path(), target.kind(), command);
    picture::take(scene, maps, &settings, &mut file, identity, &progress)?;
    alone.map_or(Ok(()), Alone::ends)?;
    Ok(file.written)
}

fn all(
    args: &Args,
    scene: &Scene,
    mut settings: Settings,
    target: &Target,
    frames: u32,
    command: &str,
    console: &Console,
) -> Result<Vec<PathBuf>, Failure> {
    let alone = target.alone(true, console)?;
    let alpha = scene.cut_out && picture::is_transparent(args);
    let pixels = settings.width * settings.height;
    let finished = |number| target.finished(number, (args.passes, alpha), command, pixels);
    let bar = console.progress((frames * settings.height) as usize, "frames");
    // where only the camera moves, the light stands still
    let still = args.turn == Turn::Camera;
    let mut kept: Option<Maps> = None;
    let mut stops = None;
    let mut files = Vec::new();
    for frame in 0..frames {
        let path = target.frame(frame);
        let progress = Progress::Frame { console, bar: &bar, frame, frames };
        if finished(frame).is_some() {
            files.extend(File::new(args, &path, target.kind(), command).names());
            bar.set_position(u64::from(frame + 1) * u64::from(settings.height));
            bar.reset_eta();
            continue;
        }
        // the exposure is that of the scene at rest, for every frame alike
        if stops.is_none() {
            stops = Some(picture::exposure(args, scene, &mut kept, &settings, &progress)?);
        }
        settings.tone.stops = stops.unwrap_or_default();
        let moved = animation::at(scene, args.turn, args.rock, frame, frames);
        let maps = if still { kept.take() } else { None };
        let mut file = File::new(args, &path, target.kind(), command);
        kept = picture::take(&moved, maps, &settings, &mut file, command, &progress)?;
        bar.set_position(u64::from(frame + 1) * u64::from(settings.height));
        files.extend(file.written);
    }
    bar.finish_and_clear();
    if target.kind().is_film() {
        let sign = console.spinner("putting the frames together");
        let mut pictures = (0..frames).map(|n| finished(n).ok_or(EncodeError::Frame(n)));
        let film = Film { size: (settings.width, settings.height), frames, alpha, args, command };
        replace::stream(target.path(), |out| {
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
struct Film<'a> {
    size: (u32, u32),
    frames: u32,
    alpha: bool,
    args: &'a Args,
    command: &'a str,
}

impl Film<'_> {
    fn write(
        &self,
        kind: Kind,
        pictures: &mut animation::Frames,
        out: &mut dyn Write,
    ) -> Result<(), EncodeError> {
        let pace = self.args.fps.map_or_else(|| Pace::of_turn(self.frames), Pace::of_rate);
        let made = Made { command: self.command, rounds: None };
        let record = record::behind(&command::normalised());
        match kind {
            Kind::Gif => {
                animation::gif(pictures, self.size, pace, out)?;
                Ok(out.write_all(record.as_bytes())?)
            }
            Kind::Mp4 => {
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
