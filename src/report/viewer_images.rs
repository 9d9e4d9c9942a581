//! Viewer images, of the face-up stone by where the light of each point comes from: ASET, Ideal-Scope,
//! windows with extinction, brightness.
//!
//! A pixel is the sums of its lines of sight that the scores beside it are the sums of: same estimator,
//! polarisation, observer, and wavelengths of a stone that absorbs. The ASET of a convex stone gives each
//! point the colour of its **strongest path**, reflection at entry not counted, which keeps its colours
//! apart; the Ideal-Scope mixes its colours by power, as a photograph does.

use crate::color::cie::{srgb_decode, srgb_encode};
use crate::estimators::nonconvex::NonconvexView;
use crate::estimators::picture::{ColourView, PictureSight, PictureTally, PictureView};
use crate::estimators::view::{
    BANDS, BELOW, DARK_RAYS, LUMINANCE, RAYS, SCOPE_BRIGHT, SCOPE_DARK, STRONGEST, WINDOWED,
};
use crate::estimators::{EstimatorError, View};
use crate::integrators::image_io::{EncodeError, encode_rgb};
use crate::parallel;
use crate::sampling::tally::Tally;
use crate::scoring::score::{ScoreInput, ScoreRequest, StoneShape};
use crate::trace::ConvexStone;
use crate::trace::nonconvex::{MeshError, MeshStone};
use glam::{DVec2, Vec3};

/// Points a pixel, on a grid of this side.
const GRID: usize = 4;

/// Space around the stone, as a share of the picture's half side.
const MARGIN: f64 = 0.04;

/// Most keys of a legend.
const KEYS: usize = 4;

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
    /// Whether stones that are not convex have it, whose single rays have no strongest path.
    pub nonconvex: bool,
    /// Σ over lines of sight of what each key stands for.
    amounts: fn(&Tally) -> [f64; KEYS],
    /// Lines of sight that show the stone's own light, in place of the last key's colour; none if every key
    /// has its colour.
    lit: Option<fn(&Tally) -> f64>,
}

/// Why there are no pictures.
#[derive(Debug, thiserror::Error)]
pub enum ViewerImageError {
    /// The stone has no shape; with the reason.
    #[error("{0}")]
    Shape(String),
    /// The mesh cannot be traced.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The stone cannot be lit.
    #[error(transparent)]
    Light(#[from] EstimatorError),
    /// A picture could not be encoded.
    #[error(transparent)]
    Encode(#[from] EncodeError),
}

const RED: [u8; 3] = [214, 36, 36];
const WHITE: [u8; 3] = [255, 255, 255];

/// The colours of the ASET, in the order of [`crate::estimators::view::AsetBand`].
pub static ASET: ViewerImage = ViewerImage {
    name: "ASET",
    file: "aset.png",
    about: "each point has the colour of its strongest path",
    legend: &[
        Key { name: "green", colour: [34, 150, 62], about: "light from 0–45° above the horizon" },
        Key { name: "red", colour: RED, about: "light from 45–75°" },
        Key {
            name: "blue", colour: [38, 70, 196], about: "light from 75–90°, where the viewer's head is"
        },
        Key { name: "leak", colour: WHITE, about: "leakage: light from below" },
    ],
    nonconvex: false,
    amounts: |t| STRONGEST.map(|band| t[band]),
    lit: None,
};

/// The colours of the ASET mixed by power, for stones that are not convex.
pub static ASET_BY_POWER: ViewerImage = ViewerImage {
    about: "each point mixes the colours of its light by power; absorbed or mirrored at entry it is dark",
    nonconvex: true,
    amounts: |t| BANDS.map(|band| t[band]),
    ..ASET
};

/// The colours of the Ideal-Scope.
pub static IDEAL_SCOPE: ViewerImage = ViewerImage {
    name: "Ideal-Scope",
    file: "ideal-scope.png",
    about: "each point mixes the colours of its light by power; absorbed or mirrored at entry it is dark",
    legend: &[
        Key { name: "red", colour: [214, 36, 60], about: "light from above the horizon" },
        Key {
            name: "black",
            colour: [20, 20, 24],
            about: "light from the dark cone about the zenith: the viewer",
        },
        Key { name: "white", colour: WHITE, about: "leakage: light from below" },
    ],
    nonconvex: true,
    amounts: |t| [t[SCOPE_BRIGHT], t[SCOPE_DARK], t[BELOW], 0.0],
    lit: None,
};

/// Windowing and extinction over the light of the stone.
pub static WINDOWS: ViewerImage = ViewerImage {
    name: "Windows and extinction",
    file: "windows.png",
    about: "under a white dome with a dark observer",
    legend: &[
        Key { name: "window", colour: [232, 160, 40], about: "window: one looks straight out of the bottom" },
        Key { name: "extinct", colour: [30, 34, 96], about: "extinction: darker than a tenth of the dome" },
        Key { name: "lit", colour: [190, 190, 190], about: "the rest, as bright as it is" },
    ],
    nonconvex: false,
    amounts: |t| [t[WINDOWED], t[DARK_RAYS], t[RAYS] - t[WINDOWED] - t[DARK_RAYS], 0.0],
    lit: Some(|t| t[RAYS] - t[WINDOWED] - t[DARK_RAYS]),
};

/// The light of the stone itself.
pub static BRIGHTNESS: ViewerImage = ViewerImage {
    name: "Brightness",
    file: "brightness.png",
    about: "the stone as it looks under a white dome with a dark observer",
    legend: &[Key { name: "brightness", colour: [190, 190, 190], about: "mean luminance, of the dome's" }],
    nonconvex: true,
    amounts: |t| [t[LUMINANCE], 0.0, 0.0, 0.0],
    lit: Some(|t| t[RAYS]),
};

/// Every image of a convex stone, in the order of a page.
pub static VIEWER_IMAGES: [&ViewerImage; 4] = [&ASET, &IDEAL_SCOPE, &WINDOWS, &BRIGHTNESS];

/// Every image of a stone that is not convex.
pub static NONCONVEX_IMAGES: [&ViewerImage; 3] = [&ASET_BY_POWER, &IDEAL_SCOPE, &BRIGHTNESS];

const BACKGROUND: [u8; 3] = [214, 217, 221];

/// A finished picture.
#[derive(Debug, Clone)]
pub struct ViewerPicture {
    /// What the colours are.
    pub scope: &'static ViewerImage,
    /// The picture as PNG.
    pub png: Vec<u8>,
    /// What each key of the legend stands for, as a mean over the outline: the scores, on a grid of points.
    pub shares: Vec<f64>,
}

/// Takes the pictures of a stone: `side` × `side` pixels, 16 points each; of one that is not convex those
/// that it has.
///
/// - `subject`, `plan`: those of the scores; of the plan its polarisation, its observer, and how far rays
///   are followed
///
/// The same arguments give the same bytes on any number of threads. Shares are checked against the scores
/// in `tests/program/report.rs`.
pub fn pictures(
    subject: &ScoreInput,
    plan: &ScoreRequest,
    side: u32,
) -> Result<Vec<ViewerPicture>, ViewerImageError> {
    let setup = subject.setup(plan);
    match &subject.shape {
        Ok(StoneShape::Convex(solid)) => {
            let stone = ConvexStone::new(solid.clone());
            let view = ColourView::new(View::in_setup(&stone, &setup)?, &setup.medium)?;
            Ok(draw(&view, &VIEWER_IMAGES, side)?)
        }
        Ok(StoneShape::Nonconvex(body)) => {
            let stone = MeshStone::new(&body.mesh())?;
            let view = ColourView::new(NonconvexView::in_setup(&stone, &setup)?, &setup.medium)?;
            Ok(draw(&view, &NONCONVEX_IMAGES, side)?)
        }
        Err(why) => Err(ViewerImageError::Shape(why.clone())),
    }
}

fn draw<V: PictureView>(
    view: &ColourView<V>,
    images: &[&'static ViewerImage],
    side: u32,
) -> Result<Vec<ViewerPicture>, EncodeError> {
    let window = PictureWindow::around(view.bounds(), side);
    let rows: Vec<Vec<PixelRow>> = parallel::map(side as usize, |y| {
        let mut rows = vec![PixelRow::default(); images.len()];
        for x in 0..side {
            let number = y as u64 * u64::from(side) + u64::from(x);
            let sights: [PictureSight; POINTS] = std::array::from_fn(|i| window.sight(x, y as u32, i));
            let pixel = view.pixel(number, &sights);
            rows.iter_mut().zip(images).for_each(|(row, image)| row.push(image, &pixel));
        }
        rows
    });
    let picture = |(i, scope): (usize, &&'static ViewerImage)| {
        let rows = || rows.iter().map(|row| &row[i]);
        let rays = rows().map(|row| row.rays).sum::<f64>();
        let share = |key: usize| rows().map(|row| row.amounts[key]).sum::<f64>() / rays.max(1.0);
        let bytes: Vec<u8> = rows().flat_map(|row| &row.bytes).copied().collect();
        let shares = (0..scope.legend.len()).map(share).collect();
        Ok(ViewerPicture { scope, png: encode_rgb(&bytes, side, side)?, shares })
    };
    images.iter().enumerate().map(picture).collect()
}

/// Points a pixel.
const POINTS: usize = GRID * GRID;

/// A row of pixels of one image.
#[derive(Debug, Clone, Default)]
struct PixelRow {
    bytes: Vec<u8>,
    amounts: [f64; KEYS],
    rays: f64,
}

impl PixelRow {
    fn push(&mut self, image: &ViewerImage, pixel: &PictureTally) {
        for (sum, amount) in self.amounts.iter_mut().zip((image.amounts)(&pixel.tally)) {
            *sum += amount;
        }
        self.rays += pixel.tally[RAYS];
        self.bytes.extend(image.colour(pixel));
    }
}

impl ViewerImage {
    /// The colour of a pixel, mixed in linear light.
    fn colour(&self, pixel: &PictureTally) -> [u8; 3] {
        let linear = |bytes: [u8; 3]| Vec3::from_array(bytes.map(|b| srgb_decode(f32::from(b) / 255.0)));
        let tally = &pixel.tally;
        let mut sum = linear(BACKGROUND) * (POINTS as f64 - tally[RAYS]) as f32;
        let coloured = self.legend.len() - usize::from(self.lit.is_some());
        for (key, amount) in self.legend[..coloured].iter().zip((self.amounts)(tally)) {
            sum += linear(key.colour) * amount as f32;
        }
        if let Some(lit) = self.lit {
            sum += pixel.srgb * lit(tally) as f32;
        }
        (sum / POINTS as f32).to_array().map(|c| (srgb_encode(c) * 255.0).round() as u8)
    }
}

/// The square of the view that a picture shows.
struct PictureWindow {
    middle: DVec2,
    half: f64,
    pixel: f64,
}

impl PictureWindow {
    fn around((low, high): (DVec2, DVec2), side: u32) -> PictureWindow {
        let half = 0.5 * (high - low).max_element() / (1.0 - MARGIN);
        PictureWindow { middle: 0.5 * (low + high), half, pixel: 2.0 * half / f64::from(side) }
    }

    /// Line of sight number `i` of pixel (x, y).
    fn sight(&self, x: u32, y: u32, i: usize) -> PictureSight {
        let within = |k: usize| (k as f64 + 0.5) / GRID as f64;
        let (x, y) = (f64::from(x) + within(i % GRID), f64::from(y) + within(i / GRID));
        let place = self.middle + DVec2::new(x * self.pixel - self.half, self.half - y * self.pixel);
        // wavelengths of neighbouring points lie far apart: the bits of the number in reverse
        let reversed = (i as u32).reverse_bits() >> (u32::BITS - POINTS.ilog2());
        (place, (f64::from(reversed) + 0.5) / POINTS as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimators::view::AsetBand;

    #[test]
    fn the_legend_of_the_aset_is_in_the_order_of_the_bands_and_colours_come_back() {
        for band in [AsetBand::Green, AsetBand::Red, AsetBand::Blue, AsetBand::Below] {
            let all = POINTS as f64;
            let tally = Tally::of(&[(RAYS, all), (STRONGEST[band as usize], all)]);
            let pixel = PictureTally { tally, ..PictureTally::default() };
            let key = ASET.legend[band as usize];
            assert_eq!(ASET.colour(&pixel), key.colour);
            let names = [(AsetBand::Green, "green"), (AsetBand::Red, "red"), (AsetBand::Blue, "blue")];
            let name = names.iter().find(|(b, _)| *b == band).map_or("leak", |(_, name)| name);
            assert_eq!(key.name, name);
        }
        assert_eq!(ASET.colour(&PictureTally::default()), BACKGROUND);
    }

    #[test]
    fn lines_of_sight_of_a_pixel_have_every_stratum_of_wavelengths_once() {
        let window = PictureWindow::around((DVec2::NEG_ONE, DVec2::ONE), 8);
        let mut strata: Vec<usize> = (0..POINTS).map(|i| (window.sight(3, 4, i).1 * 16.0) as usize).collect();
        strata.sort_unstable();
        assert_eq!(strata, (0..POINTS).collect::<Vec<_>>());
    }
}
