//! Image files: PNG of 8 or 16 bits, EXR with the passes as layers, JPEG and WebP. The command
//! and the request that made a picture and the program's version are in the metadata of PNG and EXR; nothing else
//! is, so equal pictures are equal bytes.

use super::film::{Film, FirstHit, Pass, Pixel};
use super::tone::Tone;
use crate::color::cie;
use exr::meta::attribute::AttributeValue;
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, Text, WritableImage,
};
use glam::{Vec3, Vec4};
use image::ExtendedColorType;
use image::codecs::{jpeg::JpegEncoder, webp::WebPEncoder};
use serde::Serialize;

/// A picture that could not be encoded.
#[derive(Debug, thiserror::Error)]
pub enum EncodeError {
    /// As PNG.
    #[error("cannot encode the picture: {0}")]
    Png(#[from] png::EncodingError),
    /// As GIF.
    #[error("cannot encode the picture: {0}")]
    Gif(#[from] image::ImageError),
    /// As EXR.
    #[error("cannot encode the picture: {0}")]
    Exr(#[from] exr::error::Error),
    /// As H.264.
    #[error("cannot encode the film: {0}")]
    H264(#[from] openh264::Error),
    /// As MP4.
    #[error("cannot encode the film: {0}")]
    Mp4(#[from] mp4_atom::Error),
    /// A frame that was made is not there any more.
    #[error("frame {0} was taken away or changed while the animation was made: start it again")]
    Frame(u32),
    /// The encoded bytes could not be written.
    #[error(transparent)]
    Write(#[from] std::io::Error),
}

/// The program that makes the pictures, for their metadata.
pub const PROGRAM: &str = concat!("cutlab ", env!("CARGO_PKG_VERSION"));

/// How a picture was made, for its metadata.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Provenance<'a> {
    /// The command.
    pub command: &'a str,
    /// Hash of the canonical request.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub request: Option<&'a str>,
    /// What a frame of an animation is made from: the request, the program and the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub identity: Option<&'a str>,
    /// The rounds of a progressive picture: how far it came.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rounds: Option<u32>,
}

/// The attribute of an EXR's layer that has its [`Provenance`] as JSON.
pub const EXR_ATTRIBUTE: &str = "cutlab";

impl Provenance<'_> {
    /// Writes it into a PNG. The texts are iTXt: a STONE's name may hold any letter.
    pub(super) fn note<W: std::io::Write>(&self, png: &mut png::Encoder<W>) -> Result<(), EncodeError> {
        png.add_itxt_chunk("Software".into(), PROGRAM.into())?;
        png.add_itxt_chunk("Command".into(), self.command.into())?;
        for (keyword, text) in [("Request", self.request), ("Identity", self.identity)] {
            if let Some(text) = text {
                png.add_itxt_chunk(keyword.into(), text.into())?;
            }
        }
        if let Some(rounds) = self.rounds {
            png.add_itxt_chunk("Rounds".into(), rounds.to_string())?;
        }
        Ok(())
    }
}

/// Bits a channel of a PNG.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bits {
    /// Eight.
    Eight,
    /// Sixteen.
    Sixteen,
}

/// Display colours of a film, linear in 0..=1: the picture, or one pass.
pub fn display_rgb(film: &Film, pass: Option<Pass>, tone: &Tone) -> Vec<Vec3> {
    match pass {
        None => film.pixels.iter().map(|p| p.display.clamp(Vec3::ZERO, Vec3::ONE)).collect(),
        Some(_) => film.linear(pass).into_iter().map(|p| tone.display_rgb(p)).collect(),
    }
}

/// Shown colours as 8-bit sRGB bytes.
pub fn bytes(shown: &[Vec3]) -> Vec<u8> {
    let eight = |x: f32| (cie::srgb_encode(x) * 255.0).round() as u8;
    shown.iter().flat_map(|p| p.to_array().map(eight)).collect()
}

/// A PNG of what [`display_rgb`] gave.
///
/// - `made`: for the metadata; none for a picture that is a part of something
pub fn png(
    shown: &[Vec3],
    width: u32,
    height: u32,
    bits: Bits,
    made: Option<Provenance>,
) -> Result<Vec<u8>, EncodeError> {
    let form = |depth| (png::ColorType::Rgb, depth);
    match bits {
        Bits::Eight => encode(&bytes(shown), width, height, form(png::BitDepth::Eight), made),
        Bits::Sixteen => {
            let data: Vec<u8> = shown.iter().flat_map(|p| p.to_array().map(sixteen)).flatten().collect();
            encode(&data, width, height, form(png::BitDepth::Sixteen), made)
        }
    }
}

fn sixteen(x: f32) -> [u8; 2] {
    sixteen_linear(cie::srgb_encode(x))
}

fn sixteen_linear(x: f32) -> [u8; 2] {
    ((x.clamp(0.0, 1.0) * 65535.0).round() as u16).to_be_bytes()
}

/// Display colours of a film that leaves its background out: linear colours, not premultiplied, and the
/// share of each pixel that is covered.
pub fn cut_out(film: &Film) -> Vec<Vec4> {
    let straight = |p: &Pixel| {
        let straight = (p.display / p.alpha).clamp(Vec3::ZERO, Vec3::ONE);
        if p.alpha > 0.0 { straight.extend(p.alpha.min(1.0)) } else { Vec4::ZERO }
    };
    film.pixels.iter().map(straight).collect()
}

/// Display colours of such a film before a background of one colour.
///
/// - `colour`: linear sRGB
pub fn over_background(film: &Film, colour: Vec3) -> Vec<Vec3> {
    film.pixels.iter().map(|p| (p.display + (1.0 - p.alpha) * colour).min(Vec3::ONE)).collect()
}

/// What [`cut_out`] gave as 8-bit RGBA bytes: colours in sRGB, coverage as it is.
pub fn rgba_bytes(shown: &[Vec4]) -> Vec<u8> {
    let alpha = |a: f32| (a.clamp(0.0, 1.0) * 255.0).round() as u8;
    let colours = bytes(&shown.iter().map(|p| p.truncate()).collect::<Vec<_>>());
    colours.chunks_exact(3).zip(shown).flat_map(|(c, p)| [c[0], c[1], c[2], alpha(p.w)]).collect()
}

/// A PNG with alpha of what [`cut_out`] gave.
pub fn rgba_png(
    shown: &[Vec4],
    width: u32,
    height: u32,
    bits: Bits,
    made: Option<Provenance>,
) -> Result<Vec<u8>, EncodeError> {
    let (data, depth) = match bits {
        Bits::Eight => (rgba_bytes(shown), png::BitDepth::Eight),
        Bits::Sixteen => {
            let pixel = |p: &Vec4| [sixteen(p.x), sixteen(p.y), sixteen(p.z), sixteen_linear(p.w)];
            (shown.iter().flat_map(pixel).flatten().collect(), png::BitDepth::Sixteen)
        }
    };
    encode(&data, width, height, (png::ColorType::Rgba, depth), made)
}

/// A JPEG of 8-bit RGB bytes, row after row.
pub fn jpeg(data: &[u8], width: u32, height: u32) -> Result<Vec<u8>, EncodeError> {
    /// Of 100: without blocks to be seen around facets' edges.
    const QUALITY: u8 = 92;
    let mut out = Vec::new();
    JpegEncoder::new_with_quality(&mut out, QUALITY).encode(data, width, height, ExtendedColorType::Rgb8)?;
    Ok(out)
}

/// A lossless WebP of 8-bit RGB or RGBA bytes, row after row.
pub fn webp(data: &[u8], width: u32, height: u32, alpha: bool) -> Result<Vec<u8>, EncodeError> {
    let colours = if alpha { ExtendedColorType::Rgba8 } else { ExtendedColorType::Rgb8 };
    let mut out = Vec::new();
    WebPEncoder::new_lossless(&mut out).encode(data, width, height, colours)?;
    Ok(out)
}

/// A PNG of 8-bit RGB bytes, row after row.
pub fn encode_rgb(data: &[u8], width: u32, height: u32) -> Result<Vec<u8>, EncodeError> {
    encode(data, width, height, (png::ColorType::Rgb, png::BitDepth::Eight), None)
}

fn encode(
    data: &[u8],
    width: u32,
    height: u32,
    (colour, depth): (png::ColorType, png::BitDepth),
    made: Option<Provenance>,
) -> Result<Vec<u8>, EncodeError> {
    let mut out = Vec::new();
    let mut encoder = png::Encoder::new(&mut out, width, height);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    encoder.set_compression(png::Compression::Balanced);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    if let Some(made) = made {
        made.note(&mut encoder)?;
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(data)?;
    writer.finish()?;
    Ok(out)
}

/// EXR's text is Latin-1; other letters become question marks.
fn text(text: &str) -> Text {
    let latin: String = text.chars().map(|c| if (c as u32) < 256 { c } else { '?' }).collect();
    Text::new_or_none(latin).unwrap_or_default()
}

/// An OpenEXR file: the picture and its passes, linear and unclamped; depth, facet and normal of
/// the middle of each pixel.
///
/// - `alpha`: whether the film leaves its background out: it then has the channel `A`, by which colours
///   are premultiplied
pub fn exr(film: &Film, things: &[FirstHit], alpha: bool, made: Provenance) -> Result<Vec<u8>, EncodeError> {
    let floats = |values: Vec<f32>| FlatSamples::F32(values);
    let mut channels: Vec<AnyChannel<FlatSamples>> = Vec::new();
    let mut colour = |prefix: &str, values: &[Vec3]| {
        for (i, letter) in ["R", "G", "B"].iter().enumerate() {
            let name = format!("{prefix}{letter}");
            let samples = floats(values.iter().map(|p| p[i]).collect());
            channels.push(AnyChannel::new(text(&name), samples));
        }
    };
    colour("", &film.linear(None));
    for (pass, name) in Pass::ALL {
        colour(&format!("{name}."), &film.linear(Some(pass)));
    }
    if alpha {
        channels.push(AnyChannel::new(text("A"), floats(film.pixels.iter().map(|p| p.alpha).collect())));
    }
    for (i, letter) in ["X", "Y", "Z"].iter().enumerate() {
        let samples = floats(things.iter().map(|t| t.normal[i]).collect());
        channels.push(AnyChannel::new(text(&format!("normal.{letter}")), samples));
    }
    let facets = FlatSamples::U32(things.iter().map(|t| t.facet).collect());
    channels.push(AnyChannel::new(text("facet.id"), facets));
    channels.push(AnyChannel::new(text("Z"), floats(things.iter().map(|t| t.depth).collect())));
    let rounds = made.rounds.map_or_else(String::new, |n| format!("\nrounds: {n}"));
    let comments = Some(text(&format!("{}{rounds}", made.command)));
    let software_name = Some(text(PROGRAM));
    let json = AttributeValue::Text(text(&serde_json::to_string(&made).unwrap_or_default()));
    let other = [(text(EXR_ATTRIBUTE), json)].into();
    let attributes = LayerAttributes { comments, software_name, other, ..LayerAttributes::default() };
    let size = (film.width as usize, film.height as usize);
    let layer = Layer::new(size, attributes, Encoding::SMALL_LOSSLESS, AnyChannels::sort(channels.into()));
    let mut out = std::io::Cursor::new(Vec::new());
    Image::from_layer(layer).write().non_parallel().to_buffered(&mut out)?;
    Ok(out.into_inner())
}
