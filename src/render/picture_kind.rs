//! Formats of pictures and animations.

use std::path::Path;

/// What a picture is written as.
///
/// ```
/// use cutlab::PictureKind;
///
/// let kind = PictureKind::of_picture("a.exr".as_ref());
/// assert_eq!(kind, Some(PictureKind::Exr));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum PictureKind {
    /// PNG, of 8 or 16 bits a channel.
    Png,
    /// JPEG.
    Jpeg,
    /// WebP without loss.
    WebP,
    /// OpenEXR: linear light of all passes.
    Exr,
    /// PNG pictures whose names have a number.
    Numbered,
    /// An animated GIF.
    Gif,
    /// An animated PNG.
    Apng,
    /// H.264 in MP4.
    Mp4,
}

impl PictureKind {
    /// The kind of a single picture by its file's extension; none for others.
    pub fn of_picture(path: &Path) -> Option<PictureKind> {
        match &*path.extension()?.to_string_lossy().to_lowercase() {
            "png" => Some(PictureKind::Png),
            "jpg" | "jpeg" => Some(PictureKind::Jpeg),
            "webp" => Some(PictureKind::WebP),
            "exr" => Some(PictureKind::Exr),
            _ => None,
        }
    }

    /// Its name in a sentence.
    pub fn name(self) -> &'static str {
        match self {
            PictureKind::Png | PictureKind::Numbered => "a PNG",
            PictureKind::Jpeg => "a JPEG",
            PictureKind::WebP => "a WebP",
            PictureKind::Exr => "an EXR",
            PictureKind::Gif => "a GIF",
            PictureKind::Apng => "an animated PNG",
            PictureKind::Mp4 => "an MP4",
        }
    }

    /// Whether its pixels can be transparent by degrees.
    pub fn has_alpha(self) -> bool {
        matches!(
            self,
            PictureKind::Png
                | PictureKind::Numbered
                | PictureKind::WebP
                | PictureKind::Exr
                | PictureKind::Apng
        )
    }

    /// Whether it is an animation in one file.
    pub fn is_film(self) -> bool {
        matches!(self, PictureKind::Gif | PictureKind::Apng | PictureKind::Mp4)
    }
}
