//! Photon maps arranged for look-up, and the radiance estimate.
//!
//! One kd-tree a surface: photons of two walls never mix in a corner.

use super::{Photon, Shot, Spectrum};
use crate::optics::colour::BANDS;
use crate::scene::Scene;
use glam::Vec3;
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use rayon::prelude::*;
use std::f32::consts::PI;
use std::num::NonZero;

/// Photons of one class on one surface.
struct Sheet {
    tree: ImmutableKdTree<f32, 3>,
    photons: Vec<Photon>,
    /// Places where the irradiance is known beforehand, and the irradiance there.
    known_at: ImmutableKdTree<f32, 3>,
    known: Vec<Spectrum>,
}

/// A photon map.
pub struct PhotonMap {
    sheets: Vec<Option<Sheet>>,
    nearest: usize,
}

/// Every how many-th photon has its irradiance computed beforehand (Christensen 1999 takes 4).
const KNOWN_EVERY: usize = 4;

impl PhotonMap {
    /// Arranges photons for look-up and computes the irradiance at every fourth of them.
    ///
    /// - `nearest`: photons an estimate gathers
    pub fn new(scene: &Scene, shot: &Shot, nearest: usize) -> PhotonMap {
        let sheets = (0..scene.surfaces.len())
            .map(|s| {
                let photons: Vec<Photon> = shot.photons.iter().filter(|p| usize::from(p.surface) == s).copied().collect();
                let points: Vec<[f32; 3]> = photons.iter().map(|p| p.point.to_array()).collect();
                let tree = ImmutableKdTree::new_from_slice(&points).ok()?;
                let places: Vec<[f32; 3]> = points.iter().step_by(KNOWN_EVERY).copied().collect();
                let known = places
                    .par_iter()
                    .map(|p| gather(scene, s, &tree, &photons, nearest, Vec3::from_array(*p)))
                    .collect();
                let known_at = ImmutableKdTree::new_from_slice(&places).ok()?;
                (!photons.is_empty()).then_some(Sheet { tree, photons, known_at, known })
            })
            .collect();
        PhotonMap { sheets, nearest }
    }

    /// Irradiance in each band at a place of a surface, gathered from the nearest photons.
    pub fn irradiance(&self, scene: &Scene, surface: usize, point: Vec3) -> Spectrum {
        self.sheets[surface].as_ref().map_or([0.0; BANDS], |sheet| {
            gather(scene, surface, &sheet.tree, &sheet.photons, self.nearest, point)
        })
    }

    /// Irradiance known beforehand at the nearest such place: coarser and some fifty times faster,
    /// for what is seen through the stone.
    pub fn known_irradiance(&self, surface: usize, point: Vec3) -> Spectrum {
        self.sheets[surface].as_ref().map_or([0.0; BANDS], |sheet| {
            let nearest = sheet.known_at.query(&point.to_array()).nearest_one::<SquaredEuclidean<f32>>().execute();
            sheet.known[nearest.item as usize]
        })
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
        sum[usize::from(photon.band)] += photon.power * 2.0 * (1.0 - f.distance / radius2);
    }
    let share = kernel_share(scene, surface, point, radius2.sqrt());
    sum.map(|s| s / (PI * radius2 * share))
}

/// Share of the kernel's integral that lies on the surface, by a fixed spiral of points of equal
/// kernel weight.
fn kernel_share(scene: &Scene, surface: usize, point: Vec3, radius: f32) -> f32 {
    const POINTS: usize = 48;
    let plate = &scene.surfaces[surface];
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
