//! What a picture is made of: three passes of light, each in linear colour.

use glam::Vec3;

/// One class of light in a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pass {
    /// Lights themselves, and surfaces lit straight by them.
    Direct,
    /// Surfaces lit by light that came last from the stone.
    Caustic,
    /// Surfaces lit by light that came last from another surface.
    Indirect,
}

impl Pass {
    /// The passes in order, with their names in file names.
    pub const ALL: [(Pass, &'static str); 3] =
        [(Pass::Direct, "direct"), (Pass::Caustic, "caustic"), (Pass::Indirect, "indirect")];
}

/// Light of one pixel by pass, linear sRGB, unclamped.
pub type Pixel = [Vec3; 3];

/// A finished picture, before the tone curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Row after row from the top.
    pub pixels: Vec<Pixel>,
}

impl Film {
    /// Linear sRGB of every pixel: one pass, or the sum of all.
    pub fn linear(&self, pass: Option<Pass>) -> Vec<Vec3> {
        self.pixels.iter().map(|p| pass.map_or(p[0] + p[1] + p[2], |pass| p[pass as usize])).collect()
    }
}
