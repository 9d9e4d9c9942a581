//! One picture or the frames of an animation, to files. An animation that was interrupted goes on
//! at the first frame that is missing.

use super::{Args, command, maps, stops};
use crate::cli::console::Console;
use crate::cli::outcome::Failure;
use crate::render::animation::{self, Turn};
use crate::render::write::{self, Bits};
use crate::render::{self, Film, Maps, Pass, Settings, tracer};
use crate::scene::Scene;
use crate::store::replace;
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

    /// Frames of an animation in one file wait here until all are there.
    fn folder(&self) -> PathBuf {
        let mut name = self.path.file_name().unwrap_or_default().to_os_string();
        name.push(".frames");
        self.path.with_file_name(name)
    }

    fn frame(&self, number: u32) -> PathBuf {
        match self.kind {
            Kind::Gif | Kind::Apng => self.folder().join(format!("{number:03}.png")),
            Kind::Numbered => numbered(&self.path, number).unwrap_or_else(|| self.path.clone()),
            Kind::Png | Kind::Exr => self.path.clone(),
        }
    }
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
    let Some(frames) = args.frames else {
        let maps = maps(args, scene, console)?;
        settings.tone.stops = stops(args, scene, &maps, &settings);
        let film = picture(scene, &maps, &settings, console);
        return write_picture(args, scene, &film, &settings, &target.path, target.kind, &command);
    };
    // where only the camera moves, the light stands still
    let still = args.turn == Turn::Camera;
    let mut kept: Option<(Maps, f32)> = None;
    let mut files = Vec::new();
    let mut pictures = Vec::new();
    let in_one_file = matches!(target.kind, Kind::Gif | Kind::Apng);
    for frame in 0..frames {
        let path = target.frame(frame);
        let there = std::fs::read(&path).ok().and_then(|png| animation::finished_frame(&png, &command));
        let bytes = match there {
            Some(bytes) => bytes,
            None => {
                let moved = animation::at(scene, args.turn, args.rock, frame, frames);
                let (maps, stops) = match kept.take() {
                    Some((maps, stops)) if still => (maps, stops),
                    found => {
                        // the exposure is that of the scene at rest, for every frame alike
                        let at_rest = if still { scene } else { &moved };
                        let maps = maps(args, at_rest, console)?;
                        let stops =
                            found.map_or_else(|| stops(args, at_rest, &maps, &settings), |(_, stops)| stops);
                        (maps, stops)
                    }
                };
                settings.tone.stops = stops;
                let film = picture(&moved, &maps, &settings, console);
                let kind = Kind::Png;
                files.extend(write_picture(args, &moved, &film, &settings, &path, kind, &command)?);
                kept = Some((maps, stops));
                write::bytes(&write::shown(&film, None, &settings.tone))
            }
        };
        if in_one_file {
            pictures.push(bytes);
        }
    }
    if !in_one_file {
        return Ok(files);
    }
    let (width, height) = (settings.width, settings.height);
    let bytes = match target.kind {
        Kind::Gif => animation::gif(&pictures, width, height),
        _ => animation::apng(&pictures, width, height, &command),
    };
    replace::write(&target.path, &bytes.map_err(|e| Failure::input(e.to_string()))?)?;
    (0..frames).for_each(|f| drop(std::fs::remove_file(target.frame(f))));
    // it stays if someone else has put something there
    let _ = std::fs::remove_dir(target.folder());
    Ok(vec![target.path.clone()])
}

fn picture(scene: &Scene, maps: &Maps, settings: &Settings, console: &Console) -> Film {
    let bar = console.progress(settings.height as usize, "rendering");
    let film = render::render(scene, &scene.camera, maps, settings, &|| bar.inc(1));
    bar.finish_and_clear();
    film
}

/// Writes a picture and, if asked for, its passes.
fn write_picture(
    args: &Args,
    scene: &Scene,
    film: &Film,
    settings: &Settings,
    path: &Path,
    kind: Kind,
    command: &str,
) -> Result<Vec<PathBuf>, Failure> {
    let bad = |e: write::EncodeError| Failure::input(e.to_string());
    if kind == Kind::Exr {
        let things = tracer::things(scene, &scene.camera, film.width, film.height);
        replace::write(path, &write::exr(film, &things, command).map_err(bad)?)?;
        return Ok(vec![path.into()]);
    }
    let bits = if args.bits == "16" { Bits::Sixteen } else { Bits::Eight };
    let passes = Pass::ALL.iter().filter(|_| args.passes).map(|(pass, name)| (Some(*pass), *name));
    let mut files = Vec::new();
    for (pass, name) in passes.chain([(None, "")]) {
        let path = if pass.is_some() { beside(path, name) } else { path.to_owned() };
        let shown = write::shown(film, pass, &settings.tone);
        let png = write::png(&shown, film.width, film.height, bits, Some(command)).map_err(bad)?;
        replace::write(&path, &png)?;
        files.push(path);
    }
    Ok(files)
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
