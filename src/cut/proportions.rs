//! Proportions of any stone, measured from its solid.

use super::design::{Design, Zone};
use crate::solid::{Polyhedron, SolidError};
use serde::Serialize;

/// What a cutter or a grader reads off a stone. Percentages are of the girdle width; a value that
/// the stone does not have (a table height without a table) is none.
#[derive(Debug, Clone, Serialize)]
pub struct Proportions {
    /// Number of facets that bound the stone, slivers of rounding left out.
    pub facets: usize,
    /// Facets by zone: table, crown, girdle, pavilion, culet.
    pub by_zone: Vec<(&'static str, usize)>,
    /// Girdle width in the design's unit: least distance of two parallel lines around the outline.
    pub width: f64,
    /// Extent of the outline across the width, in the design's unit.
    pub length: f64,
    /// Table, corner to corner along the width.
    pub table_percent: Option<f64>,
    /// Steepest of the two main angles: the crown facets that reach the girdle's thick places.
    pub crown_angle_deg: Option<f64>,
    /// Angle of the pavilion facets that reach lowest.
    pub pavilion_angle_deg: Option<f64>,
    /// From girdle top (thick places) to table.
    pub crown_height_percent: f64,
    /// From girdle bottom (thick places) to the lowest point.
    pub pavilion_depth_percent: f64,
    /// Girdle at its thick places; 0 without girdle facets.
    pub girdle_percent: f64,
    /// From table to lowest point.
    pub depth_percent: f64,
    /// Culet, as the table.
    pub culet_percent: f64,
    /// Volume in the design's unit cubed.
    pub volume: f64,
    /// Surface in the design's unit squared.
    pub surface: f64,
}

/// A facet smaller than this share of the squared width (0.2 µm square on a stone of 6 mm) is what
/// the rounding of a design file leaves between planes that are meant to meet in a point.
const SLIVER: f64 = 1e-9;

/// Measures a design whose solid is already known.
pub fn measure(solid: &Polyhedron) -> Proportions {
    let zones: Vec<Zone> =
        (0..solid.faces.len()).map(|f| Zone::of(solid.area_vector(f).normalize_or_zero())).collect();
    let (lo, hi) = solid.bounds();
    let width = solid.width();
    let seen: Vec<bool> = (0..zones.len()).map(|f| solid.area(f) > SLIVER * width * width).collect();
    let percent = |x: f64| 100.0 * x / width;
    let girdle_z: Vec<f64> =
        zone_faces(&zones, Zone::Girdle).flat_map(|f| solid.polygon(f).map(|v| v.z)).collect();
    // a stone without girdle facets has its girdle where the outline is: the widest corners
    let (girdle_low, girdle_high) = if girdle_z.is_empty() {
        let radius = |v: &glam::DVec3| v.truncate().length();
        let widest = solid.vertices.iter().map(radius).fold(0.0, f64::max);
        extent(solid.vertices.iter().filter(|v| radius(v) > widest * (1.0 - 1e-6)).map(|v| v.z))
    } else {
        extent(girdle_z.into_iter())
    };
    let flat_size = |zone| zone_faces(&zones, zone).map(|f| diameter(solid, f)).reduce(f64::max);
    let by_zone = [Zone::Table, Zone::Crown, Zone::Girdle, Zone::Pavilion, Zone::Culet]
        .map(|zone| (zone.name(), zone_faces(&zones, zone).filter(|f| seen[*f]).count()));
    Proportions {
        facets: seen.iter().filter(|s| **s).count(),
        by_zone: by_zone.to_vec(),
        width,
        length: solid.length(),
        table_percent: flat_size(Zone::Table).map(percent),
        crown_angle_deg: main_angle(solid, &zones, Zone::Crown),
        pavilion_angle_deg: main_angle(solid, &zones, Zone::Pavilion),
        crown_height_percent: percent(hi.z - girdle_high),
        pavilion_depth_percent: percent(girdle_low - lo.z),
        girdle_percent: percent(girdle_high - girdle_low),
        depth_percent: percent(hi.z - lo.z),
        culet_percent: flat_size(Zone::Culet).map_or(0.0, percent),
        volume: solid.volume(),
        surface: solid.surface(),
    }
}

/// Measures a design.
pub fn of(design: &Design) -> Result<Proportions, SolidError> {
    Ok(measure(&design.solid()?))
}

fn zone_faces(zones: &[Zone], zone: Zone) -> impl Iterator<Item = usize> + '_ {
    zones.iter().enumerate().filter(move |(_, z)| **z == zone).map(|(i, _)| i)
}

fn extent(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)))
}

/// Largest distance of two corners of a face.
fn diameter(solid: &Polyhedron, face: usize) -> f64 {
    let corners: Vec<_> = solid.polygon(face).collect();
    let pairs =
        corners.iter().enumerate().flat_map(|(i, a)| corners[i..].iter().map(move |b| a.distance(*b)));
    pairs.fold(0.0, f64::max)
}

/// Angle of the mains: of the facets of a zone that span the greatest height, which in a brilliant
/// are the mains (they alone run from the girdle to the table or culet).
fn main_angle(solid: &Polyhedron, zones: &[Zone], zone: Zone) -> Option<f64> {
    let height = |f: usize| {
        let (lo, hi) = extent(solid.polygon(f).map(|v| v.z));
        hi - lo
    };
    let angle = |f: usize| {
        let n = solid.area_vector(f);
        n.truncate().length().atan2(n.z.abs()).to_degrees()
    };
    zone_faces(zones, zone).max_by(|&a, &b| height(a).total_cmp(&height(b))).map(angle)
}
