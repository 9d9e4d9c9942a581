//! One picture: taken, and written with its passes.

use super::background::Background;
use super::choices::Exposure;
pub use super::progress::PictureProgress;
use super::target::{PictureKind, beside};
use super::{RenderArgs, progressive};
use crate::cli::args::stone;
use crate::cli::exit_code::CliError;
use crate::cli::limits::limits;
use crate::cli::outputs::record;
use crate::integrators::image_io::{self, Bits, EncodeError, Provenance};
use crate::integrators::{self, Film, Pass, PhotonMaps, RenderSettings, camera_integrator, glare, tone};
use crate::photons::{PhotonSets, map_file};
use crate::scene::Scene;
use crate::storage::atomic_write;
use crate::storage::checkpoint::Checkpoint;
use std::path::{Path, PathBuf};

/// Whether the picture is transparent where the background is.
pub fn is_transparent(args: &RenderArgs) -> bool {
    args.background == Some(Background::Transparent)
}

/// Stops of exposure. To find them from a picture takes maps, which are then kept.
pub fn exposure(
    args: &RenderArgs,
    at_rest: &Scene,
    kept: &mut Option<PhotonMaps>,
    settings: &RenderSettings,
    progress: &PictureProgress,
) -> Result<f32, CliError> {
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
fn auto_stops(scene: &Scene, maps: &PhotonMaps, settings: &RenderSettings) -> f32 {
    /// Pixels across of the small picture.
    const ACROSS: u32 = 96;
    let height = (ACROSS * settings.height).div_ceil(settings.width);
    let small = RenderSettings { width: ACROSS, height, samples_per_pixel: 4, ..*settings };
    tone::auto_stops(&integrators::render(scene, &scene.camera, maps, &small, &|| ()))
}

/// The photon maps: from the file, or shot.
fn maps(args: &RenderArgs, scene: &Scene, progress: &PictureProgress) -> Result<PhotonMaps, CliError> {
    let settings = args.photons();
    let _sign = progress.begin("photons", 0);
    let shots = match &args.photon_map {
        None => PhotonSets::emit(scene, &settings),
        Some(path) => {
            let (shots, read) = map_file::load_or_emit(path, scene, &settings, limits())?;
            let did = if read { "used" } else { "made" };
            progress.console().note(&format!("{did} the photon map {}", stone::display_name(path)));
            shots
        }
    };
    Ok(PhotonMaps::new(scene, shots, settings.nearest))
}

/// Takes and writes one picture. Returns the maps for the next, unless each round had its own.
///
/// - `identity`: of the work whose rounds can go on where an earlier start was
pub fn render(
    scene: &Scene,
    kept: Option<PhotonMaps>,
    settings: &RenderSettings,
    file: &mut PictureFile,
    identity: &str,
    progress: &PictureProgress,
) -> Result<Option<PhotonMaps>, CliError> {
    let args = file.args;
    let to_a_file = !atomic_write::is_stream(file.target);
    if !args.stops.progressive {
        let maps = kept.map_or_else(|| maps(args, scene, progress), Ok)?;
        let sign = progress.begin("rendering", settings.height as usize);
        let film = integrators::render(scene, &scene.camera, &maps, settings, &|| sign.row());
        drop(sign);
        file.write(scene, &with_glare(args, &film, settings), settings, None)?;
        if to_a_file {
            Checkpoint::for_output(file.target, identity).remove()?; // of rounds that were killed
        }
        return Ok(Some(maps));
    }
    // a frame that is there counts as finished
    let whole = to_a_file && !matches!(file.kind, PictureKind::Numbered) && !file.kind.is_film();
    let mut state = to_a_file.then(|| Checkpoint::for_output(file.target, identity));
    let mut keep = |film: &Film, n| {
        if whole { file.write(scene, &with_glare(args, film, settings), settings, Some(n)) } else { Ok(()) }
    };
    let (film, rounds) = progressive::render(args, scene, settings, progress, state.as_mut(), &mut keep)?;
    file.write(scene, &with_glare(args, &film, settings), settings, Some(rounds))?;
    state.map_or(Ok(()), Checkpoint::remove)?;
    Ok(None)
}

/// The film as it is shown: with glare, if asked for.
fn with_glare(args: &RenderArgs, film: &Film, settings: &RenderSettings) -> Film {
    let mut film = film.clone();
    if let Some(f_number) = args.glare {
        glare::add(&mut film, &settings.tone, f_number);
    }
    film
}

/// Where a picture goes, and its passes.
pub struct PictureFile<'a> {
    args: &'a RenderArgs,
    target: &'a Path,
    kind: PictureKind,
    command: &'a str,
    /// What has been written.
    pub written: Vec<PathBuf>,
}

impl<'a> PictureFile<'a> {
    pub fn new(
        args: &'a RenderArgs,
        target: &'a Path,
        kind: PictureKind,
        command: &'a str,
    ) -> PictureFile<'a> {
        PictureFile { args, target, kind, command, written: Vec::new() }
    }

    /// The passes that are files of their own, with their files; last the picture.
    fn parts(&self) -> Vec<(Option<Pass>, PathBuf)> {
        let apart = self.args.passes && self.kind != PictureKind::Exr;
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
        settings: &RenderSettings,
        rounds: Option<u32>,
    ) -> Result<(), CliError> {
        self.written.clear();
        for (pass, path) in self.parts() {
            let bytes = self.encoded(scene, film, settings, pass, rounds);
            let mut bytes = bytes.map_err(|e| CliError::input(e.to_string()))?;
            if matches!(self.kind, PictureKind::Jpeg | PictureKind::WebP) {
                bytes.extend(record::behind(self.command).bytes());
            }
            atomic_write::write(&path, &bytes)?;
            self.written.push(path);
        }
        Ok(())
    }

    /// The bytes of the picture or a pass. Passes have no background.
    fn encoded(
        &self,
        scene: &Scene,
        film: &Film,
        settings: &RenderSettings,
        pass: Option<Pass>,
        rounds: Option<u32>,
    ) -> Result<Vec<u8>, EncodeError> {
        let made = Provenance { command: self.command, rounds };
        let (width, height) = (film.width, film.height);
        // frames of a film have 8 bits, as it has
        let deep = self.args.bits.as_deref() == Some("16") && !self.kind.is_film();
        let bits = if deep { Bits::Sixteen } else { Bits::Eight };
        if self.kind == PictureKind::Exr {
            let things = camera_integrator::first_hits(scene, &scene.camera, width, height);
            return image_io::exr(film, &things, scene.cut_out, made);
        }
        if pass.is_none() && is_transparent(self.args) {
            let shown = image_io::cut_out(film);
            return match self.kind {
                PictureKind::WebP => image_io::webp(&image_io::rgba_bytes(&shown), width, height, true),
                _ => image_io::rgba_png(&shown, width, height, bits, Some(made)),
            };
        }
        let shown = match (pass, self.args.background) {
            (None, Some(Background::Colour(colour))) => image_io::over_background(film, colour),
            _ => image_io::display_rgb(film, pass, &settings.tone),
        };
        match self.kind {
            PictureKind::Jpeg => image_io::jpeg(&image_io::bytes(&shown), width, height),
            PictureKind::WebP => image_io::webp(&image_io::bytes(&shown), width, height, false),
            _ => image_io::png(&shown, width, height, bits, Some(made)),
        }
    }
}
