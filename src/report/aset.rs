//! The ASET picture: a face-up stone, coloured by where the light of each point comes from.
//!
//! Parallel eye straight above, no observer's head, D line, reflection at entry not counted. A
//! point has the colour of its **strongest path**: green from 0–45° above the girdle plane, red
//! from 45–75°, blue from 75–90°, white where the path comes from below the horizon (leakage). A
//! photograph through an ASET scope resembles this map more than a mix by power.

use crate::experiments::view::{Band, band};
use crate::optics::colour::srgb_encode;
use crate::render::write::{EncodeError, encode_rgb};
use crate::walk::{LANES, Packet, Stone};
use glam::{Vec2, Vec3};
use rayon::prelude::*;

/// Points a pixel, on a grid of this side: one packet.
const GRID: usize = 4;
const _: () = assert!(GRID * GRID == LANES);

/// Space around the stone, as a share of the picture's half side.
const MARGIN: f32 = 0.04;

/// A path below this share of the point's light is not looked for.
const STOP_POWER: f32 = 1e-3;

/// One entry of the legend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Key {
    /// The band it stands for.
    pub band: Band,
    /// Its colour in 8-bit sRGB.
    pub colour: [u8; 3],
    /// What it means.
    pub about: &'static str,
}

/// The legend, in the order of [`Band`].
pub const LEGEND: [Key; 4] = [
    Key { band: Band::Green, colour: [34, 150, 62], about: "light from 0–45° above the horizon" },
    Key { band: Band::Red, colour: [214, 36, 36], about: "light from 45–75°" },
    Key {
        band: Band::Blue, colour: [38, 70, 196], about: "light from 75–90°, where the viewer's head is"
    },
    Key { band: Band::Below, colour: [255, 255, 255], about: "leakage: light from below" },
];

const BACKGROUND: [u8; 3] = [214, 217, 221];

/// A finished ASET picture.
#[derive(Debug, Clone)]
pub struct Aset {
    /// The picture as PNG.
    pub png: Vec<u8>,
    /// Share of the outline by [`Band`] of the strongest path, adding up to 1.
    pub shares: [f64; 4],
}

/// Takes the picture: `side` × `side` pixels, 16 points each.
///
/// - `index`: refractive index of the stone
///
/// No random numbers: the same stone gives the same bytes. Shares of the reference stone are
/// checked in `tests/report.rs`.
pub fn picture(stone: &Stone, index: f32, side: u32) -> Result<Aset, EncodeError> {
    let window = Window::around(stone, side);
    let rows: Vec<(Vec<u8>, [u64; 4])> = (0..side)
        .into_par_iter()
        .map(|y| {
            let mut bytes = Vec::with_capacity(side as usize * 3);
            let mut counts = [0; 4];
            for x in 0..side {
                let seen = look(stone, index, std::array::from_fn(|i| window.point(x, y, i)));
                seen.iter().flatten().for_each(|b| counts[*b as usize] += 1);
                bytes.extend(mixed(&seen));
            }
            (bytes, counts)
        })
        .collect();
    let counts: [u64; 4] = std::array::from_fn(|b| rows.iter().map(|(_, c)| c[b]).sum());
    let all = counts.iter().sum::<u64>().max(1) as f64;
    let bytes: Vec<u8> = rows.into_iter().flat_map(|(bytes, _)| bytes).collect();
    Ok(Aset { png: encode_rgb(&bytes, side, side)?, shares: counts.map(|c| c as f64 / all) })
}

/// The square of the girdle plane that the picture shows, in the walking frame, y upward.
struct Window {
    middle: Vec2,
    half: f32,
    pixel: f32,
}

impl Window {
    fn around(stone: &Stone, side: u32) -> Window {
        let (lo, hi) = stone.solid.bounds();
        let (lo, hi) = (stone.from_design(lo).truncate(), stone.from_design(hi).truncate());
        let half = (0.5 * (hi - lo).max_element()) as f32 / (1.0 - MARGIN);
        Window { middle: (0.5 * (lo + hi)).as_vec2(), half, pixel: 2.0 * half / side as f32 }
    }

    /// Point number `i` of pixel (x, y).
    fn point(&self, x: u32, y: u32, i: usize) -> Vec2 {
        let within = |k: usize| (k as f32 + 0.5) / GRID as f32;
        let (x, y) = (x as f32 + within(i % GRID), y as f32 + within(i / GRID));
        self.middle + Vec2::new(x * self.pixel - self.half, self.half - y * self.pixel)
    }
}

/// The band of the strongest path at each point; none beside the stone.
fn look(stone: &Stone, index: f32, points: [Vec2; LANES]) -> [Option<Band>; LANES] {
    let mut packet = Packet::default();
    let mut on_stone = [false; LANES];
    for (lane, p) in points.iter().enumerate() {
        let eye = p.extend(2.0);
        let Some(hit) = stone.hit(eye, Vec3::NEG_Z) else { continue };
        let entry = stone.enter(hit.facet, Vec3::NEG_Z, index);
        let at = eye + Vec3::NEG_Z * hit.distance;
        packet.set(lane, at, entry.direction, 1.0 - entry.reflectance, index);
        on_stone[lane] = true;
    }
    let mut strongest = [0.0f32; LANES];
    let mut from = [Band::Below; LANES];
    if on_stone.contains(&true) {
        stone.walk(&mut packet, STOP_POWER, |meeting, packet| {
            for lane in 0..LANES {
                if meeting.power[lane] > strongest[lane] {
                    strongest[lane] = meeting.power[lane];
                    from[lane] = band(meeting.dz[lane]);
                }
                if packet.power[lane] <= strongest[lane] {
                    packet.power[lane] = 0.0; // no later path can be stronger
                }
            }
        });
    }
    std::array::from_fn(|lane| on_stone[lane].then_some(from[lane]))
}

/// The mean colour of a pixel's points, in linear light.
fn mixed(seen: &[Option<Band>; LANES]) -> [u8; 3] {
    let sum: Vec3 = seen
        .iter()
        .map(|band| Vec3::from_array(band.map_or(BACKGROUND, |b| LEGEND[b as usize].colour).map(linear)))
        .sum();
    (sum / LANES as f32).to_array().map(|c| (srgb_encode(c) * 255.0).round() as u8)
}

/// 8-bit sRGB to linear light. Source: IEC 61966-2-1.
fn linear(byte: u8) -> f32 {
    let x = f32::from(byte) / 255.0;
    if x <= 0.040_45 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_legend_is_in_the_order_of_the_bands_and_colours_come_back() {
        assert!(LEGEND.iter().enumerate().all(|(i, key)| key.band as usize == i));
        for key in LEGEND {
            assert_eq!(mixed(&[Some(key.band); LANES]), key.colour);
        }
        assert_eq!(mixed(&[None; LANES]), BACKGROUND);
    }
}
