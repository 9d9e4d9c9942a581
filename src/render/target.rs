//! Where pictures go: what is written and where, and the work that is kept beside it.

use super::error::RenderError;
use super::picture_kind::PictureKind;
use crate::integrators::{Pass, animation};
use crate::progress::Progress;
use crate::storage::atomic_write::{self, WriteError};
use crate::storage::text::display_name;
use crate::storage::{bounded_read, lock};
use std::io::Read;
use std::path::{Path, PathBuf};

/// A target that this process has to itself until it is dropped.
pub struct OutputLock<'a> {
    target: &'a OutputTarget,
    path: PathBuf,
    _lock: std::fs::File,
}

impl OutputLock<'_> {
    /// Takes away what is kept beside the target, the work being done.
    pub fn ends(self) -> Result<(), WriteError> {
        let gone = |path: PathBuf, result: std::io::Result<()>| match result {
            Err(cause) if cause.kind() != std::io::ErrorKind::NotFound => Err(WriteError { path, cause }),
            _ => Ok(()),
        };
        let [kept, frames] = [lock::sidecar_path(&self.target.path, "kept"), self.target.folder()];
        gone(kept.clone(), std::fs::remove_file(&kept))?;
        gone(frames.clone(), std::fs::remove_dir_all(&frames))
    }
}

/// The lock goes with the process that had it, and a folder without frames with it; work that is kept
/// stays for the next start.
impl Drop for OutputLock<'_> {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir(self.target.folder());
        let _ = std::fs::remove_file(&self.path);
    }
}

/// Where pictures go.
#[derive(Debug)]
pub struct OutputTarget {
    path: PathBuf,
    kind: PictureKind,
}

impl OutputTarget {
    /// The file's extension decides, and whether it is an animation.
    ///
    /// - `several`: whether it is an animation; `passes`: whether passes are written as files of their own
    pub fn new(path: &Path, several: bool, passes: bool) -> Result<OutputTarget, RenderError> {
        let extension = path.extension().map_or_else(String::new, |e| e.to_string_lossy().to_lowercase());
        let shown = display_name(path);
        let wrong = |why: String| Err(RenderError::Request(why));
        // the name of a pipe may have an extension that tells, that of a device or an open file has none
        let nameless = atomic_write::is_stream(path) && extension.is_empty();
        if nameless && (several || passes) {
            let what = if atomic_write::is_stdout(path) { "standard output" } else { "a stream" };
            return wrong(format!("several pictures cannot go to {what}: name a file with -o"));
        }
        let places = path.file_name().map_or(0, |n| n.to_string_lossy().matches('%').count());
        let numbered = numbered(path, 0).is_some();
        if several && places > 0 && !(numbered && extension == "png") {
            return wrong(format!(
                "{shown}: frames are numbered by one %d or %03d in the name of a .png; other names of an animation have no %"
            ));
        }
        if !several && numbered {
            return wrong(format!("{shown}: the name has a place for numbers of --frames N"));
        }
        let kind = match (extension.as_str(), several) {
            _ if nameless => PictureKind::Png,
            ("png", true) if numbered => PictureKind::Numbered,
            ("png" | "apng", true) => PictureKind::Apng,
            ("gif", true) => PictureKind::Gif,
            ("mp4" | "m4v", true) => PictureKind::Mp4,
            ("png", false) => PictureKind::Png,
            ("jpg" | "jpeg", false) => PictureKind::Jpeg,
            ("webp", false) => PictureKind::WebP,
            ("exr", false) => PictureKind::Exr,
            (_, true) => {
                return wrong(format!(
                    "{shown}: an animation is .mp4, .gif, .apng or .png, or numbered pictures (name-%03d.png)"
                ));
            }
            ("mp4" | "m4v" | "gif" | "apng", false) => {
                return wrong(format!("{shown}: an animation needs --frames N"));
            }
            (_, false) => {
                return wrong(format!("{shown}: pictures are .png, .jpg, .webp or .exr, name the file so"));
            }
        };
        if passes && kind.is_film() {
            return wrong("passes of an animation need numbered pictures: -o name-%03d.png".into());
        }
        Ok(OutputTarget { path: path.into(), kind })
    }

    /// Every file that is written, passes first.
    ///
    /// - `frames`: how many pictures an animation has
    pub fn files(&self, frames: Option<u32>, passes: bool) -> Vec<PathBuf> {
        let numbers = if self.kind == PictureKind::Numbered { frames.unwrap_or(1) } else { 1 };
        let of_number = |number| {
            let path = if self.kind.is_film() { self.path.clone() } else { self.frame(number) };
            let passes = Pass::ALL.iter().filter(|_| passes && self.kind != PictureKind::Exr);
            let passes: Vec<PathBuf> = passes.map(|(_, name)| pass_path(&path, name)).collect();
            passes.into_iter().chain([path])
        };
        (0..numbers).flat_map(of_number).collect()
    }

    /// What is written.
    pub fn kind(&self) -> PictureKind {
        self.kind
    }

    /// The name that was asked for.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Has the target to itself from here on.
    pub fn lock(&self, progress: &dyn Progress) -> Result<OutputLock<'_>, RenderError> {
        let waiting = || {
            let path = display_name(&self.path);
            progress.note(&format!("another cutlab is making {path}: waiting for it to end"));
        };
        let path = lock::sidecar_path(&self.path, "lock");
        let lock =
            lock::acquire(&path, &waiting).map_err(|cause| WriteError { path: path.clone(), cause })?;
        Ok(OutputLock { target: self, path, _lock: lock })
    }

    /// Whether another start, which may have been killed, left something beside the target.
    pub fn has_leftovers(&self) -> bool {
        let beside = ["kept", "lock", "frames"].map(|extension| lock::sidecar_path(&self.path, extension));
        !atomic_write::is_stream(&self.path) && beside.iter().any(|p| p.symlink_metadata().is_ok())
    }

    /// Frames of an animation in one file wait here until all are there.
    fn folder(&self) -> PathBuf {
        lock::sidecar_path(&self.path, "frames")
    }

    /// What frame number `number` shows, if it is there with all that belongs to it.
    ///
    /// - `identity`: what it must be made from; `pixels`: how many it must have; `alpha`: whether they are transparent in part
    pub fn finished(
        &self,
        number: u32,
        (passes, alpha): (bool, bool),
        identity: &str,
        pixels: u32,
    ) -> Option<Vec<u8>> {
        let path = self.frame(number);
        let shown = |path: &Path| animation::finished_frame(&read_whole(path, pixels)?, identity, pixels);
        let mut others = Pass::ALL.iter().filter(|_| passes);
        if others.any(|(_, name)| shown(&pass_path(&path, name)).is_none()) {
            return None;
        }
        let channels = if alpha { 4 } else { 3 };
        shown(&path).filter(|bytes| !self.kind.is_film() || bytes.len() == channels * pixels as usize)
    }

    /// The file of frame number `number`.
    pub fn frame(&self, number: u32) -> PathBuf {
        match self.kind {
            PictureKind::Numbered => numbered(&self.path, number).unwrap_or_else(|| self.path.clone()),
            kind if kind.is_film() => self.folder().join(format!("{number:03}.png")),
            _ => self.path.clone(),
        }
    }
}

/// The bytes of a file, if it is one and not larger than a PNG of so many pixels of ours can be.
fn read_whole(path: &Path, pixels: u32) -> Option<Vec<u8>> {
    /// Of a pixel of four channels of 16 bits that nothing packs, with room to spare; and of the texts.
    const PIXEL: u64 = 16;
    const TEXTS: u64 = 1 << 20;
    let (mut bytes, most) = (Vec::new(), u64::from(pixels) * PIXEL + TEXTS);
    bounded_read::open_regular(path).and_then(|f| f.take(most + 1).read_to_end(&mut bytes)).ok()?;
    (bytes.len() as u64 <= most).then_some(bytes)
}

/// `turn-%03d.png` with the number. None unless the name has one place for it, `%d` or `%0Nd` with N
/// from 1 to [`MOST_DIGITS`], and no other `%`.
fn numbered(path: &Path, number: u32) -> Option<PathBuf> {
    /// Digits that a number is filled up to at most.
    const MOST_DIGITS: usize = 20;
    let name = path.file_name()?.to_str()?;
    let (before, place) = name.split_once('%')?;
    let (digits, after) = place.split_once('d')?;
    let width: usize = match digits.strip_prefix('0') {
        None if digits.is_empty() => 0,
        Some(width) if width.bytes().all(|b| b.is_ascii_digit()) && !width.starts_with('0') => {
            width.parse().ok()?
        }
        _ => return None,
    };
    if width > MOST_DIGITS || after.contains('%') {
        return None;
    }
    Some(path.with_file_name(format!("{before}{number:0width$}{after}")))
}

/// `turn.png` for the caustic pass: `turn-caustic.png`.
pub fn pass_path(path: &Path, pass: &str) -> PathBuf {
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(format!("-{pass}."));
    name.push(path.extension().unwrap_or_default());
    path.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_numbered_where_the_name_says() {
        let name = |text: &str, n| numbered(Path::new(text), n).map(|p| p.display().to_string());
        assert_eq!(name("a/turn-%03d.png", 7).as_deref(), Some("a/turn-007.png"));
        assert_eq!(name("turn%d.png", 12).as_deref(), Some("turn12.png"));
        assert_eq!(name("a%b/turn%02d.png", 123).as_deref(), Some("a%b/turn123.png"));
        assert_eq!(name("%020d.png", 1).as_deref(), Some("00000000000000000001.png"));
        for none in [
            "turn.png",
            "100%.png",
            "%99999999999d.png",
            "%021d.png",
            "f%0d.png",
            "f%00d.png",
            "f%003d.png",
            "f%x.png",
            "f%-3d.png",
            "f%3d.png",
            "f%+d.png",
            "f%.3d.png",
            "f%d-%d.png",
            "f%%d.png",
            "f%1$d.png",
            "a%03d/turn.png",
            "f%０3d.png",
        ] {
            assert_eq!(name(none, 12), None, "{none}");
        }
    }
}
