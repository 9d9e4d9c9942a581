//! Wavelengths in which stones are scored: the D line for a clear one, daylight for one that absorbs.

pub(super) use super::trace_optics::LINES_PER_RAY;
use super::{EstimatorError, LineOptics, TraceOptics};
use crate::color::luminance::{self, Tristimulus};
use crate::optics::dispersion::lines;
use crate::sampling::kronecker::KroneckerPoints;
use crate::sampling::random::Purpose;
use glam::DVec3;
use std::ops::Range;

/// Wavelengths of the scores of stones that absorb, one stream a batch.
pub(super) const HUE_STREAM: Purpose = Purpose::named("score hue");

/// Modes of the light of scores in doubly refracting stones, one stream a batch.
pub(super) const MODE_STREAM: Purpose = Purpose::named("score mode");

/// For each ray of a batch two numbers, uniform in 0..1: the place of its wavelengths, and what chooses its modes.
#[derive(Debug, Clone)]
pub(super) struct LightPoints {
    hues: KroneckerPoints<1>,
    modes: KroneckerPoints<1>,
}

impl LightPoints {
    /// Of some points of a batch.
    pub(super) fn new(seed: u64, batch: u64, points: Range<u64>) -> LightPoints {
        let hues = KroneckerPoints::new(seed, HUE_STREAM, batch, points.clone());
        LightPoints { hues, modes: KroneckerPoints::new(seed, MODE_STREAM, batch, points) }
    }
}

impl Iterator for LightPoints {
    type Item = [f64; 2];

    fn next(&mut self) -> Option<[f64; 2]> {
        let ([hue], [mode]) = (self.hues.next()?, self.modes.next()?);
        Some([hue, mode])
    }
}

/// Classes of wavelengths, alike in luminance: a tenth of a nanometre wide in the green.
const CLASSES: usize = 2048;

/// A stone's optics in the light of its scores.
///
/// At the D line a ruby is black and an emerald dark, so stones that absorb are scored by **luminance
/// under D65**: wavelengths are drawn in proportion to ȳ (CIE 1931) × D65, each with its index and its
/// absorption, and power is luminance. Clear stones keep the D line, at which faceters and
/// laboratories quote indices.
#[derive(Debug, Clone)]
pub(super) struct Wavelengths {
    /// One for a clear stone; else one for each class.
    optics: Vec<LineOptics>,
}

impl Wavelengths {
    /// The optics of a stone with a trace unit of `unit`.
    pub(super) fn new(medium: &TraceOptics, unit: f64) -> Result<Self, EstimatorError> {
        Self::weighted(medium, unit, Tristimulus::Y)
    }

    /// The same with wavelengths drawn in proportion to any tristimulus value under D65: power is then
    /// that value as a share of white's, and the three of them are a colour.
    pub(super) fn weighted(
        medium: &TraceOptics,
        unit: f64,
        value: Tristimulus,
    ) -> Result<Self, EstimatorError> {
        let optics = if medium.material.is_clear() {
            vec![medium.optics(unit, lines::D)?]
        } else {
            let middle = |class: usize| (class as f64 + 0.5) / CLASSES as f64;
            let each = |class| medium.optics(unit, luminance::wavelength_by(value, middle(class)));
            (0..CLASSES).map(each).collect::<Result<_, _>>()?
        };
        Ok(Self { optics })
    }

    /// Whether the stone absorbs.
    pub(super) fn absorb(&self) -> bool {
        self.optics.len() > 1
    }

    /// The optic axis of a uniaxial stone.
    pub(super) fn optic_axis(&self) -> Option<DVec3> {
        self.optics.first().and_then(LineOptics::optic_axis)
    }

    /// The optics at one of them.
    ///
    /// - `share`: uniform in 0..1; of luminance at shorter wavelengths
    pub(super) fn line(&self, share: f64) -> LineOptics {
        self.optics[((share * self.optics.len() as f64) as usize).min(self.optics.len() - 1)]
    }

    /// The optics at `K` of them, one in each `K`th of the luminance.
    ///
    /// - `place`: uniform in 0..1; where in its part each lies
    pub(super) fn spread<const K: usize>(&self, place: f64) -> [LineOptics; K] {
        std::array::from_fn(|k| self.line((k as f64 + place) / K as f64))
    }
}
