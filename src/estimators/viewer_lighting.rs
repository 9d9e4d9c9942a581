//! Viewer lighting: the bands of the sky that a viewer tells apart, and a dome that is dark where he is.

use super::horizon::{self, MAX_LEVEL_SINE, is_above, is_up};
pub use crate::color::viewers::{GIA_OBSERVER_DEG, SCOPE_DEG};
use crate::trace::Refraction;

/// sin 45° and sin 75°: where the bands of the ASET end.
pub(super) const BAND_LIMITS: [f32; 2] = [std::f32::consts::FRAC_1_SQRT_2, 0.965_925_8];

/// Where light comes from, by elevation above the girdle plane. Numbers index arrays by band.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(usize)]
pub enum AsetBand {
    /// 0–45°.
    Green = 0,
    /// 45–75°.
    Red = 1,
    /// 75–90°.
    Blue = 2,
    /// Below the horizon.
    Below = 3,
}

/// A white dome above the viewer's horizon, dark where his head is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ObserverDome {
    /// Cosine of the dark cone's half-angle.
    dark_from: f32,
}

impl ObserverDome {
    /// A dome with a dark cone about the viewer.
    ///
    /// - `half_angle`: of the cone, degrees; 0 for no cone at all
    pub fn with_observer(half_angle: f64) -> ObserverDome {
        let cos = half_angle.to_radians().cos() as f32;
        // light along the edge of the cone is bright; but no cone is too small to hold the zenith
        let edge = cos + MAX_LEVEL_SINE.min(0.5 * (1.0 - cos));
        ObserverDome { dark_from: if half_angle > 0.0 { edge } else { f32::INFINITY } }
    }

    /// Whether light comes from the height (sine of the elevation).
    #[inline(always)]
    pub fn is_bright(&self, height: f32) -> bool {
        horizon::is_up(height) && height < self.dark_from
    }

    /// Whether light comes from the dark cone about the viewer.
    #[inline(always)]
    pub fn is_hidden(&self, height: f32) -> bool {
        height >= self.dark_from.max(f32::MIN_POSITIVE)
    }

    /// The height at which the outer side of a facet mirrors the viewer's line of sight.
    pub fn mirror_height(entry: &Refraction) -> f32 {
        2.0 * entry.cos_outside * entry.cos_outside - 1.0
    }

    /// What the outer side of a facet mirrors of the dome towards the viewer.
    pub fn mirrored(&self, entry: &Refraction) -> f32 {
        if self.is_bright(ObserverDome::mirror_height(entry)) { entry.reflectance } else { 0.0 }
    }
}

/// Lighting of a view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViewerLighting {
    /// The dome whose dark cone is the black of the Ideal-Scope.
    pub scope: ObserverDome,
    /// The dome that luminance is seen under.
    pub dome: ObserverDome,
}

impl Default for ViewerLighting {
    fn default() -> Self {
        ViewerLighting {
            scope: ObserverDome::with_observer(SCOPE_DEG),
            dome: ObserverDome::with_observer(GIA_OBSERVER_DEG),
        }
    }
}

/// The band of a direction whose z is `z`.
pub fn band(z: f32) -> AsetBand {
    if is_above(z, BAND_LIMITS[1]) {
        AsetBand::Blue
    } else if is_above(z, BAND_LIMITS[0]) {
        AsetBand::Red
    } else if is_up(z) {
        AsetBand::Green
    } else {
        AsetBand::Below
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::viewers::ASET_DEG;

    #[test]
    fn the_bands_are_those_of_the_viewer() {
        for (end, deg) in BAND_LIMITS.iter().zip(&ASET_DEG[1..]) {
            assert!((end - deg.to_radians().sin()).abs() < 1e-6);
        }
    }
}
