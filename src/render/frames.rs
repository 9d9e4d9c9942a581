//! One picture, or the frames of an animation, to files. An animation that was interrupted goes on at
//! the first frame that is missing.
//!
//! A frame says in its `Identity` what it was made from; one process at a time makes an animation.
//! Frames of a film wait as PNG in a hidden folder and are read back one by one when all are there, so
//! that memory holds one of them.

use super::error::RenderError;
use super::picture::{PictureFile, PictureWork};
use super::picture_kind::PictureKind;
use super::record::Record;
use super::request::{AnimationRequest, RenderRequest};
use super::target::{OutputLock, OutputTarget};
use crate::integrators::animation::{self, FrameTiming, Turn};
use crate::integrators::image_io::{EncodeError, Provenance};
use crate::integrators::{PhotonMaps, RenderSettings, mp4};
use crate::progress::Progress;
use crate::scene::Scene;
use crate::storage::atomic_write::{self, WriteError};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Takes the picture of a request, or all frames that are not there yet, and writes them; returns the files.
///
/// - `scene`: as [`RenderRequest::build`] gives it, at rest, and pixels across and down
/// - `photon_map`: the file that photons are kept in
/// - `passes`: whether passes are written as files of their own
/// - `made`: what the files say of where they come from; frames and rounds of an earlier start are used again if they
///   have its identity
pub fn to_files(
    request: &RenderRequest,
    (scene, size): (&Scene, (u32, u32)),
    target: &OutputTarget,
    (photon_map, passes): (Option<&Path>, bool),
    made: Provenance,
    progress: &dyn Progress,
) -> Result<Vec<PathBuf>, RenderError> {
    let settings = request.settings(scene, size);
    let job = PictureJob { request, scene, target, photon_map, passes, made, progress };
    match &request.animation {
        None => job.one(settings),
        Some(animation) => job.all(settings, animation),
    }
}

struct PictureJob<'a> {
    request: &'a RenderRequest,
    scene: &'a Scene,
    target: &'a OutputTarget,
    photon_map: Option<&'a Path>,
    passes: bool,
    made: Provenance<'a>,
    progress: &'a dyn Progress,
}

impl<'a> PictureJob<'a> {
    fn work<'b>(&self, progress: &'b dyn Progress) -> PictureWork<'b>
    where
        'a: 'b,
    {
        PictureWork { request: self.request, photon_map: self.photon_map, progress }
    }

    fn one(&self, mut settings: RenderSettings) -> Result<Vec<PathBuf>, RenderError> {
        let target = self.target;
        let goes_on = self.request.progressive.is_some() && !atomic_write::is_stream(target.path());
        let alone = if goes_on || target.has_leftovers() { Some(target.lock(self.progress)?) } else { None };
        let mut maps = None;
        let work = self.work(self.progress);
        settings.tone.stops = work.exposure(self.scene, &mut maps, &settings)?;
        let mut file = self.file(target.path(), Provenance { identity: None, ..self.made });
        file.take(work, self.scene, maps, &settings, self.identity())?;
        alone.map_or(Ok(()), OutputLock::ends)?;
        Ok(file.written)
    }

    fn identity(&self) -> &str {
        self.made.identity.unwrap_or_default()
    }

    fn file<'b>(&self, path: &'b Path, made: Provenance<'b>) -> PictureFile<'b> {
        let (kind, passes) = (self.target.kind(), self.passes);
        PictureFile { target: path, kind, passes, made, written: Vec::new() }
    }

    fn all(
        &self,
        mut settings: RenderSettings,
        animation: &AnimationRequest,
    ) -> Result<Vec<PathBuf>, RenderError> {
        let (target, scene) = (self.target, self.scene);
        let frames = animation.frames;
        let alone = target.lock(self.progress)?;
        let alpha = scene.cut_out && self.request.is_transparent();
        let pixels = settings.width * settings.height;
        let identity = self.identity();
        let finished = |number| target.finished(number, (self.passes, alpha), identity, pixels);
        self.progress.begin("frames", u64::from(frames) * u64::from(settings.height));
        // where only the camera moves, the light stands still
        let still = animation.turn == Turn::Camera;
        let mut kept: Option<PhotonMaps> = None;
        let mut stops = None;
        let mut files = Vec::new();
        for frame in 0..frames {
            let path = target.frame(frame);
            let mut file = self.file(&path, self.made);
            if finished(frame).is_some() {
                files.extend(file.names());
                self.progress.advance(u64::from(settings.height));
                continue;
            }
            let of_frame = FrameProgress { all: self.progress, frame, frames };
            let work = self.work(&of_frame);
            // the exposure is that of the scene at rest, for every frame alike
            if stops.is_none() {
                stops = Some(work.exposure(scene, &mut kept, &settings)?);
            }
            settings.tone.stops = stops.unwrap_or_default();
            let moved = animation::scene_at(scene, animation.turn, animation.rock, frame, frames);
            let maps = if still { kept.take() } else { None };
            kept = file.take(work, &moved, maps, &settings, identity)?;
            if self.request.progressive.is_some() {
                self.progress.advance(u64::from(settings.height)); // rounds do not count rows
            }
            files.extend(file.written);
        }
        self.progress.end();
        if target.kind().is_film() {
            self.progress.begin("putting the frames together", 0);
            let mut pictures = (0..frames).map(|n| finished(n).ok_or(EncodeError::Frame(n)));
            let size = (settings.width, settings.height);
            let film = AnimationFrames { size, alpha, animation, made: self.made };
            atomic_write::stream(target.path(), |out| {
                let fail = |error| WriteError { path: target.path().into(), cause: io_error(error) };
                film.write(target.kind(), &mut pictures, out).map_err(fail)
            })?;
            self.progress.end();
            files = vec![target.path().into()];
        }
        alone.ends()?;
        Ok(files)
    }
}

/// Progress of one frame, told as that of the animation.
struct FrameProgress<'a> {
    all: &'a dyn Progress,
    frame: u32,
    frames: u32,
}

impl Progress for FrameProgress<'_> {
    fn begin(&self, what: &str, _: u64) {
        self.say(what);
    }

    fn advance(&self, parts: u64) {
        self.all.advance(parts);
    }

    fn say(&self, what: &str) {
        self.all.say(&format!("frame {} of {}: {what}", self.frame + 1, self.frames));
    }

    fn note(&self, text: &str) {
        self.all.note(text);
    }

    fn is_cancelled(&self) -> bool {
        self.all.is_cancelled()
    }
}

/// An animation in one file.
struct AnimationFrames<'a> {
    size: (u32, u32),
    alpha: bool,
    animation: &'a AnimationRequest,
    made: Provenance<'a>,
}

impl AnimationFrames<'_> {
    fn write(
        &self,
        kind: PictureKind,
        pictures: &mut animation::Frames,
        out: &mut dyn Write,
    ) -> Result<(), EncodeError> {
        let AnimationRequest { frames, fps, .. } = *self.animation;
        let pace = fps.map_or_else(|| FrameTiming::of_turn(frames), FrameTiming::of_rate);
        let made = Provenance { identity: None, ..self.made };
        let record = Record::from(made).behind();
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
            _ => animation::apng(pictures, frames, self.size, self.alpha, pace, made, out),
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
