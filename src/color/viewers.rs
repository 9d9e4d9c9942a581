//! Gem viewers: the light that a stone is put into to see where its light comes from.
//!
//! The light belongs to the viewer, so the picture of a viewer and the score of that name mean the
//! same bands. Elevations are above the girdle plane of a stone seen face-up, in degrees.

use crate::parse;
use glam::Vec3;

/// A band of elevation of one colour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViewerBand {
    /// Elevation where it begins, degrees; it ends where the next begins, the last at the zenith.
    pub from_deg: f32,
    /// Its colour as parts of [`super::rgb_upsampling::basis`].
    pub colour: Vec3,
}

/// A viewer's light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viewer {
    /// Its name in scene files.
    pub name: &'static str,
    /// What it shows.
    pub about: &'static str,
    /// Bands from below upward; the first begins at −90°.
    pub bands: &'static [ViewerBand],
}

const RED: Vec3 = Vec3::X;
const GREEN: Vec3 = Vec3::Y;
const BLUE: Vec3 = Vec3::Z;
const DARK: Vec3 = Vec3::ZERO;
const WHITE: Vec3 = Vec3::ONE;
// a lit sheet of white paper below the stone
const PAPER: Vec3 = WHITE;

const fn band(from_deg: f32, colour: Vec3) -> ViewerBand {
    ViewerBand { from_deg, colour }
}

/// Elevations at which the ASET's green, red and blue begin, degrees.
pub const ASET_DEG: [f32; 3] = [0.0, 45.0, 75.0];

/// Half-angle of the dark cone of the Ideal-Scope, degrees: it blocks about 24° in all.
pub const SCOPE_DEG: f64 = 12.0;

/// Half-angle of the observer under the dome, degrees (GIA's brightness metric).
pub const GIA_OBSERVER_DEG: f64 = 23.0;

/// Every viewer.
pub static VIEWERS: &[Viewer] = &[
    Viewer {
        name: "aset",
        about: "green from the horizon to 45°, red to 75°, blue above, dark below",
        bands: &[
            band(-90.0, DARK),
            band(ASET_DEG[0], GREEN),
            band(ASET_DEG[1], RED),
            band(ASET_DEG[2], BLUE),
        ],
    },
    Viewer {
        name: "ideal-scope",
        about: "red light with a dark eye of 24°, white paper below",
        bands: &[band(-90.0, PAPER), band(0.0, RED), band(90.0 - SCOPE_DEG as f32, DARK)],
    },
    Viewer {
        name: "hearts-and-arrows",
        about: "red light from 45° up to a dark eye of 20°, white paper below: lower light shows as white",
        bands: &[band(-90.0, PAPER), band(45.0, RED), band(80.0, DARK)],
    },
    Viewer {
        name: "face-up",
        about: "a white sky with a dark observer of 46°, that of the score brightness",
        bands: &[band(-90.0, DARK), band(0.0, WHITE), band(90.0 - GIA_OBSERVER_DEG as f32, DARK)],
    },
    Viewer {
        name: "dark-field",
        about: "a white ring from 0 to 30° around a dark field",
        bands: &[band(-90.0, DARK), band(0.0, WHITE), band(30.0, DARK)],
    },
];

impl Viewer {
    /// The viewer called `name`.
    pub fn by_name(name: &str) -> Option<&'static Viewer> {
        VIEWERS.iter().find(|v| parse::is_name(v.name, name))
    }

    /// The band (its number) of a unit direction whose z is `z`.
    pub fn band(&self, z: f32) -> usize {
        self.bands.iter().rposition(|band| z >= band.from_deg.to_radians().sin()).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_rise_from_the_nadir() {
        for viewer in VIEWERS {
            assert_eq!(viewer.bands[0].from_deg, -90.0, "{}", viewer.name);
            assert!(viewer.bands.windows(2).all(|w| w[0].from_deg < w[1].from_deg), "{}", viewer.name);
        }
        let aset = Viewer::by_name("aset").expect("in the catalogue");
        let bands: Vec<usize> =
            [-30f32, 10.0, 50.0, 80.0].iter().map(|deg| aset.band(deg.to_radians().sin())).collect();
        assert_eq!(bands, [0, 1, 2, 3]);
    }
}
