//! Film: passes of light in linear colour, display colours, and the first thing in each pixel.

use glam::Vec3;

/// One class of light in a picture.
///
/// ```
/// use cutlab::{Pass, RenderRequest};
///
/// let film = RenderRequest::scene("face-up")?.size(16, 16).samples_per_pixel(1).photons(100).run()?.film;
/// let brightest = |pass| film.linear(Some(pass)).iter().map(|c| c.max_element()).fold(0.0, f32::max);
/// assert!(brightest(Pass::Stone) > 0.0); // the stone in the middle
/// assert_eq!(brightest(Pass::Caustic), 0.0); // and nothing that its light falls on
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Pass {
    /// Lights themselves, and surfaces lit straight by them.
    Direct,
    /// Surfaces lit by light that came last from a stone or a mirror.
    Caustic,
    /// Surfaces lit by light that came last from another surface.
    Indirect,
    /// All that is seen in a stone.
    Stone,
}

/// How many passes there are.
pub const PASSES: usize = 4;

impl Pass {
    /// The passes in order, with their names in files.
    pub const ALL: [(Pass, &'static str); PASSES] = [
        (Pass::Direct, "direct"),
        (Pass::Caustic, "caustic"),
        (Pass::Indirect, "indirect"),
        (Pass::Stone, "stone"),
    ];
}

/// One pixel.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Pixel {
    /// Light by pass: mean over the camera rays, linear sRGB, unclamped.
    pub light: [Vec3; PASSES],
    /// Display colour of all passes: each camera ray goes through the tone curve before the mean, so that
    /// the edge of a facet that mirrors a lamp is as smooth as any other. By how much the curve darkens a
    /// ray depends on its colour without the noise of its few wavelengths. Linear sRGB; that noise may
    /// reach beyond 0..=1.
    pub display: Vec3,
    /// Coverage: the share of the camera rays that met something other than the background. 1 unless the
    /// scene leaves its background out ([`crate::scene::Scene::cut_out`]); `light` and `shown` are
    /// premultiplied by it.
    pub alpha: f32,
}

/// What lies in the middle of a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FirstHit {
    /// Distance from the camera; infinite where there is nothing.
    pub depth: f32,
    /// Facets count from 1 through all stones; 0 is no facet.
    pub facet: u32,
    /// Unit normal, world frame; 0 where there is nothing.
    pub normal: Vec3,
}

/// A finished picture, before it is encoded.
///
/// ```
/// use cutlab::{Film, RenderRequest};
///
/// let film: Film = RenderRequest::scene("face-up")?.size(16, 12).samples_per_pixel(1).photons(100).run()?.film;
/// let light = film.linear(None); // linear sRGB, row after row from the top
/// assert_eq!(light.len(), 16 * 12);
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
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
        self.pixels
            .iter()
            .map(|p| pass.map_or_else(|| p.light.iter().sum(), |pass| p.light[pass as usize]))
            .collect()
    }
}
