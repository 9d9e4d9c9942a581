//! Viewer images, of the face-up stone by where the light of each point comes from: ASET, Ideal-Scope,
//! windows with extinction.
//!
//! Parallel eye straight above, D line, unpolarised at every facet. The scopes give a point the
//! colour of its **strongest path**, reflection at entry not counted: a photograph through a scope
//! resembles this more than a mix by power. The third picture is grey by luminance under a white dome
//! with a dark observer, reflection at entry included.

use crate::color::cie::srgb_encode;
use crate::design::Zone;
use crate::estimators::horizon::is_up;
use crate::estimators::view::{DARK, GIA_OBSERVER_DEG, ObserverDome, SCOPE_DEG, band};
use crate::integrators::image_io::{EncodeError, encode_rgb};
use crate::parallel;
use crate::trace::{ConvexStone, LANES, Packet};
use glam::{Vec2, Vec3};

/// Points a pixel, on a grid of this side: one packet.
const GRID: usize = 4;
const _: () = assert!(GRID * GRID == LANES);

/// Space around the stone, as a share of the picture's half side.
const MARGIN: f32 = 0.04;

/// A path below this share of the point's light is not looked for.
const STOP_POWER: f32 = 1e-3;

/// One entry of a legend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Key {
    /// Its name in a word.
    pub name: &'static str,
    /// Its colour in 8-bit sRGB.
    pub colour: [u8; 3],
    /// What it means.
    pub about: &'static str,
}

/// A way to colour the points of the face-up stone.
#[derive(Debug)]
pub struct ViewerImage {
    /// Its name.
    pub name: &'static str,
    /// The file that a report writes.
    pub file: &'static str,
    /// What a point has the colour of.
    pub about: &'static str,
    /// What the colours mean.
    pub legend: &'static [Key],
    /// The number of a point's key.
    key: fn(&PointView) -> usize,
    /// Whether keyless grey by luminance takes the place of the last key's colour.
    grey: bool,
}

/// What is known of a point of the outline.
#[derive(Debug, Clone, Copy, Default)]
struct PointView {
    on_stone: bool,
    /// Height (sine of the elevation) that the strongest path comes from.
    height: f32,
    /// Whether the strongest path leaves through the first pavilion facet that it meets.
    window: bool,
    /// Per luminance of the dome.
    luminance: f32,
}

/// The colours of the ASET, in the order of [`crate::estimators::view::AsetBand`].
pub static ASET: ViewerImage = ViewerImage {
    name: "ASET",
    file: "aset.png",
    about: "each point has the colour of its strongest path",
    legend: &[
        Key { name: "green", colour: [34, 150, 62], about: "light from 0–45° above the horizon" },
        Key { name: "red", colour: [214, 36, 36], about: "light from 45–75°" },
        Key {
            name: "blue", colour: [38, 70, 196], about: "light from 75–90°, where the viewer's head is"
        },
        Key { name: "leak", colour: [255, 255, 255], about: "leakage: light from below" },
    ],
    key: |p| band(p.height) as usize,
    grey: false,
};

/// The colours of the Ideal-Scope.
pub static IDEAL_SCOPE: ViewerImage = ViewerImage {
    name: "Ideal-Scope",
    file: "ideal-scope.png",
    about: "each point has the colour of its strongest path",
    legend: &[
        Key { name: "red", colour: [214, 36, 60], about: "light from above the horizon" },
        Key {
            name: "black", colour: [20, 20, 24], about: "light from within 12° of the zenith: the viewer"
        },
        Key { name: "white", colour: [255, 255, 255], about: "leakage: light from below" },
    ],
    key: |p| {
        if !is_up(p.height) {
            2
        } else {
            usize::from(!ObserverDome::with_observer(SCOPE_DEG).is_bright(p.height))
        }
    },
    grey: false,
};

/// Windowing and extinction over luminance.
pub static WINDOWS: ViewerImage = ViewerImage {
    name: "Windows and extinction",
    file: "windows.png",
    about: "under a white dome with a dark observer of 23°",
    legend: &[
        Key { name: "window", colour: [232, 160, 40], about: "window: one looks straight out of the bottom" },
        Key { name: "extinct", colour: [30, 34, 96], about: "extinction: darker than a tenth of the dome" },
        Key { name: "lit", colour: [190, 190, 190], about: "the rest, as bright as it is" },
    ],
    key: |p| if p.window { 0 } else { 1 + usize::from(p.luminance >= DARK) },
    grey: true,
};

/// Every scope, in the order of a page.
pub static VIEWER_IMAGES: [&ViewerImage; 3] = [&ASET, &IDEAL_SCOPE, &WINDOWS];

const BACKGROUND: [u8; 3] = [214, 217, 221];

/// A finished picture.
#[derive(Debug, Clone)]
pub struct ViewerPicture {
    /// What the colours are.
    pub scope: &'static ViewerImage,
    /// The picture as PNG.
    pub png: Vec<u8>,
    /// Share of the outline by key of the legend, adding up to 1.
    pub shares: Vec<f64>,
    /// Whether the stone absorbs, which the picture does not show, though the scores do.
    pub without_colour: bool,
}

/// Takes one picture through each scope: `side` × `side` pixels, 16 points each.
///
/// - `index`: refractive index of the stone
///
/// No random numbers: the same stone gives the same bytes. Shares of the reference stone are
/// checked in `tests/report.rs`.
pub fn pictures(
    stone: &ConvexStone,
    index: f32,
    scopes: &[&'static ViewerImage],
    side: u32,
) -> Result<Vec<ViewerPicture>, EncodeError> {
    let window = PictureWindow::around(stone, side);
    let zones = stone.planes.iter().map(|p| Zone::from_normal(p.normal));
    let pavilion: Vec<bool> = zones.map(|z| matches!(z, Zone::Pavilion | Zone::Culet)).collect();
    let rows: Vec<Vec<PixelRow>> = parallel::map(side as usize, |y| {
        let fresh = |s: &&ViewerImage| PixelRow { bytes: Vec::new(), counts: vec![0; s.legend.len()] };
        let mut rows: Vec<PixelRow> = scopes.iter().map(fresh).collect();
        for x in 0..side {
            let points = std::array::from_fn(|i| window.point(x, y as u32, i));
            let seen = trace_points(stone, &pavilion, index, points);
            rows.iter_mut().zip(scopes).for_each(|(row, scope)| row.push(scope, &seen));
        }
        rows
    });
    let picture = |(i, scope): (usize, &&'static ViewerImage)| {
        let counts: Vec<u64> =
            (0..scope.legend.len()).map(|k| rows.iter().map(|r| r[i].counts[k]).sum()).collect();
        let all = counts.iter().sum::<u64>().max(1) as f64;
        let bytes: Vec<u8> = rows.iter().flat_map(|r| &r[i].bytes).copied().collect();
        Ok(ViewerPicture {
            scope,
            png: encode_rgb(&bytes, side, side)?,
            shares: counts.into_iter().map(|c| c as f64 / all).collect(),
            without_colour: false,
        })
    };
    scopes.iter().enumerate().map(picture).collect()
}

/// A row of pixels through one scope.
struct PixelRow {
    bytes: Vec<u8>,
    counts: Vec<u64>,
}

impl PixelRow {
    fn push(&mut self, scope: &ViewerImage, seen: &[PointView; LANES]) {
        seen.iter().filter(|p| p.on_stone).for_each(|p| self.counts[(scope.key)(p)] += 1);
        self.bytes.extend(scope.mixed(seen));
    }
}

impl ViewerImage {
    /// The mean colour of a pixel's points, in linear light.
    fn mixed(&self, seen: &[PointView; LANES]) -> [u8; 3] {
        let sum: Vec3 = seen.iter().map(|p| self.light(p)).sum();
        (sum / LANES as f32).to_array().map(|c| (srgb_encode(c) * 255.0).round() as u8)
    }

    /// The colour of a point, in linear light.
    fn light(&self, point: &PointView) -> Vec3 {
        let shown = |bytes: [u8; 3]| Vec3::from_array(bytes.map(linear));
        if !point.on_stone {
            return shown(BACKGROUND);
        }
        match (self.key)(point) {
            last if self.grey && last + 1 == self.legend.len() => Vec3::splat(point.luminance.min(1.0)),
            key => shown(self.legend[key].colour),
        }
    }
}

/// The square of the girdle plane that the picture shows, in the trace frame, y upward.
struct PictureWindow {
    middle: Vec2,
    half: f32,
    pixel: f32,
}

impl PictureWindow {
    fn around(stone: &ConvexStone, side: u32) -> PictureWindow {
        let (lo, hi) = stone.solid.bounds();
        let (lo, hi) = (stone.point_from_design(lo).truncate(), stone.point_from_design(hi).truncate());
        let half = (0.5 * (hi - lo).max_element()) as f32 / (1.0 - MARGIN);
        PictureWindow { middle: (0.5 * (lo + hi)).as_vec2(), half, pixel: 2.0 * half / side as f32 }
    }

    /// Point number `i` of pixel (x, y).
    fn point(&self, x: u32, y: u32, i: usize) -> Vec2 {
        let within = |k: usize| (k as f32 + 0.5) / GRID as f32;
        let (x, y) = (x as f32 + within(i % GRID), y as f32 + within(i / GRID));
        self.middle + Vec2::new(x * self.pixel - self.half, self.half - y * self.pixel)
    }
}

/// What is seen at each point.
fn trace_points(
    stone: &ConvexStone,
    pavilion: &[bool],
    index: f32,
    points: [Vec2; LANES],
) -> [PointView; LANES] {
    let dome = ObserverDome::with_observer(GIA_OBSERVER_DEG);
    let mut packet = Packet::default();
    let mut seen = [PointView::default(); LANES];
    for (lane, p) in points.iter().enumerate() {
        let eye = p.extend(2.0);
        let Some(hit) = stone.intersect(eye, Vec3::NEG_Z) else { continue };
        let entry = stone.refract_into(hit.facet, Vec3::NEG_Z, index);
        let at = eye + Vec3::NEG_Z * hit.distance;
        packet.load(lane, at, entry.direction, 1.0 - entry.reflectance, index);
        seen[lane] = PointView { on_stone: true, luminance: dome.mirrored(&entry), ..PointView::default() };
    }
    if !seen.iter().any(|p| p.on_stone) {
        return seen;
    }
    let mut strongest = [0.0f32; LANES];
    let mut been_below = [false; LANES];
    stone.trace(&mut packet, STOP_POWER, |interaction, _| {
        for (lane, point) in seen.iter_mut().enumerate() {
            let (power, height) = (interaction.power[lane], interaction.dz[lane]);
            let below = pavilion[interaction.facet[lane] as usize];
            if power > strongest[lane] {
                strongest[lane] = power;
                point.height = height;
                point.window = below && !been_below[lane];
            }
            been_below[lane] |= below;
            point.luminance += if dome.is_bright(height) { power } else { 0.0 };
        }
    });
    seen
}

/// 8-bit sRGB to linear light. Source: IEC 61966-2-1.
fn linear(byte: u8) -> f32 {
    let x = f32::from(byte) / 255.0;
    if x <= 0.040_45 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimators::view::AsetBand;

    #[test]
    fn the_legend_of_the_aset_is_in_the_order_of_the_bands_and_colours_come_back() {
        for (height, band) in
            [(0.3, AsetBand::Green), (0.8, AsetBand::Red), (0.99, AsetBand::Blue), (-0.5, AsetBand::Below)]
        {
            let point = PointView { on_stone: true, height, ..PointView::default() };
            assert_eq!(ASET.mixed(&[point; LANES]), ASET.legend[band as usize].colour);
        }
        assert_eq!(ASET.mixed(&[PointView::default(); LANES]), BACKGROUND);
    }
}
