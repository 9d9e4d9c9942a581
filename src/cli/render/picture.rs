//! One picture: taken, and written with its passes.

use super::background::Background;
use super::choices::Exposure;
use super::target::{Kind, beside};
use super::{Args, rounds};
use crate::cli::console::Console;
use crate::cli::outcome::Failure;
use crate::cli::outputs::record;
use crate::cli::stones;
use crate::photons::{Shots, file};
use crate::render::write::{self, Bits, EncodeError, Made};
use crate::render::{self, Film, Maps, Pass, Settings, glare, tone, tracer};
use crate::scene::Scene;
use crate::store::kept::Kept;
use crate::store::replace;
use indicatif::ProgressBar;
use std::path::{Path, PathBuf};

/// Where the work on a picture tells how far it is.
pub enum Progress<'a> {
    /// On signs of its own.
    Single(&'a Console),
    /// On the bar of an animation, which counts rows of all its frames.
    Frame { console: &'a Console, bar: &'a ProgressBar, frame: u32, frames: u32 },
}

/// A sign of a step of the work, which ends with the step.
pub struct Sign {
    bar: ProgressBar,
    prefix: String,
    own: bool,
}

impl Sign {
    /// Says what is done now.
    pub fn say(&self, what: &str) {
        self.bar.set_message(format!("{}{what}", self.prefix));
    }

    /// Counts a row.
    fn row(&self) {
        self.bar.inc(1);
    }
}

impl Drop for Sign {
    fn drop(&mut self) {
        if self.own {
            self.bar.finish_and_clear();
        }
    }
}

impl Progress<'_> {
    pub fn console(&self) -> &Console {
        match self {
            Progress::Single(console) | Progress::Frame { console, .. } => console,
        }
    }

    /// Begins a step.
    ///
    /// - `steps`: rows of the picture, 0 for a step without a count
    pub fn begin(&self, what: &'static str, steps: usize) -> Sign {
        match self {
            Progress::Single(console) => {
                let bar = if steps == 0 { console.spinner(what) } else { console.progress(steps, what) };
                Sign { bar, prefix: String::new(), own: true }
            }
            Progress::Frame { bar, frame, frames, .. } => {
                let prefix = format!("frame {} of {frames}: ", frame + 1);
                let sign = Sign { bar: (*bar).clone(), prefix, own: false };
                sign.say(what);
                sign
            }
        }
    }
}

/// Whether the picture is transparent where the background is.
pub fn is_transparent(args: &Args) -> bool {
    args.background == Some(Background::Transparent)
}

/// Stops of exposure. To find them from a picture takes maps, which are then kept.
pub fn exposure(
    args: &Args,
    at_rest: &Scene,
    kept: &mut Option<Maps>,
    settings: &Settings,
    progress: &Progress,
) -> Result<f32, Failure> {
    match args.exposure {
        None => Ok(at_rest.camera.stops),
        Some(Exposure::Stops(stops)) => Ok(at_rest.camera.stops + stops),
        Some(Exposure::Auto) => {
            let maps = maps(args, at_rest, progress)?;
            Ok(auto_stops(at_rest, kept.insert(maps), settings))
        }
    }
}

/// The exposure found from a small picture.
fn auto_stops(scene: &Scene, maps: &Maps, settings: &Settings) -> f32 {
    /// Pixels across of the small picture.
    const ACROSS: u32 = 96;
    let height = (ACROSS * settings.height).div_ceil(settings.width);
    let small = Settings { width: ACROSS, height, rays: 4, ..*settings };
    tone::auto_stops(&render::render(scene, &scene.camera, maps, &small, &|| ()))
}

/// The photon maps: from the file, or shot.
fn maps(args: &Args, scene: &Scene, progress: &Progress) -> Result<Maps, Failure> {
    let settings = args.photons();
    let _sign = progress.begin("photons", 0);
    let shots = match &args.photon_map {
        None => Shots::shoot(scene, &settings),
        Some(path) => {
            let (shots, read) = file::load_or_shoot(path, scene, &settings)?;
            let did = if read { "used" } else { "made" };
            progress.console().note(&format!("{did} the photon map {}", stones::shown(&path)));
            shots
        }
    };
    Ok(Maps::new(scene, shots, settings.nearest))
}

/// Takes and writes one picture. Returns the maps for the next, unless each round had its own.
///
/// - `identity`: of the work whose rounds can go on where an earlier start was
pub fn take(
    scene: &Scene,
    kept: Option<Maps>,
    settings: &Settings,
    file: &mut File,
    identity: &str,
    progress: &Progress,
) -> Result<Option<Maps>, Failure> {
    let args = file.args;
    let to_a_file = !replace::is_stream(file.target);
    if !args.stops.progressive {
        let maps = kept.map_or_else(|| maps(args, scene, progress), Ok)?;
        let sign = progress.begin("rendering", settings.height as usize);
        let film = render::render(scene, &scene.camera, &maps, settings, &|| sign.row());
        drop(sign);
        file.write(scene, &with_glare(args, &film, settings), settings, None)?;
        if to_a_file {
            Kept::beside(file.target, identity).done()?; // of rounds that were killed
        }
        return Ok(Some(maps));
    }
    // a frame that is there counts as finished
    let whole = to_a_file && !matches!(file.kind, Kind::Numbered) && !file.kind.is_film();
    let mut state = to_a_file.then(|| Kept::beside(file.target, identity));
    let mut keep = |film: &Film, n| {
        if whole { file.write(scene, &with_glare(args, film, settings), settings, Some(n)) } else { Ok(()) }
    };
    let (film, rounds) = rounds::take(args, scene, settings, progress, state.as_mut(), &mut keep)?;
    file.write(scene, &with_glare(args, &film, settings), settings, Some(rounds))?;
    state.map_or(Ok(()), Kept::done)?;
    Ok(None)
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
pub struct File<'a> {
    args: &'a Args,
    target: &'a Path,
    kind: Kind,
    command: &'a str,
    /// What has been written.
    pub written: Vec<PathBuf>,
}

impl<'a> File<'a> {
    pub fn new(args: &'a Args, target: &'a Path, kind: Kind, command: &'a str) -> File<'a> {
        File { args, target, kind, command, written: Vec::new() }
    }

    /// The passes that are files of their own, with their files; last the picture.
    fn parts(&self) -> Vec<(Option<Pass>, PathBuf)> {
        let apart = self.args.passes && self.kind != Kind::Exr;
        let passes = Pass::ALL.iter().filter(|_| apart);
        let passes = passes.map(|(pass, name)| (Some(*pass), beside(self.target, name)));
        passes.chain([(None, self.target.to_owned())]).collect()
    }

    /// Every file of the picture.
    pub fn names(&self) -> Vec<PathBuf> {
        self.parts().into_iter().map(|(_, path)| path).collect()
    }

    /// Writes the picture and, if asked for, its passes.
    ///
    /// - `rounds`: of which it is the mean
    fn write(
        &mut self,
        scene: &Scene,
        film: &Film,
        settings: &Settings,
        rounds: Option<u32>,
    ) -> Result<(), Failure> {
        self.written.clear();
        for (pass, path) in self.parts() {
            let bytes = self.encoded(scene, film, settings, pass, rounds);
            let mut bytes = bytes.map_err(|e| Failure::input(e.to_string()))?;
            if matches!(self.kind, Kind::Jpeg | Kind::WebP) {
                bytes.extend(record::behind(self.command).bytes());
            }
            replace::write(&path, &bytes)?;
            self.written.push(path);
        }
        Ok(())
    }

    /// The bytes of the picture or a pass. Passes have no background.
    fn encoded(
        &self,
        scene: &Scene,
        film: &Film,
        settings: &Settings,
        pass: Option<Pass>,
        rounds: Option<u32>,
    ) -> Result<Vec<u8>, EncodeError> {
        let made = Made { command: self.command, rounds };
        let (width, height) = (film.width, film.height);
        // frames of a film have 8 bits, as it has
        let deep = self.args.bits.as_deref() == Some("16") && !self.kind.is_film();
        let bits = if deep { Bits::Sixteen } else { Bits::Eight };
        if self.kind == Kind::Exr {
            let things = tracer::things(scene, &scene.camera, width, height);
            return write::exr(film, &things, scene.cut_out, made);
        }
        if pass.is_none() && is_transparent(self.args) {
            let shown = write::cut_out(film);
            return match self.kind {
                Kind::WebP => write::webp(&write::rgba_bytes(&shown), width, height, true),
                _ => write::rgba_png(&shown, width, height, bits, Some(made)),
            };
        }
        let shown = match (pass, self.args.background) {
            (None, Some(Background::Colour(colour))) => write::before(film, colour),
            _ => write::shown(film, pass, &settings.tone),
        };
        match self.kind {
            Kind::Jpeg => write::jpeg(&write::bytes(&shown), width, height),
            Kind::WebP => write::webp(&write::bytes(&shown), width, height, false),
            _ => write::png(&shown, width, height, bits, Some(made)),
        }
    }
}
