//! Animations: what moves from frame to frame, and frames put together as GIF or APNG.

use super::write::EncodeError;
use crate::scene::Scene;
use glam::Mat3;
use image::codecs::gif::{GifEncoder, Repeat};
use image::{Delay, Frame, RgbaImage};
use std::f32::consts::TAU;

/// What moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Turn {
    /// The camera goes around what it looks at.
    #[default]
    Camera,
    /// The stones turn.
    Stone,
    /// The lights go around the first stone.
    Light,
}

impl Turn {
    /// Every choice with its name.
    pub const ALL: [(&'static str, Turn); 3] =
        [("camera", Turn::Camera), ("stone", Turn::Stone), ("light", Turn::Light)];
}

/// How far a rocking goes to each side, degrees.
const ROCK_DEG: f32 = 15.0;

/// The scene at a frame of an endless animation: all the way around the vertical, or rocked to and
/// fro about the picture's horizontal axis.
pub fn at(scene: &Scene, turn: Turn, rock: bool, frame: u32, frames: u32) -> Scene {
    let phase = TAU * frame as f32 / frames as f32;
    let motion = match rock {
        false => Mat3::from_rotation_z(phase),
        true => Mat3::from_axis_angle(scene.camera.right(), ROCK_DEG.to_radians() * phase.sin()),
    };
    let mut moved = scene.clone();
    match turn {
        Turn::Camera => moved.camera = scene.camera.turned(motion),
        Turn::Stone => moved.stones = scene.stones.iter().map(|s| s.turned(motion)).collect(),
        Turn::Light => {
            let centre = scene.stones.first().map_or(scene.camera.target, |s| s.position);
            moved.lights = scene.lights.iter().map(|l| l.turned(motion, centre)).collect();
        }
    }
    moved
}

/// Milliseconds that a frame stays: a turn of 36 takes three seconds, of more no longer than six.
pub fn frame_ms(frames: u32) -> u16 {
    (6000 / frames.max(1)).clamp(20, 83) as u16
}

/// A GIF that repeats for ever.
///
/// - `frames`: 8-bit RGB bytes, row after row
pub fn gif(frames: &[Vec<u8>], width: u32, height: u32) -> Result<Vec<u8>, EncodeError> {
    let mut out = Vec::new();
    let mut encoder = GifEncoder::new_with_speed(&mut out, 5);
    encoder.set_repeat(Repeat::Infinite)?;
    let ms = frame_ms(frames.len() as u32);
    for rgb in frames {
        let rgba: Vec<u8> = rgb.chunks_exact(3).flat_map(|p| [p[0], p[1], p[2], 255]).collect();
        let Some(picture) = RgbaImage::from_raw(width, height, rgba) else { continue };
        let delay = Delay::from_numer_denom_ms(ms.into(), 1);
        encoder.encode_frame(Frame::from_parts(picture, 0, 0, delay))?;
    }
    drop(encoder);
    Ok(out)
}

/// An animated PNG that repeats for ever.
pub fn apng(frames: &[Vec<u8>], width: u32, height: u32, command: &str) -> Result<Vec<u8>, EncodeError> {
    let mut out = Vec::new();
    let mut encoder = png::Encoder::new(&mut out, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Balanced);
    encoder.set_animated(frames.len() as u32, 0)?;
    encoder.set_frame_delay(frame_ms(frames.len() as u32), 1000)?;
    encoder.add_itxt_chunk("Command".into(), command.into())?;
    let mut writer = encoder.write_header()?;
    for rgb in frames {
        writer.write_image_data(rgb)?;
    }
    writer.finish()?;
    Ok(out)
}

/// The RGB bytes of a PNG of ours, if it is one that `command` made, of so many pixels.
pub fn finished_frame(png: &[u8], command: &str, pixels: u32) -> Option<Vec<u8>> {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().ok()?;
    let said = reader.info().utf8_text.iter().find(|t| t.keyword == "Command")?.get_text().ok()?;
    let (width, height) = reader.info().size();
    // before memory is taken for it
    if said != command || width.checked_mul(height) != Some(pixels) {
        return None;
    }
    let mut bytes = vec![0; reader.output_buffer_size()?];
    let info = reader.next_frame(&mut bytes).ok()?;
    bytes.truncate(info.buffer_size());
    Some(bytes)
}
