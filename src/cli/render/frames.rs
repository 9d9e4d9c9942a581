//! One picture or the frames of an animation, to files. An animation that was interrupted goes on
//! at the first frame that is missing.
//!
//! A frame says in its `Command` what it was made by and from; one process at a time makes an animation.

use super::{Args, auto_stops, command, maps, rounds, stops};
use crate::cli::console::Console;
use crate::cli::outcome::{self, Failure};
use crate::cli::outputs::{Outputs, record};
use crate::photons::file;
use crate::render::animation::{self, Turn};
use crate::render::write::{self, Bits, Made};
use crate::render::{self, Film, Maps, Pass, Settings, glare, tracer};
use crate::scene::Scene;
use crate::store::kept::Kept;
use crate::store::replace::{self, WriteError};
use crate::store::{limits, lock};
use crate::study::identity::BUILD;
use std::io::Read;
use std::path::{Path, PathBuf};

/// What is written.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Png,
    Exr,
    /// Pictures whose names have a number.
    Numbered,
    Gif,
    Apng,
}

/// A target that this process has to itself until it is dropped.
struct Alone {
    path: PathBuf,
    _lock: std::fs::File,
}

impl Alone {
    /// Takes the lock away, the work being done.
    fn ends(self) -> Result<(), WriteError> {
        std::fs::remove_file(&self.path).map_err(|cause| WriteError { path: self.path, cause })
    }
}

/// Where pictures go.
#[derive(Debug)]
pub struct Target {
    path: PathBuf,
    kind: Kind,
}

impl Target {
    /// The file's ending decides, and whether it is an animation.
    pub fn of(path: &Path, args: &Args) -> Result<Target, Failure> {
        let ending = path.extension().map_or_else(String::new, |e| e.to_string_lossy().to_lowercase());
        let several = args.frames.is_some();
        let numbered = numbered(path, 0).is_some();
        let kind = match (ending.as_str(), several) {
            _ if path == Path::new("-") && (several || args.passes) => {
                return Err(Failure::input(
                    "several pictures cannot go to standard output: name a file with -o",
                ));
            }
            _ if path == Path::new("-") => Kind::Png,
            ("png", true) if numbered => Kind::Numbered,
            ("png" | "apng", true) => Kind::Apng,
            ("gif", true) => Kind::Gif,
            ("png", false) => Kind::Png,
            ("exr", false) => Kind::Exr,
            (_, true) => {
                return Err(Failure::input(format!(
                    "{}: an animation is .gif, .apng or .png, or numbered pictures (name-%03d.png)",
                    path.display()
                )));
            }
            (_, false) => {
                let path = path.display();
                return Err(Failure::input(format!("{path}: pictures are .png or .exr, name the file so")));
            }
        };
        if args.passes && matches!(kind, Kind::Gif | Kind::Apng) {
            return Err(Failure::input("passes of an animation need numbered pictures: -o name-%03d.png"));
        }
        Ok(Target { path: path.into(), kind })
    }

    /// Takes the places of all files, or says why they cannot be written.
    pub fn claim(&self, args: &Args, outputs: &mut Outputs) -> Result<(), Failure> {
        let command = command::normalised();
        let is_own = |there: &Path| record::is_of(there, &command);
        if let Some(map) = &args.photon_map {
            outputs.claim(map, |_| true)?; // a map that is another's is refused by its reader
        }
        let numbers = if self.kind == Kind::Numbered { args.frames.unwrap_or(1) } else { 1 };
        for number in 0..numbers {
            let path = if self.is_one_file() { self.path.clone() } else { self.frame(number) };
            for (_, name) in Pass::ALL.iter().filter(|_| args.passes && self.kind != Kind::Exr) {
                outputs.claim(&beside(&path, name), is_own)?;
            }
            outputs.claim(&path, is_own)?;
        }
        Ok(())
    }

    /// Has the target to itself from here on: what is done of it outlives this process.
    fn alone(&self, console: &Console) -> Result<Alone, Failure> {
        outcome::goes_on();
        let waiting = || {
            let path = self.path.display();
            console.note(&format!("another cutlab is making {path}: waiting for it to end"));
        };
        let path = lock::hidden(&self.path, "lock");
        let lock = lock::take(&path, &waiting).map_err(|cause| WriteError { path: path.clone(), cause })?;
        Ok(Alone { path, _lock: lock })
    }

    /// Frames of an animation in one file wait here until all are there.
    fn folder(&self) -> PathBuf {
        lock::hidden(&self.path, "frames")
    }

    /// Whether the animation is one file.
    fn is_one_file(&self) -> bool {
        matches!(self.kind, Kind::Gif | Kind::Apng)
    }

    /// What frame number `number` shows, if it is there with all that belongs to it.
    ///
    /// - `pixels`: how many it must have
    fn finished(&self, number: u32, passes: bool, command: &str, pixels: u32) -> Option<Vec<u8>> {
        let path = self.frame(number);
        let shown = |path: &Path| animation::finished_frame(&whole(path, pixels)?, command, pixels);
        let mut others = Pass::ALL.iter().filter(|_| passes);
        if others.any(|(_, name)| shown(&beside(&path, name)).is_none()) {
            return None;
        }
        shown(&path).filter(|rgb| !self.is_one_file() || rgb.len() == 3 * pixels as usize)
    }

    fn frame(&self, number: u32) -> PathBuf {
        match self.kind {
            Kind::Gif | Kind::Apng => self.folder().join(format!("{number:03}.png")),
            Kind::Numbered => numbered(&self.path, number).unwrap_or_else(|| self.path.clone()),
            Kind::Png | Kind::Exr => self.path.clone(),
        }
    }
}

/// The bytes of a file, if it is one and not larger than a PNG of so many pixels of ours can be.
fn whole(path: &Path, pixels: u32) -> Option<Vec<u8>> {
    /// Of a pixel of four channels of 16 bits that nothing packs, with room to spare; and of the texts.
    const PIXEL: u64 = 16;
    const TEXTS: u64 = 1 << 20;
    let (mut bytes, most) = (Vec::new(), u64::from(pixels) * PIXEL + TEXTS);
    limits::regular(path).and_then(|f| f.take(most + 1).read_to_end(&mut bytes)).ok()?;
    (bytes.len() as u64 <= most).then_some(bytes)
}

/// `turn-%03d.png` with the number; none if there is no place for it.
fn numbered(path: &Path, number: u32) -> Option<PathBuf> {
    let name = path.file_name()?.to_string_lossy().into_owned();
    let at = name.find('%')?;
    let digits = name[at + 1..].find('d').map(|end| &name[at + 1..at + 1 + end])?;
    let width: usize = if digits.is_empty() { 0 } else { digits.trim_start_matches('0').parse().ok()? };
    let number = format!("{number:0width$}");
    Some(path.with_file_name(format!("{}{number}{}", &name[..at], &name[at + 2 + digits.len()..])))
}

/// Takes one picture, or all frames that are not there yet; returns the files.
pub fn take(
    args: &Args,
    scene: &Scene,
    mut settings: Settings,
    target: &Target,
    console: &Console,
) -> Result<Vec<PathBuf>, Failure> {
    let command = command::normalised();
    // what another version made, or was made of files that have changed since, is of no use
    let identity =
        format!("{command} # {} {BUILD}, scene {:08x}", env!("CARGO_PKG_VERSION"), file::checksum(scene));
    let Some(frames) = args.frames else {
        let alone = if args.stops.progressive && !replace::is_stream(&target.path) {
            Some(target.alone(console)?)
        } else {
            None
        };
        let mut maps = None;
        settings.tone.stops = exposure(args, scene, &mut maps, &settings, console)?;
        let mut file =
            File { args, target: &target.path, kind: target.kind, command: &command, written: vec![] };
        picture(scene, maps, &settings, &mut file, &identity, console)?;
        alone.map_or(Ok(()), Alone::ends)?;
        return Ok(file.written);
    };
    let alone = target.alone(console)?;
    let command = identity;
    // where only the camera moves, the light stands still
    let still = args.turn == Turn::Camera;
    let mut kept: Option<Maps> = None;
    let mut stops = None;
    let mut files = Vec::new();
    let mut pictures = Vec::new();
    for frame in 0..frames {
        let path = target.frame(frame);
        let bytes = match target.finished(frame, args.passes, &command, settings.width * settings.height) {
            Some(bytes) => bytes,
            None => {
                // the exposure is that of the scene at rest, for every frame alike
                if stops.is_none() {
                    stops = Some(exposure(args, scene, &mut kept, &settings, console)?);
                }
                settings.tone.stops = stops.unwrap_or_default();
                let moved = animation::at(scene, args.turn, args.rock, frame, frames);
                let maps = if still { kept.take() } else { None };
                let mut file =
                    File { args, target: &path, kind: target.kind, command: &command, written: Vec::new() };
                let (film, maps) = picture(&moved, maps, &settings, &mut file, &command, console)?;
                kept = maps;
                files.extend(file.written);
                write::bytes(&write::shown(&film, None, &settings.tone))
            }
        };
        if target.is_one_file() {
            pictures.push(bytes);
        }
    }
    if !target.is_one_file() {
        alone.ends()?;
        return Ok(files);
    }
    let (width, height) = (settings.width, settings.height);
    let bytes = match target.kind {
        Kind::Gif => animation::gif(&pictures, width, height),
        _ => animation::apng(&pictures, width, height, &command),
    };
    let mut bytes = bytes.map_err(|e| Failure::input(e.to_string()))?;
    if target.kind == Kind::Gif {
        bytes.extend(record::behind(&command::normalised()).bytes());
    }
    replace::write(&target.path, &bytes)?;
    let fail = |cause| WriteError { path: target.path.clone(), cause };
    std::fs::remove_dir_all(target.folder()).map_err(fail)?;
    alone.ends()?;
    Ok(vec![target.path.clone()])
}

/// Stops of exposure. To find them from a picture takes maps, which are then kept.
fn exposure(
    args: &Args,
    at_rest: &Scene,
    kept: &mut Option<Maps>,
    settings: &Settings,
    console: &Console,
) -> Result<f32, Failure> {
    if let Some(stops) = stops(args, at_rest) {
        return Ok(stops);
    }
    let maps = maps(args, at_rest, console)?;
    Ok(auto_stops(at_rest, kept.insert(maps), settings))
}

/// Takes and writes one picture. Returns the maps for the next, unless each round had its own.
///
/// - `identity`: of the work whose rounds can go on where an earlier start was
fn picture(
    scene: &Scene,
    kept: Option<Maps>,
    settings: &Settings,
    file: &mut File,
    identity: &str,
    console: &Console,
) -> Result<(Film, Option<Maps>), Failure> {
    let args = file.args;
    if args.stops.progressive {
        // a frame that is there counts as finished
        let to_a_file = !replace::is_stream(file.target);
        let whole = to_a_file && matches!(file.kind, Kind::Png | Kind::Exr);
        let mut state = to_a_file.then(|| Kept::beside(file.target, identity));
        let mut keep = |film: &Film, n| {
            if whole {
                file.write(scene, &with_glare(args, film, settings), settings, Some(n))
            } else {
                Ok(())
            }
        };
        let (film, rounds) = rounds::take(args, scene, settings, console, state.as_mut(), &mut keep)?;
        let film = with_glare(args, &film, settings);
        file.write(scene, &film, settings, Some(rounds))?;
        state.map_or(Ok(()), Kept::done)?;
        return Ok((film, None));
    }
    let maps = kept.map_or_else(|| maps(args, scene, console), Ok)?;
    let bar = console.progress(settings.height as usize, "rendering");
    let film = render::render(scene, &scene.camera, &maps, settings, &|| bar.inc(1));
    bar.finish_and_clear();
    let film = with_glare(args, &film, settings);
    file.write(scene, &film, settings, None)?;
    Ok((film, Some(maps)))
}

/// The film as it is shown: with glare, if asked for.
fn with_glare(args: &Args, film: &Film, settings: &Settings) -> Film {
    let mut film = film.clone();
    if let Some(f_number) = args.glare {
        glare::add(&mut film, &settings.tone, f_number);
    }
    film
}

/// Where a picture goes, and its passes.
struct File<'a> {
    args: &'a Args,
    target: &'a Path,
    kind: Kind,
    command: &'a str,
    written: Vec<PathBuf>,
}

impl File<'_> {
    /// Writes a picture and, if asked for, its passes.
    ///
    /// - `rounds`: of which it is the mean
    fn write(
        &mut self,
        scene: &Scene,
        film: &Film,
        settings: &Settings,
        rounds: Option<u32>,
    ) -> Result<(), Failure> {
        let bad = |e: write::EncodeError| Failure::input(e.to_string());
        let made = Made { command: self.command, rounds };
        self.written.clear();
        if self.kind == Kind::Exr {
            let things = tracer::things(scene, &scene.camera, film.width, film.height);
            replace::write(self.target, &write::exr(film, &things, made).map_err(bad)?)?;
            self.written.push(self.target.into());
            return Ok(());
        }
        let one_file = matches!(self.kind, Kind::Gif | Kind::Apng); // of eight bits, and so are its frames
        let bits = if self.args.bits == "16" && !one_file { Bits::Sixteen } else { Bits::Eight };
        let passes = Pass::ALL.iter().filter(|_| self.args.passes).map(|(pass, name)| (Some(*pass), *name));
        for (pass, name) in passes.chain([(None, "")]) {
            let path = if pass.is_some() { beside(self.target, name) } else { self.target.to_owned() };
            let shown = write::shown(film, pass, &settings.tone);
            let png = write::png(&shown, film.width, film.height, bits, Some(made)).map_err(bad)?;
            replace::write(&path, &png)?;
            self.written.push(path);
        }
        Ok(())
    }
}

/// `turn.png` for the caustic pass: `turn-caustic.png`.
fn beside(path: &Path, pass: &str) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-{pass}.png"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_numbered_where_the_name_says() {
        let name = |text: &str, n| numbered(Path::new(text), n).map(|p| p.display().to_string());
        assert_eq!(name("a/turn-%03d.png", 7).as_deref(), Some("a/turn-007.png"));
        assert_eq!(name("turn%d.png", 12).as_deref(), Some("turn12.png"));
        assert_eq!(name("turn.png", 12), None);
        assert_eq!(name("100%.png", 12), None);
    }
}
