//! Symmetry of a finished stone: how often it repeats around its axis, whether it has a mirror, and
//! how far its facets stray from that.

use crate::geometry::Polyhedron;
use glam::{DMat3, DVec3};
use serde::Serialize;
use std::collections::HashMap;

/// Symmetry about the vertical axis through the stone's centre of mass.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Symmetry {
    /// Rotational order; 1 if the stone does not repeat.
    pub order: usize,
    /// Whether a vertical mirror plane exists.
    pub mirror: bool,
    /// Largest angle between a facet and the one that it turns into, in degrees.
    pub deviation_deg: f64,
}

/// A facet answers another if their normals differ by less than this many degrees and their
/// distances by less than [`ASTRAY`] of the stone's radius: cutters hold a tenth of a degree; real
/// neighbours differ by more than two.
const ASTRAY_DEG: f64 = 1.0;

/// See [`ASTRAY_DEG`].
const ASTRAY: f64 = 0.01;

/// Measures the symmetry; faces smaller than `sliver` (area) are left out.
pub fn measure(solid: &Polyhedron, sliver: f64) -> Symmetry {
    let (_, centre) = solid.volume_and_centre();
    let facets: Vec<(DVec3, f64)> = (0..solid.faces.len())
        .filter(|&f| solid.area(f) > sliver)
        .filter_map(|f| {
            let normal = solid.area_vector(f).try_normalize()?;
            Some((normal, normal.dot(solid.polygon(f).next()? - centre)))
        })
        .collect();
    let radius = solid.bounding_sphere().1;
    let near = by_direction(&facets);
    let strays = |image: DMat3| strays_by(&facets, &near, image, ASTRAY * radius);
    let turned = (2..=facets.len().min(TRIED)).rev().find_map(|n| {
        let deviation = strays(DMat3::from_rotation_z(std::f64::consts::TAU / n as f64))?;
        Some((n, deviation))
    });
    let azimuth = |n: DVec3| n.y.atan2(n.x);
    let mirrored = facets.iter().find(|(n, _)| n.truncate().length() > 0.01).and_then(|(first, _)| {
        facets
            .iter()
            .filter(|(other, _)| (other.z - first.z).abs() < CELL)
            .take(TRIED)
            .filter_map(|(other, _)| {
                let (s, c) = (azimuth(*first) + azimuth(*other)).sin_cos();
                strays(DMat3::from_cols(DVec3::new(c, s, 0.0), DVec3::new(s, -c, 0.0), DVec3::Z))
            })
            .reduce(f64::min)
    });
    let (order, deviation) = turned.unwrap_or((1, 0.0));
    Symmetry { order, mirror: mirrored.is_some(), deviation_deg: deviation.max(mirrored.unwrap_or_default()) }
}

/// Side of the cells by which facets of a direction are found: a little more than [`ASTRAY_DEG`].
const CELL: f64 = 0.02;

/// Most rotations and most mirrors that are tried: no wheel has finer symmetry.
const TRIED: usize = 128;

type Cells = HashMap<[i32; 3], Vec<usize>>;

fn cell(n: DVec3) -> [i32; 3] {
    (n / CELL).floor().to_array().map(|c| c as i32)
}

/// Numbers of the facets by the cell of their normals.
fn by_direction(facets: &[(DVec3, f64)]) -> Cells {
    let mut cells = Cells::new();
    facets.iter().enumerate().for_each(|(i, (n, _))| cells.entry(cell(*n)).or_default().push(i));
    cells
}

/// The largest angle between a facet's image and the facet nearest to it, in degrees; none if some
/// image has no facet near it.
fn strays_by(facets: &[(DVec3, f64)], near: &Cells, image: DMat3, apart: f64) -> Option<f64> {
    let mut largest = 0.0f64;
    for (normal, distance) in facets {
        let turned = image * *normal;
        let angle = |n: &DVec3| n.cross(turned).length().atan2(n.dot(turned)).to_degrees();
        let [x, y, z] = cell(turned);
        let around = (0..27).map(|k| [x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1]);
        let nearest = around
            .filter_map(|c| near.get(&c))
            .flatten()
            .map(|&i| &facets[i])
            .filter(|(_, d)| (d - distance).abs() < apart)
            .map(|(n, _)| angle(n))
            .fold(f64::INFINITY, f64::min);
        if nearest > ASTRAY_DEG {
            return None;
        }
        largest = largest.max(nearest);
    }
    Some(largest)
}
