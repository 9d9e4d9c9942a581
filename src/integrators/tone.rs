//! Tone mapping, from linear light to display values.
//!
//! The curve acts on luminance, and the colour follows in proportion: hue and saturation stay, and white
//! is white. Filmic is straight up to .6, then .6 + .4 (1 − e^(−(x − .6)/.4)). A colour of which a display
//! cannot show so much is darkened until it can.

use super::film::Film;
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// A tone curve.
///
/// ```
/// use cutlab::ToneCurve;
/// use cutlab::advanced::integrators::Tone;
/// use cutlab::glam::Vec3;
///
/// let shown = |curve, light| Tone { curve, stops: 0.0 }.display_rgb(Vec3::splat(light)).x;
/// assert_eq!(shown(ToneCurve::Linear, 0.5), shown(ToneCurve::Filmic, 0.5));
/// assert_eq!(shown(ToneCurve::Linear, 1.5), 1.0); // white: twice as much looks the same
/// assert!(shown(ToneCurve::Filmic, 1.5) < 1.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum ToneCurve {
    /// Straight in the dark, bending toward white as film does: highlights keep their detail.
    #[default]
    Filmic,
    /// A straight line that ends at white.
    Linear,
}

/// Exposure and tone curve.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tone {
    /// Exposure in stops.
    pub stops: f32,
    /// The curve.
    pub curve: ToneCurve,
}

/// Where the filmic curve leaves the straight line.
const SHOULDER: f32 = 0.6;
/// Luminance of linear sRGB.
pub(super) const LUMINANCE: Vec3 = Vec3::new(0.2126, 0.7152, 0.0722);

impl ToneCurve {
    /// Every curve with its name.
    pub const ALL: [(&'static str, ToneCurve); 2] =
        [("filmic", ToneCurve::Filmic), ("linear", ToneCurve::Linear)];

    fn value(self, x: f32) -> f32 {
        let x = x.max(0.0);
        match self {
            ToneCurve::Linear => x.min(1.0),
            ToneCurve::Filmic if x <= SHOULDER => x,
            ToneCurve::Filmic => {
                let rest = 1.0 - SHOULDER;
                SHOULDER + rest * (1.0 - (-(x - SHOULDER) / rest).exp())
            }
        }
    }
}

impl Tone {
    /// Linear light as a display shows it, in 0..=1, before the transfer curve.
    pub fn display_rgb(&self, linear: Vec3) -> Vec3 {
        (linear * self.gain(linear)).clamp(Vec3::ZERO, Vec3::ONE)
    }

    /// Factor by which linear light of a colour is multiplied to be shown.
    pub fn gain(&self, colour: Vec3) -> f32 {
        let exposure = self.stops.exp2();
        let exposed = colour * exposure;
        let (luminance, strongest) = (exposed.dot(LUMINANCE), exposed.max_element());
        if luminance <= 0.0 || strongest <= 0.0 {
            return exposure;
        }
        exposure * (self.curve.value(luminance) / luminance).min(1.0 / strongest)
    }
}

/// Stops that bring a picture to a middle exposure: the brightness that one pixel in twenty exceeds goes to
/// the shoulder's end. Measured on a small picture that is not kept.
pub fn auto_stops(film: &Film) -> f32 {
    let mut brightness: Vec<f32> = film.linear(None).iter().map(|p| p.dot(LUMINANCE)).collect();
    brightness.sort_by(f32::total_cmp);
    let bright = brightness.get(brightness.len() * 19 / 20).copied().unwrap_or(0.0);
    if bright > 0.0 { (0.8 / bright).log2().clamp(-20.0, 20.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curves_rise_to_one_the_filmic_one_smoothly() {
        for (_, curve) in ToneCurve::ALL {
            assert_eq!(curve.value(-0.1), 0.0);
            assert_eq!(curve.value(0.5), 0.5);
            assert!(curve.value(4.0) > 0.99 && curve.value(1e6) <= 1.0);
        }
        let slope = (ToneCurve::Filmic.value(SHOULDER + 1e-3) - SHOULDER) / 1e-3;
        assert!((slope - 1.0).abs() < 0.01);
        let tone = Tone { stops: 1.0, curve: ToneCurve::Linear };
        assert!((tone.display_rgb(Vec3::splat(0.25)) - 0.5).abs().max_element() < 1e-6);
    }

    /// Colours keep the proportion of their channels, also where their strongest is beyond white.
    #[test]
    fn hue_is_kept() {
        let tone = Tone::default();
        for colour in [Vec3::new(0.9, 0.5, 0.2), Vec3::new(3.0, 0.2, 0.1), Vec3::new(0.0, 0.1, 9.0)] {
            let shown = tone.display_rgb(colour);
            assert!((shown / shown.max_element() - colour / colour.max_element()).abs().max_element() < 1e-6);
            assert!(shown.max_element() <= 1.0);
        }
        let orange = tone.display_rgb(Vec3::new(0.9, 0.8, 0.3));
        assert!((orange.dot(LUMINANCE) - ToneCurve::Filmic.value(0.78516)).abs() < 1e-4, "{orange}");
    }
}
