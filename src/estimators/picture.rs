//! Pictures of a view: its sums over given places of the picture, where a score takes random ones.
//!
//! A pixel is the same sums of the same estimator as the score, so that the mean over the pixels is the score.

use super::nonconvex::{self, NonconvexView};
use super::view::{LUMINANCE, RAYS, SightLine, View};
use super::wavelengths::{MODE_STREAM, Wavelengths};
use super::{BATCHES, EstimatorError, TraceOptics};
use crate::color::cie;
use crate::color::illuminants::Illuminant;
use crate::color::luminance::Tristimulus;
use crate::sampling::kronecker::KroneckerPoints;
use crate::sampling::tally::Tally;
use glam::{DVec2, DVec3, Mat3, Vec3};

/// A line of sight of a picture: its place (trace units, x to the right, y up), and the place of its
/// wavelengths in their strata, 0..1.
pub type PictureSight = (DVec2, f64);

/// A view that a picture can be made of.
pub trait PictureView: Clone + Sync {
    /// Lowest and highest place of the stone in the picture, trace units.
    fn bounds(&self) -> (DVec2, DVec2);

    /// Sums over lines of sight; those that pass the stone by are not counted.
    ///
    /// - `pixel`: number by which random choices in a concavity are drawn
    fn tally(&self, pixel: u64, sights: &[PictureSight]) -> Tally;

    /// The view with wavelengths drawn by a tristimulus value under D65: its luminance is then that value,
    /// as a share of the dome's. Nothing changes for a clear stone.
    fn weighted(self, medium: &TraceOptics, value: Tristimulus) -> Result<Self, EstimatorError>;
}

impl PictureView for View<'_> {
    fn bounds(&self) -> (DVec2, DVec2) {
        let corners = self.stone.solid.vertices.iter().map(|v| self.stone.point_from_design(*v));
        bounds(corners.map(|corner| self.view_frame.project(corner)))
    }

    fn tally(&self, pixel: u64, sights: &[PictureSight]) -> Tally {
        let mut tally = Tally::default();
        let choices = KroneckerPoints::<1>::new(0, MODE_STREAM, pixel, 0..sights.len() as u64);
        let met = sights.iter().zip(choices).filter(|((place, _), _)| self.outline.contains(*place));
        let sight = |((place, hue), [choice]): (&PictureSight, [f64; 1])| SightLine {
            place: self.outline.facet_above(*place),
            hue: *hue,
            choice,
        };
        self.trace_sights(met.map(sight), &mut tally);
        tally
    }

    fn weighted(mut self, medium: &TraceOptics, value: Tristimulus) -> Result<Self, EstimatorError> {
        self.light = Wavelengths::weighted(medium, self.stone.unit, value)?;
        Ok(self)
    }
}

impl PictureView for NonconvexView<'_> {
    fn bounds(&self) -> (DVec2, DVec2) {
        let corners = self.lit.stone.triangles().flat_map(|(_, corners)| corners);
        bounds(corners.map(|corner| self.lit.view_frame.project(corner)))
    }

    fn tally(&self, pixel: u64, sights: &[PictureSight]) -> Tally {
        let mut tally = Tally::default();
        for (number, (place, hue)) in (pixel * sights.len() as u64..).zip(sights) {
            // the streams after those of the batches of a score
            let stream = nonconvex::chance(0, BATCHES as u64, number);
            self.trace_sight(*place, *hue, stream, &mut tally);
        }
        tally
    }

    fn weighted(mut self, medium: &TraceOptics, value: Tristimulus) -> Result<Self, EstimatorError> {
        self.lit.light = Wavelengths::weighted(medium, self.lit.stone.unit, value)?;
        Ok(self)
    }
}

fn bounds(places: impl Iterator<Item = DVec2>) -> (DVec2, DVec2) {
    places.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)))
}

/// A view that also has the colour of the stone.
#[derive(Debug, Clone)]
pub struct ColourView<V> {
    luminance: V,
    /// The views by X and by Z; none for a clear stone, which is grey.
    others: Option<[V; 2]>,
    srgb_from_xyz: Mat3,
}

/// A pixel of a view.
#[derive(Debug, Clone, Default)]
pub struct PictureTally {
    /// The sums of its lines of sight.
    pub tally: Tally,
    /// Colour under the white dome with its dark observer, reflection at entry included, in linear sRGB: the
    /// mean of its lines of sight, white where they see nothing but the dome. Out of the gamut of sRGB a
    /// part is below 0.
    pub srgb: Vec3,
}

impl<V: PictureView> ColourView<V> {
    /// A view of a stone with these optics.
    pub fn new(view: V, medium: &TraceOptics) -> Result<Self, EstimatorError> {
        let weighted = |value| view.clone().weighted(medium, value);
        let others = match medium.material.is_clear() {
            true => None,
            false => Some([weighted(Tristimulus::X)?, weighted(Tristimulus::Z)?]),
        };
        let white = Illuminant::daylight().xyz(|_| 1.0);
        let srgb_from_xyz = cie::to_adapted_srgb(white) * Mat3::from_diagonal(white);
        Ok(ColourView { luminance: view, others, srgb_from_xyz })
    }

    /// Lowest and highest place of the stone in the picture, trace units.
    pub fn bounds(&self) -> (DVec2, DVec2) {
        self.luminance.bounds()
    }

    /// One pixel; arguments as for [`PictureView::tally`].
    pub fn pixel(&self, pixel: u64, sights: &[PictureSight]) -> PictureTally {
        let tally = self.luminance.tally(pixel, sights);
        if tally[RAYS] == 0.0 {
            return PictureTally::default();
        }
        let y = tally[LUMINANCE] / tally[RAYS];
        let srgb = match &self.others {
            None => Vec3::splat(y as f32),
            Some(views) => {
                let [x, z] = views.each_ref().map(|view| view.tally(pixel, sights)[LUMINANCE] / tally[RAYS]);
                self.srgb_from_xyz * DVec3::new(x, y, z).as_vec3()
            }
        };
        PictureTally { tally, srgb }
    }
}
