//! Animations: the motion from frame to frame, and frames put together as GIF or APNG.

use super::image_io::{EncodeError, Provenance};
use crate::scene::{PlacedStone, Scene, Surface};
use glam::{Mat3, Vec3};
use image::codecs::gif::{GifEncoder, Repeat};
use image::{Delay, Frame, RgbaImage};
use serde::{Deserialize, Serialize};
use std::f32::consts::TAU;
use std::io::Write;

/// The moving part of a scene.
///
/// ```
/// use cutlab::advanced::integrators::animation::scene_at;
/// use cutlab::{RenderRequest, Turn};
///
/// let request = RenderRequest::scene("table")?;
/// let scene = request.build(&request.scene_file()?, (64, 48))?;
/// let half_way = scene_at(&scene, Turn::Camera, false, 1, 2);
/// let (a, b) = (scene.camera.position - scene.camera.target, half_way.camera.position - scene.camera.target);
/// assert!((a.truncate() + b.truncate()).length() < 1e-3); // on the other side of its target
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Turn {
    /// The camera goes around its target.
    #[default]
    Camera,
    /// The stones turn.
    Stone,
    /// The lights go around the first stone.
    Light,
    /// The whole piece turns about the first stone: stones and surfaces that are no backdrops.
    All,
}

impl Turn {
    /// Every choice with its name.
    pub const ALL: [(&'static str, Turn); 4] =
        [("camera", Turn::Camera), ("stone", Turn::Stone), ("light", Turn::Light), ("all", Turn::All)];
}

/// How far a rocking goes to each side, degrees.
const ROCK_DEG: f32 = 15.0;

/// The scene at a frame of an endless animation: all the way around the vertical, or rocked to and
/// fro about the picture's horizontal axis.
pub fn scene_at(scene: &Scene, turn: Turn, rock: bool, frame: u32, frames: u32) -> Scene {
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
        Turn::All => piece_turned(&mut moved, motion),
    }
    moved
}

/// Turns stones and what is no backdrop, as one, about the first stone; then lifts or lowers them so that
/// the lowest of them is as high as before.
fn piece_turned(scene: &mut Scene, motion: Mat3) {
    let lowest = |scene: &Scene| {
        let stones = scene.stones.iter().map(PlacedStone::lowest);
        let pieces = scene.surfaces.iter().filter(|s| !s.backdrop).map(Surface::lowest);
        stones.chain(pieces).fold(f32::INFINITY, f32::min)
    };
    let centre = scene.stones.first().map_or(scene.camera.target, |s| s.position);
    let before = lowest(scene);
    scene.stones.iter_mut().for_each(|s| *s = s.moved(motion, centre, Vec3::ZERO));
    let pieces = |scene: &mut Scene, turn: Mat3, lift: Vec3| {
        let moved = scene.surfaces.iter_mut().filter(|s| !s.backdrop);
        moved.for_each(|s| *s = s.moved(turn, centre, lift));
    };
    pieces(scene, motion, Vec3::ZERO);
    let lift = Vec3::Z * (before - lowest(scene));
    if lift.is_finite() && lift != Vec3::ZERO {
        scene.stones.iter_mut().for_each(|s| s.position += lift);
        pieces(scene, Mat3::IDENTITY, lift);
    }
}

/// Duration of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FrameTiming {
    /// Ticks that a frame stays.
    pub ticks: u32,
    /// Ticks in a second.
    pub ticks_per_second: u32,
}

impl FrameTiming {
    /// The duration for a number of frames in a second.
    pub fn of_rate(per_second: u32) -> FrameTiming {
        FrameTiming { ticks: 1, ticks_per_second: per_second.max(1) }
    }

    /// The duration for a full turn of so many frames: it takes three seconds, with more than 36 frames up
    /// to six.
    pub fn of_turn(frames: u32) -> FrameTiming {
        let frames = frames.max(1);
        let ms = if frames <= 36 { 3000 / frames } else { (6000 / frames).clamp(20, 83) };
        FrameTiming { ticks: ms, ticks_per_second: 1000 }
    }

    /// Frames in a second.
    pub fn per_second(&self) -> f32 {
        self.ticks_per_second as f32 / self.ticks.max(1) as f32
    }
}

/// Frames of an animation one after the other, read or made as they are asked for: 8-bit bytes, row
/// after row.
pub type Frames<'a> = dyn Iterator<Item = Result<Vec<u8>, EncodeError>> + 'a;

/// Writes a GIF that repeats for ever.
pub fn gif(
    frames: &mut Frames,
    (width, height): (u32, u32),
    pace: FrameTiming,
    out: &mut dyn Write,
) -> Result<(), EncodeError> {
    let mut encoder = GifEncoder::new_with_speed(out, 5);
    encoder.set_repeat(Repeat::Infinite)?;
    for rgb in frames {
        let rgba: Vec<u8> = rgb?.chunks_exact(3).flat_map(|p| [p[0], p[1], p[2], 255]).collect();
        let Some(picture) = RgbaImage::from_raw(width, height, rgba) else { continue };
        let delay = Delay::from_numer_denom_ms(1000 * pace.ticks, pace.ticks_per_second);
        encoder.encode_frame(Frame::from_parts(picture, 0, 0, delay))?;
    }
    Ok(())
}

/// Writes an animated PNG that repeats for ever.
///
/// - `count`: of the frames; `alpha`: whether they are RGBA rather than RGB
pub fn apng(
    frames: &mut Frames,
    count: u32,
    (width, height): (u32, u32),
    alpha: bool,
    pace: FrameTiming,
    made: Provenance,
    out: &mut dyn Write,
) -> Result<(), EncodeError> {
    let mut encoder = png::Encoder::new(out, width, height);
    encoder.set_color(if alpha { png::ColorType::Rgba } else { png::ColorType::Rgb });
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Balanced);
    encoder.set_animated(count, 0)?;
    encoder.set_frame_delay(pace.ticks as u16, pace.ticks_per_second as u16)?;
    made.note(&mut encoder)?;
    let mut writer = encoder.write_header()?;
    for bytes in frames {
        writer.write_image_data(&bytes?)?;
    }
    writer.finish()?;
    Ok(())
}

/// The bytes of a frame that is a PNG of ours of so many pixels, if it is made from what `identity` says.
pub fn finished_frame(png: &[u8], identity: &str, pixels: u32) -> Option<Vec<u8>> {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().ok()?;
    let said = reader.info().utf8_text.iter().find(|t| t.keyword == "Identity")?.get_text().ok()?;
    let (width, height) = reader.info().size();
    // before memory is taken for it
    if said != identity || width.checked_mul(height) != Some(pixels) {
        return None;
    }
    let mut bytes = vec![0; reader.output_buffer_size()?];
    let info = reader.next_frame(&mut bytes).ok()?;
    bytes.truncate(info.buffer_size());
    Some(bytes)
}
