//! Photon maps arranged for look-up, and the radiance estimate.
//!
//! One kd-tree a surface: photons of two walls never mix in a corner.

use super::{Photon, Shot, Spectrum};
use crate::optics::colour::BANDS;
use crate::scene::Scene;
use crate::scene::surface::Shape;
use glam::Vec3;
use kiddo::{Eytzinger, ImmutableKdTree, KdTree, SquaredEuclidean, VecOfArenas};
use rayon::prelude::*;
use std::f32::consts::PI;
use std::num::NonZero;

/// A photon in its tree's leaf: what an estimate needs, beside its place.
#[derive(Debug, Clone, Copy, Default, PartialEq, PartialOrd)]
struct Landed {
    power: f32,
    tint: [u8; BANDS],
}

/// Photons of one surface.
type Photons = KdTree<f32, Landed, Eytzinger, VecOfArenas<f32, Landed, 3, 32>, 3, 32>;

/// Light of one class on one surface: places where the irradiance is known.
struct Sheet {
    places: ImmutableKdTree<f32, 3>,
    known: Vec<Known>,
}

/// What an estimate found at a place.
#[derive(Debug, Clone, Copy)]
struct Known {
    irradiance: Spectrum,
    /// Radius of the disc whose photons it gathered.
    reach: f32,
}

/// A photon map: the irradiance at the places of some photons, gathered from the others around.
///
/// No photon is both a place and gathered: a place in a gap between photons stands for more of the
/// surface than one in a crowd, so that places which see themselves among the counted make the
/// surface too dark (by 12 % with 10 photons an estimate, measured on `tools/peers/table.toml`).
/// Checked in `tests/estimate.rs`.
///
/// Where photons are dense the places are too: within the disc of one estimate lie
/// `PLACES_A_DISC` of them, so looking between them costs no detail that the estimate has.
/// Source: P. Christensen, *Faster Photon Map Global Illumination*, J. Graphics Tools 4(3), 1999.
pub struct PhotonMap {
    sheets: Vec<Option<Sheet>>,
}

/// Places with known irradiance in the disc of one estimate, unless that is of few photons.
const PLACES_A_DISC: usize = 32;
/// At most one photon of this many is a place.
const A_PLACE: usize = 4;

/// A smooth look-up interpolates between the places within this share of an estimate's radius:
/// eight or so.
const AROUND: f32 = 0.5;

impl PhotonMap {
    /// Arranges photons for look-up.
    ///
    /// - `nearest`: photons that an estimate gathers
    pub fn new(scene: &Scene, shot: Shot, nearest: usize) -> PhotonMap {
        let sheet = |s| Sheet::new(scene, s, &shot.photons, nearest);
        PhotonMap { sheets: (0..scene.surfaces.len()).map(sheet).collect() }
    }

    /// Irradiance in each band at a place of a surface, interpolated between the known places
    /// around it; for what the camera sees directly. Also the radius of the estimate: within a small
    /// part of it the irradiance is the same.
    pub fn irradiance(&self, surface: usize, point: Vec3) -> (Spectrum, f32) {
        let Some(sheet) = &self.sheets[surface] else { return ([0.0; BANDS], f32::INFINITY) };
        let nearest = sheet.nearest(point);
        let around = AROUND * nearest.reach;
        let mut sum = nearest.irradiance.map(|e| e * f32::MIN_POSITIVE);
        let mut total = f32::MIN_POSITIVE;
        let at = point.to_array();
        let places = sheet.places.query(&at).within::<SquaredEuclidean<f32>>(around * around);
        places.unsorted().visit(|f| {
            // falls to 0 at the edge, so that the sum has no steps
            let weight = (1.0 - f.distance.sqrt() / around).powi(2);
            total += weight;
            (0..BANDS).for_each(|b| sum[b] += weight * sheet.known[f.item as usize].irradiance[b]);
        });
        (sum.map(|s| s / total), nearest.reach)
    }

    /// Irradiance at the nearest known place: for what is seen through the stone.
    pub fn irradiance_nearby(&self, surface: usize, point: Vec3) -> &Spectrum {
        static NONE: Spectrum = [0.0; BANDS];
        self.sheets[surface].as_ref().map_or(&NONE, |sheet| &sheet.nearest(point).irradiance)
    }
}

impl Sheet {
    fn nearest(&self, point: Vec3) -> &Known {
        let found = self.places.query(&point.to_array()).nearest_one::<SquaredEuclidean<f32>>().execute();
        &self.known[found.item as usize]
    }

    /// - `all`: photons of all surfaces
    fn new(scene: &Scene, surface: usize, all: &[Photon], nearest: usize) -> Option<Sheet> {
        let here = |n: &u32| usize::from(all[*n as usize].surface) == surface;
        let mut numbers: Vec<u32> = (0..all.len() as u32).filter(here).collect();
        if numbers.len() < 3 {
            return None; // two places and one photon between them is the least
        }
        // the order of a shot is that of emission, so every n-th photon is as good as another
        let every = (nearest.min(numbers.len()) / PLACES_A_DISC).max(A_PLACE).min(numbers.len() - 1);
        let of_all = numbers.len() as f32;
        let points: Vec<[f32; 3]> =
            numbers.iter().step_by(every).map(|n| all[*n as usize].point.to_array()).collect();
        let mut position = 0..;
        numbers.retain(|_| position.next().is_some_and(|i: usize| !i.is_multiple_of(every)));
        let for_each = of_all / numbers.len() as f32;
        let photons = Photons::new_from_source(
            &numbers,
            |n, axis| all[*n as usize].point[axis],
            |_, n| Landed { power: all[*n as usize].power * for_each, tint: all[*n as usize].tint },
        )
        .ok()?;
        let places = ImmutableKdTree::new_from_slice(&points).ok()?;
        let disc =
            Disc { scene, surface, photons: &photons, places: &places, across: nearest.div_ceil(every) };
        let known = points.par_iter().map(|p| disc.gather(Vec3::from_array(*p))).collect();
        Some(Sheet { places, known })
    }
}

/// What an estimate looks into.
struct Disc<'a> {
    scene: &'a Scene,
    surface: usize,
    photons: &'a Photons,
    places: &'a ImmutableKdTree<f32, 3>,
    /// Places that the disc of an estimate reaches across.
    across: usize,
}

impl Disc<'_> {
    /// Jensen's estimate with an Epanechnikov kernel, which integrates to one over its disc; the
    /// part of the disc beyond the surface's edge is taken out of the integral.
    ///
    /// E_b = Σ Φ_i K(d_i/r) / (π r² · m), K(x) = 2 (1 − x²), m the kernel's share on the surface.
    ///
    /// The radius is that of the `across`-th nearest place: each place stands for some of the photons,
    /// so the disc holds about as many as are asked for, and they need not be sorted by distance. It
    /// depends on no photon that is gathered, so the estimate has no bias where the light is even.
    fn gather(&self, point: Vec3) -> Known {
        let mut sum = [0.0; BANDS];
        let own_and_others = NonZero::<usize>::MIN.saturating_add(self.across);
        let at = point.to_array();
        let found =
            self.places.query(&at).nearest_n::<SquaredEuclidean<f32>>(own_and_others).unsorted().execute();
        let radius2 = found.iter().map(|f| f.distance).fold(0.0, f32::max);
        if radius2 <= 0.0 {
            return Known { irradiance: sum, reach: 0.0 };
        }
        self.photons.query(&at).within::<SquaredEuclidean<f32>>(radius2).unsorted().visit(|f| {
            let weight = f.item.power * 2.0 / 255.0 * (1.0 - f.distance / radius2);
            (0..BANDS).for_each(|b| sum[b] += weight * f32::from(f.item.tint[b]));
        });
        let reach = radius2.sqrt();
        let share = kernel_share(self.scene, self.surface, point, reach);
        Known { irradiance: sum.map(|s| s / (PI * radius2 * share)), reach }
    }
}

/// Share of the kernel's integral that lies on the surface, by a fixed spiral of points of equal
/// kernel weight.
fn kernel_share(scene: &Scene, surface: usize, point: Vec3, radius: f32) -> f32 {
    const POINTS: usize = 48;
    // a mesh has no edge worth the search: its photons lie all round
    let Shape::Plate(plate) = &scene.surfaces[surface].shape else { return 1.0 };
    let (u, v) = (plate.u.normalize(), plate.normal().cross(plate.u.normalize()));
    let far = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)];
    if far.iter().all(|(a, b)| plate.holds(point + (u * *a + v * *b) * radius)) {
        return 1.0; // a disc whose four tips lie on a rectangle lies on it whole
    }
    let inside = (0..POINTS)
        .filter(|i| {
            // the kernel's cumulative weight 2x² − x⁴ at radius x is uniform
            let w = (*i as f32 + 0.5) / POINTS as f32;
            let x = (1.0 - (1.0 - w).sqrt()).sqrt() * radius;
            let phi = *i as f32 * 2.399_963; // golden angle
            plate.holds(point + u * (x * phi.cos()) + v * (x * phi.sin()))
        })
        .count();
    inside.max(1) as f32 / POINTS as f32
}
