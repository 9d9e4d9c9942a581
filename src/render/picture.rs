//! One picture: taken, shown with its background, written with its passes.

use super::background::{Background, linear};
use super::error::RenderError;
use super::picture_kind::PictureKind;
use super::progressive;
use super::record::Record;
use super::request::{Exposure, RenderRequest};
use super::target::pass_path;
use crate::integrators::image_io::{self, Bits, EncodeError, Provenance};
use crate::integrators::{self, Film, Pass, PhotonMaps, RenderSettings, camera_integrator, glare, tone};
use crate::photons::{PhotonSets, map_file};
use crate::progress::Progress;
use crate::scene::Scene;
use crate::storage::atomic_write;
use crate::storage::checkpoint::Checkpoint;
use crate::storage::text::display_name;
use std::path::{Path, PathBuf};

/// A picture that was taken.
///
/// ```
/// use cutlab::{Picture, RenderRequest};
///
/// let request = RenderRequest::scene("face-up")?.size(24, 24).samples_per_pixel(1).photons(100);
/// let picture: Picture = request.run()?;
/// assert_eq!((picture.film.width, picture.film.height), (24, 24));
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Picture {
    /// Its light, pass by pass, with glare if that was asked for.
    pub film: Film,
    scene: Scene,
    request: RenderRequest,
    settings: RenderSettings,
    /// How many rounds it is the mean of; none if it was taken in one.
    pub rounds: Option<u32>,
}

impl Picture {
    /// Writes it to a file, as its extension says: .png, .jpg, .webp or .exr. A file that is there is replaced.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), RenderError> {
        let path = path.as_ref();
        let kind = PictureKind::of_picture(path).ok_or_else(|| {
            let path = display_name(path);
            RenderError::Request(format!("{path}: pictures are .png, .jpg, .webp or .exr, name the file so"))
        })?;
        let record = Record::of_picture(&self.request);
        Ok(atomic_write::write(path, &self.encode(kind, None, record.provenance())?)?)
    }

    /// The bytes of a file of the picture, or of one of its passes, which have no background.
    ///
    /// - `made`: what the file says of where it comes from
    pub fn encode(
        &self,
        kind: PictureKind,
        pass: Option<Pass>,
        made: Provenance,
    ) -> Result<Vec<u8>, EncodeError> {
        let made = Provenance { rounds: self.rounds, ..made };
        let film = &self.film;
        let (width, height) = (film.width, film.height);
        // frames of a film have 8 bits, as it has
        let deep = self.request.bits == Some(16) && !kind.is_film();
        let bits = if deep { Bits::Sixteen } else { Bits::Eight };
        if kind == PictureKind::Exr {
            let hits = camera_integrator::first_hits(&self.scene, &self.scene.camera, width, height);
            return image_io::exr(film, &hits, self.scene.cut_out, made);
        }
        if pass.is_none() && self.request.is_transparent() {
            let shown = image_io::cut_out(film);
            return match kind {
                PictureKind::WebP => image_io::webp(&image_io::rgba_bytes(&shown), width, height, true),
                _ => image_io::rgba_png(&shown, width, height, bits, Some(made)),
            };
        }
        let shown = match (pass, self.request.background) {
            (None, Some(Background::Colour(colour))) => image_io::over_background(film, linear(colour)),
            _ => image_io::display_rgb(film, pass, &self.settings.tone),
        };
        match kind {
            PictureKind::Jpeg => image_io::jpeg(&image_io::bytes(&shown), width, height),
            PictureKind::WebP => image_io::webp(&image_io::bytes(&shown), width, height, false),
            _ => image_io::png(&shown, width, height, bits, Some(made)),
        }
    }
}

impl RenderRequest {
    /// Takes one picture; an animation is for [`super::to_files`].
    pub fn run(&self) -> Result<Picture, RenderError> {
        self.run_with(&())
    }

    /// As [`RenderRequest::run`], telling how it goes on; it ends early where that asks for it.
    pub fn run_with(&self, progress: &dyn Progress) -> Result<Picture, RenderError> {
        let file = self.scene_file()?;
        let size = self.picture_size(&file, PictureKind::Png)?;
        let scene = self.build(&file, size)?;
        let mut settings = self.settings(&scene, size);
        let mut work = PictureWork { request: self, photon_map: None, progress };
        let mut maps = None;
        settings.tone.stops = work.exposure(&scene, &mut maps, &settings)?;
        Ok(work.take(&scene, maps, &settings, None, &mut |_| Ok(()))?.0)
    }
}

/// The work on one picture or frame.
pub struct PictureWork<'a> {
    pub request: &'a RenderRequest,
    /// The file that photons are kept in.
    pub photon_map: Option<&'a Path>,
    pub progress: &'a dyn Progress,
}

impl PictureWork<'_> {
    /// Stops of exposure. To find them from a picture takes maps, which are then kept.
    pub fn exposure(
        &self,
        at_rest: &Scene,
        kept: &mut Option<PhotonMaps>,
        settings: &RenderSettings,
    ) -> Result<f32, RenderError> {
        match self.request.exposure {
            None => Ok(at_rest.camera.stops),
            Some(Exposure::Stops(stops)) => Ok(at_rest.camera.stops + stops),
            Some(Exposure::Auto) => {
                let maps = self.maps(at_rest)?;
                Ok(auto_stops(at_rest, kept.insert(maps), settings))
            }
        }
    }

    /// The photon maps: from the file, or emitted.
    fn maps(&self, scene: &Scene) -> Result<PhotonMaps, RenderError> {
        let settings = self.request.photon_settings();
        self.progress.begin("photons", 0);
        let photons = match self.photon_map {
            None => PhotonSets::emit(scene, &settings),
            Some(path) => {
                let (photons, read) =
                    map_file::load_or_emit(path, scene, &settings, self.request.options.limits)?;
                let did = if read { "used" } else { "made" };
                self.progress.note(&format!("{did} the photon map {}", display_name(path)));
                photons
            }
        };
        let maps = PhotonMaps::new(scene, photons, settings.nearest);
        self.progress.end();
        Ok(maps)
    }

    /// Takes one picture. Gives the maps for the next too, unless each round had its own.
    ///
    /// - `kept`: where the state of a progressive picture is kept, if it can be
    /// - `keep`: is given a progressive picture as it is so far, now and then
    pub fn take(
        &mut self,
        scene: &Scene,
        maps: Option<PhotonMaps>,
        settings: &RenderSettings,
        kept: Option<&mut Checkpoint>,
        keep: &mut dyn FnMut(&Picture) -> Result<(), RenderError>,
    ) -> Result<(Picture, Option<PhotonMaps>), RenderError> {
        if self.progress.is_cancelled() {
            return Err(RenderError::Cancelled);
        }
        let request = self.request;
        let picture = |film: &Film, rounds| Picture {
            film: with_glare(request, film, settings),
            scene: scene.clone(),
            request: request.clone(),
            settings: *settings,
            rounds,
        };
        let Some(stops) = &request.progressive else {
            let maps = maps.map_or_else(|| self.maps(scene), Ok)?;
            self.progress.begin("rendering", u64::from(settings.height));
            let film =
                integrators::render(scene, &scene.camera, &maps, settings, &|| self.progress.advance(1));
            self.progress.end();
            return Ok((picture(&film, None), Some(maps)));
        };
        let photons = request.photon_settings();
        let mut keep = |film: &Film, n| keep(&picture(film, Some(n)));
        let (film, rounds) =
            progressive::render(stops, scene, settings, photons, self.progress, kept, &mut keep)?;
        Ok((picture(&film, Some(rounds)), None))
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

/// The film as it is shown: with glare, if asked for.
fn with_glare(request: &RenderRequest, film: &Film, settings: &RenderSettings) -> Film {
    let mut film = film.clone();
    if let Some(f_number) = request.glare {
        glare::add(&mut film, &settings.tone, f_number);
    }
    film
}

/// Where a picture goes, and its passes.
pub struct PictureFile<'a> {
    pub target: &'a Path,
    pub kind: PictureKind,
    /// Whether passes are files of their own beside an image file that holds none.
    pub passes: bool,
    /// What the files say of where they come from.
    pub made: Provenance<'a>,
    /// What has been written.
    pub written: Vec<PathBuf>,
}

impl PictureFile<'_> {
    /// The passes that are files of their own, with their files; last the picture.
    fn parts(&self) -> Vec<(Option<Pass>, PathBuf)> {
        let apart = self.passes && self.kind != PictureKind::Exr;
        let passes = Pass::ALL.iter().filter(|_| apart);
        let passes = passes.map(|(pass, name)| (Some(*pass), pass_path(self.target, name)));
        passes.chain([(None, self.target.to_owned())]).collect()
    }

    /// Every file of the picture.
    pub fn names(&self) -> Vec<PathBuf> {
        self.parts().into_iter().map(|(_, path)| path).collect()
    }

    /// Takes the picture and writes it. Gives the maps for the next, unless each round had its own.
    ///
    /// - `identity`: of the work whose rounds can go on where an earlier start was
    pub fn take(
        &mut self,
        mut work: PictureWork,
        scene: &Scene,
        maps: Option<PhotonMaps>,
        settings: &RenderSettings,
        identity: &str,
    ) -> Result<Option<PhotonMaps>, RenderError> {
        let to_a_file = !atomic_write::is_stream(self.target);
        let mut state = to_a_file.then(|| Checkpoint::for_output(self.target, identity));
        // a frame that is there counts as finished
        let whole = to_a_file && !matches!(self.kind, PictureKind::Numbered) && !self.kind.is_film();
        let goes_on = work.request.progressive.is_some();
        let mut keep = |picture: &Picture| if whole { self.write(picture) } else { Ok(()) };
        let kept = state.as_mut().filter(|_| goes_on);
        let (picture, maps) = work.take(scene, maps, settings, kept, &mut keep)?;
        self.write(&picture)?;
        // also of rounds that were killed
        state.map_or(Ok(()), Checkpoint::remove)?;
        Ok(maps)
    }

    /// Writes the picture and, if asked for, its passes.
    fn write(&mut self, picture: &Picture) -> Result<(), RenderError> {
        self.written.clear();
        for (pass, path) in self.parts() {
            let mut bytes = picture.encode(self.kind, pass, self.made)?;
            if matches!(self.kind, PictureKind::Jpeg | PictureKind::WebP) {
                bytes.extend(Record::from(self.made).behind().bytes());
            }
            atomic_write::write(&path, &bytes)?;
            self.written.push(path);
        }
        Ok(())
    }
}
