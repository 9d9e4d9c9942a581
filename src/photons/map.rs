//! Photon maps arranged for look-up, and the irradiance that their photons make.
//!
//! A map for each side of each surface: photons of two walls, or of the two sides of one, never mix.

use super::mirror_images::QuadEdges;
use super::surface_cells::{self, SurfaceCell};
use super::{BandSpectrum, PhotonSet, StoredPhoton};
use crate::color::cie::BANDS;
use crate::parallel;
use crate::scene::intersection::SurfacePoint;
use crate::scene::surface::Quad;
use crate::scene::{Scene, Surface};
use glam::Vec3;
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use std::num::NonZero;
use std::sync::atomic::{AtomicU64, Ordering};

/// A photon map: the irradiance of every part of every surface.
///
/// Each photon spreads its own power over the surface around it, the wider the fewer photons there are;
/// the share beyond an edge is folded back. So the light on a surface is the power of its photons,
/// however they lie, and what none reaches is dark. (Estimates that gather the nearest photons around
/// places give light to the dark, and more of it the fewer photons they find.) The surface is divided
/// into cells that are small beside that spread; a photon's power is shared out among their middles, so
/// that the sum needs no integral over edges or curved meshes.
///
/// E_c = Σ_i Φ_i K(d_ic/r_i) / Σ_c' A_c' K(d_ic'/r_i), K(x) = max(0, 1 − x²), r_i the distance within
/// which about 4/3 `nearest` photons lie: under K these are as noisy as `nearest` photons that count alike, for
/// π r² ∫K² = 4/3 (∫K)². Source: sample-point density estimation, B. Silverman, *Density Estimation*, 1986,
/// §5.3. Checked in `tests/library/estimate.rs`.
pub struct PhotonMap {
    /// Front and back of each surface.
    surface_maps: Vec<[Option<SurfaceMap>; 2]>,
}

/// Light of one class on one side of a surface.
struct SurfaceMap {
    places: Tree,
    cells: Vec<SurfaceCell>,
    irradiance: Vec<BandSpectrum>,
    /// Longest edge of a cell as a share of its radius.
    edge: f32,
}

type Tree = ImmutableKdTree<f32, 3>;

/// Longest edge of a cell as a share of the radius over which its photons are spread: 20 to 80 cells are
/// in that disc.
const EDGE: f32 = 0.4;
/// Fewer photons in a disc than this make more noise than larger cells make blur.
const ENOUGH_FOR_EDGE: f32 = 100.0;
/// Longest edge for the fewest photons.
const LONGEST: f32 = 1.2;
/// Photons by the distance of the last of which a radius is found, out of a part of all. With fewer, cells
/// would be small where photons lie close by chance, and look-ups would find bright ones too often.
const PILOTS: usize = 32;
/// With fewer photons on it, each spreads over a whole side.
const FEW: usize = 4;
/// A radius that a sample of the photons gave is corrected by up to this factor.
const MOST_CORRECTION: f32 = 1.3;
/// A smooth look-up interpolates between the cells within so many of the longest edges.
const AROUND: f32 = 1.0;
/// Places among which one of the right normal is looked for, if the nearest has another.
const FOLDS: NonZero<usize> = NonZero::<usize>::MIN.saturating_add(15);

impl PhotonMap {
    /// Arranges photons for look-up.
    ///
    /// - `nearest`: photons over which each is spread
    pub fn new(scene: &Scene, shot: PhotonSet, nearest: usize) -> PhotonMap {
        let mut sides: Vec<[Vec<&StoredPhoton>; 2]> =
            scene.surfaces.iter().map(|_| Default::default()).collect();
        for photon in &shot.photons {
            if let Some(side) = sides.get_mut(usize::from(photon.surface)) {
                side[usize::from(!photon.front)].push(photon);
            }
        }
        let both = |(surface, [front, back]): (&Surface, &[Vec<&StoredPhoton>; 2])| {
            [SurfaceMap::new(surface, true, front, nearest), SurfaceMap::new(surface, false, back, nearest)]
        };
        PhotonMap { surface_maps: scene.surfaces.iter().zip(&sides).map(both).collect() }
    }

    fn surface_map(&self, at: &SurfacePoint) -> Option<&SurfaceMap> {
        self.surface_maps[at.surface][usize::from(!at.front)].as_ref()
    }

    /// Irradiance in each band at a place, interpolated between the cells around it; for what the camera
    /// sees directly. Also the radius of the estimate: within a small part of it the irradiance is the
    /// same.
    pub fn irradiance(&self, at: &SurfacePoint) -> (BandSpectrum, f32) {
        let Some(sheet) = self.surface_map(at) else { return ([0.0; BANDS], f32::INFINITY) };
        let nearest = sheet.nearest(at.point, at.normal);
        let radius = sheet.cells[nearest].radius;
        let share = AROUND * sheet.edge;
        // of cells whose radius grows no faster than they are away, none farther has a weight
        let reach = share * radius / (1.0 - 0.5 * share);
        let mut sum = sheet.irradiance[nearest].map(|e| e * f32::MIN_POSITIVE);
        let mut total = f32::MIN_POSITIVE;
        let place = at.point.to_array();
        sheet.places.query(&place).within::<SquaredEuclidean<f32>>(reach * reach).unsorted().visit(|f| {
            let i = f.item as usize;
            let cell = &sheet.cells[i];
            // by the radii of both: by that of the place alone, small bright cells would count too often
            let around = 0.5 * share * (radius + cell.radius);
            // falls to 0 at the edge, so that the sum has no steps
            let near = (1.0 - f.distance.sqrt() / around).max(0.0) / around;
            let weight = near * near * cell.area * cell.normal.dot(at.normal).max(0.0);
            total += weight;
            (0..BANDS).for_each(|b| sum[b] += weight * sheet.irradiance[i][b]);
        });
        (sum.map(|s| s / total), radius)
    }

    /// Irradiance of the nearest cell: for what is seen through the stone.
    pub fn irradiance_nearby(&self, at: &SurfacePoint) -> &BandSpectrum {
        static NONE: BandSpectrum = [0.0; BANDS];
        self.surface_map(at).map_or(&NONE, |sheet| &sheet.irradiance[sheet.nearest(at.point, at.normal)])
    }
}

impl SurfaceMap {
    /// None where no photon is.
    fn new(surface: &Surface, front: bool, photons: &[&StoredPhoton], nearest: usize) -> Option<SurfaceMap> {
        let nearest = nearest.max(FEW);
        let nearest = nearest.saturating_add(nearest / 3); // as noisy under K as `nearest` counted alike
        let radii = GatherRadii::new(surface, photons, nearest)?;
        let edge = (EDGE * (ENOUGH_FOR_EDGE / nearest as f32).sqrt().max(1.0)).min(LONGEST);
        let mut cells = surface_cells::divide(surface, edge, &|place| radii.radius(place));
        if !front {
            cells.iter_mut().for_each(|cell| cell.normal = -cell.normal);
        }
        let points: Vec<[f32; 3]> = cells.iter().map(|cell| cell.point.to_array()).collect();
        let places = Tree::new_from_slice(&points).ok()?;
        let mut sheet = SurfaceMap { places, cells, irradiance: Vec::new(), edge };
        let mut homes: Vec<(u32, &StoredPhoton)> = parallel::map(photons.len(), |i| {
            let p = photons[i];
            (sheet.nearest(p.point, p.normal()) as u32, p)
        });
        parallel::sort_by_key(&mut homes, |(home, _)| *home);
        let shares = CellPowers::new(photons, sheet.cells.len());
        let edges = surface.shape.as_quad().and_then(QuadEdges::new);
        let mut counts = vec![0.0; sheet.cells.len()];
        homes.iter().for_each(|(home, _)| counts[*home as usize] += 1.0);
        let spread = Spread { edges, counts, nearest: nearest as f32, shares: &shares };
        let by_cell: Vec<&[(u32, &StoredPhoton)]> = homes.chunk_by(|a, b| a.0 == b.0).collect();
        parallel::for_each(by_cell.len(), |i| sheet.share_out(by_cell[i], &spread));
        sheet.irradiance = shares.over_areas(&sheet.cells);
        Some(sheet)
    }

    /// The cell in which a place lies.
    fn nearest(&self, point: Vec3, normal: Vec3) -> usize {
        let fits = |i: usize| self.cells[i].normal.dot(normal) > 0.0;
        let at = point.to_array();
        let found = self.places.query(&at).nearest_one::<SquaredEuclidean<f32>>().execute();
        let first = found.item as usize;
        if fits(first) {
            return first;
        }
        let more = self.places.query(&at).nearest_n::<SquaredEuclidean<f32>>(FOLDS).unsorted().execute();
        let fitting = more.iter().filter(|f| fits(f.item as usize));
        let closest = fitting.min_by(|a, b| a.distance.total_cmp(&b.distance).then(a.item.cmp(&b.item)));
        closest.map_or(first, |f| f.item as usize)
    }

    /// Shares out the power of photons that lie in the same cell among the cells around.
    fn share_out(&self, photons: &[(u32, &StoredPhoton)], spread: &Spread) {
        let Some((home, _)) = photons.first() else { return };
        let home = *home as usize;
        let SurfaceCell { point, radius, .. } = self.cells[home];
        let apart = photons.iter().map(|(_, p)| p.point.distance(point)).fold(0.0, f32::max);
        let mut around = vec![home];
        let reach2 = (MOST_CORRECTION * radius + apart).powi(2);
        let middle = point.to_array();
        self.places.query(&middle).within::<SquaredEuclidean<f32>>(reach2).unsorted().visit(|f| {
            if f.item as usize != home {
                around.push(f.item as usize);
            }
        });
        let radius = self.corrected_radius(home, &around, spread);
        around.retain(|i| self.cells[*i].point.distance(point) <= radius + apart);
        let edges = spread.edges.as_ref();
        let mut weights = vec![0.0; around.len()];
        let mut sums = vec![[0.0; BANDS]; around.len()];
        for (_, photon) in photons {
            let normal = photon.normal();
            let (images, count) =
                edges.map_or(([photon.point; 9], 1), |edges| edges.images(photon.point, radius));
            for (weight, i) in weights.iter_mut().zip(&around) {
                let cell = &self.cells[*i];
                let kernel: f32 = images[..count].iter().map(|at| kernel(*at, cell.point, radius)).sum();
                *weight = cell.area * kernel * cell.normal.dot(normal).max(0.0);
            }
            let mut total: f32 = weights.iter().sum();
            if total <= 0.0 {
                // no middle within reach: all stays at home, which comes first
                (weights[0], total) = (1.0, 1.0);
            }
            let power: BandSpectrum = std::array::from_fn(|b| photon.in_band(b) / total);
            for (sum, weight) in sums.iter_mut().zip(&weights) {
                (0..BANDS).for_each(|b| sum[b] += power[b] * weight);
            }
        }
        around.iter().zip(&sums).for_each(|(cell, power)| spread.shares.add(*cell, power));
    }

    /// The radius over which the photons of a cell are spread: by all photons around it, of which the radius
    /// of the cell counts a sample. Where a sample errs the spread would err with it, and as the errors of
    /// neighbours differ, light would move from one to the other.
    ///
    /// - `around`: the cells within a little more than its radius, itself among them
    fn corrected_radius(&self, home: usize, around: &[usize], spread: &Spread) -> f32 {
        let SurfaceCell { point, radius, normal, .. } = self.cells[home];
        let (images, count) =
            spread.edges.as_ref().map_or(([point; 9], 1), |edges| edges.images(point, radius));
        let found: f32 = around
            .iter()
            .map(|i| {
                let cell = &self.cells[*i];
                let kernel: f32 = images[..count].iter().map(|at| kernel(*at, cell.point, radius)).sum();
                spread.counts[*i] * kernel * cell.normal.dot(normal).max(0.0)
            })
            .sum();
        // the kernel counts half of the photons of a disc
        let wanted = 0.5 * spread.nearest / found.max(f32::MIN_POSITIVE);
        radius * wanted.sqrt().clamp(1.0 / MOST_CORRECTION, MOST_CORRECTION)
    }
}

/// K of the distance of two places over the radius.
fn kernel(a: Vec3, b: Vec3, radius: f32) -> f32 {
    (1.0 - a.distance_squared(b) / (radius * radius)).max(0.0)
}

/// How the photons of a side are spread.
struct Spread<'a> {
    /// Of the surface, if it is a quad.
    edges: Option<QuadEdges>,
    /// Photons in each cell.
    counts: Vec<f32>,
    /// Photons within the radius over which one is spread.
    nearest: f32,
    shares: &'a CellPowers,
}

/// Over how wide a disc the photons of a side are spread.
struct GatherRadii<'a> {
    /// The surface, if it is a quad.
    quad: Option<&'a Quad>,
    /// Every n-th photon in the order of emission, n the same for the whole side.
    pilots: Tree,
    /// How many of them are counted; none if each photon is spread over the whole side.
    counted: Option<NonZero<usize>>,
    /// The radius over the distance of the last one counted.
    factor: f32,
    /// Diagonal of the surface's box.
    diagonal: f32,
}

impl<'a> GatherRadii<'a> {
    /// None where no photon is.
    fn new(surface: &'a Surface, photons: &[&StoredPhoton], nearest: usize) -> Option<GatherRadii<'a>> {
        let (low, high) = surface.bounds();
        let every = (nearest / PILOTS).min(photons.len() / (2 * PILOTS)).max(1);
        let points: Vec<[f32; 3]> = photons.iter().step_by(every).map(|p| p.point.to_array()).collect();
        let count = PILOTS.min(points.len() / 2);
        Some(GatherRadii {
            quad: surface.shape.as_quad(),
            pilots: Tree::new_from_slice(&points).ok().filter(|_| !points.is_empty())?,
            counted: NonZero::new(count).filter(|_| photons.len() >= FEW),
            factor: (nearest as f32 / (count * every) as f32).sqrt(),
            diagonal: low.distance(high),
        })
    }

    fn radius(&self, place: Vec3) -> f32 {
        let Some(counted) = self.counted else { return self.diagonal };
        let at = place.to_array();
        let found = self.pilots.query(&at).nearest_n::<SquaredEuclidean<f32>>(counted).unsorted().execute();
        let distance = found.iter().map(|f| f.distance).fold(0.0, f32::max).sqrt();
        // at an edge a wider disc has as many photons, of which a part lies beyond
        let share = self.quad.map_or(1.0, |quad| share_of_disc(quad, place, distance));
        (self.factor * distance * share.sqrt()).max(1e-6 * self.diagonal).min(self.diagonal)
    }
}

/// Share of a disc about a place of a quad that lies on the quad, by a spiral of points of equal area.
fn share_of_disc(quad: &Quad, place: Vec3, radius: f32) -> f32 {
    const POINTS: usize = 32;
    let u = quad.u.normalize();
    let v = quad.normal().cross(u);
    let tips = [u, -u, v, -v];
    if tips.iter().all(|tip| quad.contains(place + *tip * radius)) {
        return 1.0; // a disc whose four tips lie on a rectangle lies on it whole
    }
    let inside = |i: &usize| {
        let (r, phi) = (radius * ((*i as f32 + 0.5) / POINTS as f32).sqrt(), *i as f32 * 2.399_963); // golden angle
        quad.contains(place + u * (r * phi.cos()) + v * (r * phi.sin()))
    };
    (0..POINTS).filter(inside).count().max(1) as f32 / POINTS as f32
}

/// Power of each band that cells have got so far, in whole numbers: their sums do not depend on the order
/// in which threads add to them.
struct CellPowers {
    sums: Vec<[AtomicU64; BANDS]>,
    /// Whole numbers for each unit of power.
    unit: f64,
}

/// The whole number for all power of a side.
const ALL: f64 = (1u64 << 62) as f64;

impl CellPowers {
    fn new(photons: &[&StoredPhoton], cells: usize) -> CellPowers {
        let total: f64 = photons.iter().map(|p| f64::from(p.power.abs())).sum();
        let sums = (0..cells).map(|_| Default::default()).collect();
        CellPowers { sums, unit: ALL / total.max(f64::MIN_POSITIVE) }
    }

    fn add(&self, cell: usize, power: &BandSpectrum) {
        for (sum, power) in self.sums[cell].iter().zip(power) {
            if *power > 0.0 {
                sum.fetch_add((f64::from(*power) * self.unit) as u64, Ordering::Relaxed);
            }
        }
    }

    fn over_areas(self, cells: &[SurfaceCell]) -> Vec<BandSpectrum> {
        let one = |(sums, cell): (&[AtomicU64; BANDS], &SurfaceCell)| {
            let over =
                |sum: &AtomicU64| sum.load(Ordering::Relaxed) as f64 / self.unit / f64::from(cell.area);
            std::array::from_fn(|b| over(&sums[b]) as f32)
        };
        self.sums.iter().zip(cells).map(one).collect()
    }
}
