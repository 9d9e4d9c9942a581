//! Pictures as files: PNG of 8 or 16 bits, EXR with the passes as layers. The command that made a
//! picture is in its metadata; nothing else is, so equal pictures are equal bytes.

use super::film::{Film, Pass, Thing};
use super::tone::Tone;
use crate::optics::colour;
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, Text, WritableImage,
};
use glam::Vec3;

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
}

/// How a picture was made, for its metadata.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Made<'a> {
    /// The command.
    pub command: &'a str,
    /// The rounds of a progressive picture: how far it came.
    pub rounds: Option<u32>,
}

/// Bits a channel of a PNG.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bits {
    /// Eight.
    Eight,
    /// Sixteen.
    Sixteen,
}

/// What a display shows of a film, linear in 0..=1: the picture, or one pass.
pub fn shown(film: &Film, pass: Option<Pass>, tone: &Tone) -> Vec<Vec3> {
    match pass {
        None => film.pixels.iter().map(|p| p.shown.clamp(Vec3::ZERO, Vec3::ONE)).collect(),
        Some(_) => film.linear(pass).into_iter().map(|p| tone.shown(p)).collect(),
    }
}

/// Shown colours as 8-bit sRGB bytes.
pub fn bytes(shown: &[Vec3]) -> Vec<u8> {
    let eight = |x: f32| (colour::srgb_encode(x) * 255.0).round() as u8;
    shown.iter().flat_map(|p| p.to_array().map(eight)).collect()
}

/// A PNG of what [`shown`] gave.
///
/// - `made`: for the metadata; none for a picture that is a part of something
pub fn png(
    shown: &[Vec3],
    width: u32,
    height: u32,
    bits: Bits,
    made: Option<Made>,
) -> Result<Vec<u8>, EncodeError> {
    match bits {
        Bits::Eight => encode(&bytes(shown), width, height, png::BitDepth::Eight, made),
        Bits::Sixteen => {
            let sixteen = |x: f32| ((colour::srgb_encode(x) * 65535.0).round() as u16).to_be_bytes();
            let data: Vec<u8> = shown.iter().flat_map(|p| p.to_array().map(sixteen)).flatten().collect();
            encode(&data, width, height, png::BitDepth::Sixteen, made)
        }
    }
}

/// A PNG of 8-bit RGB bytes, row after row.
pub fn encode_rgb(data: &[u8], width: u32, height: u32) -> Result<Vec<u8>, EncodeError> {
    encode(data, width, height, png::BitDepth::Eight, None)
}

fn encode(
    data: &[u8],
    width: u32,
    height: u32,
    depth: png::BitDepth,
    made: Option<Made>,
) -> Result<Vec<u8>, EncodeError> {
    let mut out = Vec::new();
    let mut encoder = png::Encoder::new(&mut out, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(depth);
    encoder.set_compression(png::Compression::Balanced);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    if let Some(made) = made {
        // iTXt: a STONE's name may hold any letter
        encoder.add_itxt_chunk("Command".into(), made.command.into())?;
        if let Some(rounds) = made.rounds {
            encoder.add_itxt_chunk("Rounds".into(), rounds.to_string())?;
        }
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
pub fn exr(film: &Film, things: &[Thing], made: Made) -> Result<Vec<u8>, EncodeError> {
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
    for (i, letter) in ["X", "Y", "Z"].iter().enumerate() {
        let samples = floats(things.iter().map(|t| t.normal[i]).collect());
        channels.push(AnyChannel::new(text(&format!("normal.{letter}")), samples));
    }
    let facets = FlatSamples::U32(things.iter().map(|t| t.facet).collect());
    channels.push(AnyChannel::new(text("facet.id"), facets));
    channels.push(AnyChannel::new(text("Z"), floats(things.iter().map(|t| t.depth).collect())));
    let rounds = made.rounds.map_or_else(String::new, |n| format!("\nrounds: {n}"));
    let comments = Some(text(&format!("{}{rounds}", made.command)));
    let attributes = LayerAttributes { comments, ..LayerAttributes::default() };
    let size = (film.width as usize, film.height as usize);
    let layer = Layer::new(size, attributes, Encoding::SMALL_LOSSLESS, AnyChannels::sort(channels.into()));
    let mut out = std::io::Cursor::new(Vec::new());
    Image::from_layer(layer).write().non_parallel().to_buffered(&mut out)?;
    Ok(out.into_inner())
}
