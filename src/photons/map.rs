//! Photon maps arranged for look-up, and the radiance estimate.
//!
//! One kd-tree a surface: photons of two walls never mix in a corner.

use super::{Photon, Shot, Spectrum};
use crate::optics::colour::BANDS;
use crate::scene::Scene;
use crate::scene::surface::Shape;
use glam::Vec3;
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use rayon::prelude::*;
use std::f32::consts::PI;
use std::num::NonZero;

/// Light of one class on one surface: places where the irradiance is known.
struct Sheet {
    places: ImmutableKdTree<f32, 3>,
    irradiance: Vec<Spectrum>,
}

/// A photon map: the irradiance at every fourth photon, gathered from its nearest photons.
///
/// Where photons are dense the places are too: within the disc of one estimate lie a fourth as many
/// places as photons, so looking between them costs no detail that the estimate has.
/// Source: P. Christensen, *Faster Photon Map Global Illumination*, J. Graphics Tools 4(3), 1999.
pub struct PhotonMap {
    sheets: Vec<Option<Sheet>>,
}

/// Every how many-th photon has its irradiance computed, Christensen's choice.
const KNOWN_EVERY: usize = 4;

/// Places between which a smooth look-up interpolates: enough to lie around the point.
const AROUND: NonZero<usize> = NonZero::<usize>::MIN.saturating_add(8);

impl PhotonMap {
    /// Arranges photons for look-up.
    ///
    /// - `nearest`: photons that an estimate gathers
    pub fn new(scene: &Scene, shot: &Shot, nearest: usize) -> PhotonMap {
        let sheets = (0..scene.surfaces.len()).map(|s| Sheet::new(scene, s, shot, nearest)).collect();
        PhotonMap { sheets }
    }

    /// Irradiance in each band at a place of a surface, interpolated between the known places
    /// around it; for what the camera sees directly.
    pub fn irradiance(&self, surface: usize, point: Vec3) -> Spectrum {
        self.sheets[surface].as_ref().map_or([0.0; BANDS], |sheet| {
            let found =
                sheet.places.query(&point.to_array()).nearest_n::<SquaredEuclidean<f32>>(AROUND).execute();
            let reach = found.last().map_or(0.0, |f| f.distance.sqrt()).max(f32::MIN_POSITIVE);
            let mut sum = [0.0; BANDS];
            let mut total = 0.0;
            for f in &found {
                // falls to 0 at the farthest place, so that the sum has no steps
                let weight = (1.0 - f.distance.sqrt() / reach).powi(2).max(1e-6);
                total += weight;
                (0..BANDS).for_each(|b| sum[b] += weight * sheet.irradiance[f.item as usize][b]);
            }
            sum.map(|s| s / total)
        })
    }

    /// Irradiance at the nearest known place: for what is seen through the stone.
    pub fn irradiance_nearby(&self, surface: usize, point: Vec3) -> &Spectrum {
        static NONE: Spectrum = [0.0; BANDS];
        self.sheets[surface].as_ref().map_or(&NONE, |sheet| {
            let found =
                sheet.places.query(&point.to_array()).nearest_one::<SquaredEuclidean<f32>>().execute();
            &sheet.irradiance[found.item as usize]
        })
    }
}

impl Sheet {
    fn new(scene: &Scene, surface: usize, shot: &Shot, nearest: usize) -> Option<Sheet> {
        let photons: Vec<Photon> =
            shot.photons.iter().filter(|p| usize::from(p.surface) == surface).copied().collect();
        if photons.is_empty() {
            return None;
        }
        let points: Vec<[f32; 3]> = photons.iter().map(|p| p.point.to_array()).collect();
        let tree = ImmutableKdTree::new_from_slice(&points).ok()?;
        let places: Vec<[f32; 3]> = points.iter().step_by(KNOWN_EVERY).copied().collect();
        let irradiance = places
            .par_iter()
            .map(|p| gather(scene, surface, &tree, &photons, nearest, Vec3::from_array(*p)))
            .collect();
        Some(Sheet { places: ImmutableKdTree::new_from_slice(&places).ok()?, irradiance })
    }
}

/// Jensen's estimate with an Epanechnikov kernel, which integrates to one over its disc; the part
/// of the disc beyond the surface's edge is taken out of the integral.
///
/// E_b = Σ Φ_i K(d_i/r) / (π r² · m), K(x) = 2 (1 − x²), m the kernel's share on the surface.
fn gather(
    scene: &Scene,
    surface: usize,
    tree: &ImmutableKdTree<f32, 3>,
    photons: &[Photon],
    nearest: usize,
    point: Vec3,
) -> Spectrum {
    let mut sum = [0.0; BANDS];
    let Some(k) = NonZero::new(nearest.min(photons.len())) else { return sum };
    let found = tree.query(&point.to_array()).nearest_n::<SquaredEuclidean<f32>>(k).unsorted().execute();
    let radius2 = found.iter().map(|f| f.distance).fold(0.0, f32::max);
    if radius2 <= 0.0 {
        return sum;
    }
    for f in &found {
        let photon = &photons[f.item as usize];
        let weight = photon.power * 2.0 / 255.0 * (1.0 - f.distance / radius2);
        (0..BANDS).for_each(|b| sum[b] += weight * f32::from(photon.tint[b]));
    }
    let share = kernel_share(scene, surface, point, radius2.sqrt());
    sum.map(|s| s / (PI * radius2 * share))
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
