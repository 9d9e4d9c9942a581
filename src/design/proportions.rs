//! Proportions of any stone, measured from its solid.

use super::hull::Hull;
use super::round_brilliant_measures::{self, FacetLengths};
use super::symmetry::{self, Symmetry};
use super::tiers::{Design, Zone};
use crate::geometry::measure::{calipers, width_directions};
use crate::geometry::{Polyhedron, SolidError};
use glam::{DVec2, DVec3};
use serde::Serialize;
use std::collections::HashSet;

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
    /// Table along the width: corner to corner in a round stone, flat to flat in a square one.
    pub table_percent: Option<f64>,
    /// Angle of the crown's main facet across the width.
    ///
    /// Main facets are those that span the greatest height of their side: the mains of a brilliant, the
    /// first step of a step cut. Of these the one counts that faces along the width most nearly, and of
    /// several that do so alike the steepest: in an oval the mains have three angles, across the width,
    /// along the length and between.
    pub crown_angle_deg: Option<f64>,
    /// Angle of the pavilion's main facet across the width, as [`Proportions::crown_angle_deg`].
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
    /// The faceter's ratios.
    pub ratios: Ratios,
    /// Symmetry about the axis.
    pub symmetry: Symmetry,
    /// Star and lower-half lengths of a round brilliant.
    pub brilliant: Option<FacetLengths>,
}

/// What GemCad and the faceting guilds print below a design: ratios to the width W, taken corner to
/// corner ([`wheel_size`]). Checked in `tests/library/cuts.rs` against
/// the figures that the US Faceters Guild published for Classic and First Stone.
#[derive(Debug, Clone, Serialize)]
pub struct Ratios {
    /// W, in the design's unit.
    pub w: f64,
    /// L/W: length to width; 1 for a round stone.
    pub l_w: f64,
    /// T/W: table to width.
    pub t_w: Option<f64>,
    /// P/W: pavilion depth to width, from the highest place of its edge with the girdle.
    pub p_w: f64,
    /// C/W: crown height to width, from the lowest place of its edge with the girdle.
    pub c_w: f64,
    /// H/W: whole depth to width.
    pub h_w: f64,
    /// Vol/W³.
    pub vol_w3: f64,
}

/// A facet smaller than this share of the squared width (0.2 µm square on a stone of 6 mm) is what
/// the rounding of a design file leaves between planes that are meant to meet in a point.
pub const SLIVER: f64 = 1e-9;

/// Corners nearer to each other than this part of the width are one: what the rounding of a file leaves
/// of planes that are meant to meet in a point.
const ONE_CORNER: f64 = 1e-5;

fn zones_of(solid: &Polyhedron) -> Vec<Zone> {
    (0..solid.faces.len()).map(|f| Zone::from_normal(solid.area_vector(f).normalize_or_zero())).collect()
}

/// Measures a design whose solid is already known.
pub fn measure(exact: &Polyhedron) -> Proportions {
    let width = exact.width();
    let exact_zones = zones_of(exact);
    let seen: Vec<bool> = (0..exact_zones.len()).map(|f| exact.area(f) > SLIVER * width * width).collect();
    // which corners a facet has must not depend on a file's last digits
    let solid = &exact.welded(ONE_CORNER * width);
    let zones = zones_of(solid);
    let (lo, hi) = exact.bounds();
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
    let outline = solid.outline();
    let flat_size = |zone| zone_faces(&zones, zone).map(|f| flat_extent(solid, f, &outline)).reduce(f64::max);
    let (length, volume) = (exact.length(), exact.volume());
    let hull = exact.hull();
    let (w, l) = wheel_size(&hull);
    let round = greatest_extent(&hull) <= ROUND * width;
    let by_zone = [Zone::Table, Zone::Crown, Zone::Girdle, Zone::Pavilion, Zone::Culet]
        .map(|zone| (zone.name(), zone_faces(&exact_zones, zone).filter(|f| seen[*f]).count()));
    Proportions {
        facets: seen.iter().filter(|s| **s).count(),
        by_zone: by_zone.to_vec(),
        width,
        length,
        table_percent: flat_size(Zone::Table).map(percent),
        crown_angle_deg: main_angle(solid, &zones, Zone::Crown, &outline),
        pavilion_angle_deg: main_angle(solid, &zones, Zone::Pavilion, &outline),
        crown_height_percent: percent(hi.z - girdle_high),
        pavilion_depth_percent: percent(girdle_low - lo.z),
        girdle_percent: percent(girdle_high - girdle_low),
        depth_percent: percent(hi.z - lo.z),
        culet_percent: flat_size(Zone::Culet).map_or(0.0, percent),
        volume,
        surface: exact.surface(),
        ratios: Ratios {
            w,
            l_w: l / w,
            t_w: flat_size(Zone::Table).map(|t| t / w),
            p_w: (scallop(solid, &zones, Zone::Pavilion).unwrap_or(girdle_low) - lo.z) / w,
            c_w: (hi.z - scallop(solid, &zones, Zone::Crown).unwrap_or(girdle_high)) / w,
            h_w: (hi.z - lo.z) / w,
            vol_w3: volume / w.powi(3),
        },
        symmetry: symmetry::measure(exact, SLIVER * width * width),
        brilliant: if round { round_brilliant_measures::lengths(solid, &zones) } else { None },
    }
}

/// Measures a design.
pub fn of_design(design: &Design) -> Result<Proportions, SolidError> {
    Ok(measure(&design.solid()?))
}

fn zone_faces(zones: &[Zone], zone: Zone) -> impl Iterator<Item = usize> + '_ {
    zones.iter().enumerate().filter(move |(_, z)| **z == zone).map(|(i, _)| i)
}

fn extent(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)))
}

/// An outline whose greatest extent is at most this many times its least is round: its flats are a
/// polished circle's. A polygon of 13 and more sides is; a square (1.41) and an octagon (1.08) are
/// not.
const ROUND: f64 = 1.03;

/// An outline stands along the wheel's axes if its extent there is at most this many times its
/// least: an octagon on its points does (1.08), a square on a point (1.41) does not.
const ALONG_AXES: f64 = 1.09;

/// W and L of an outline, corner to corner: of a round one the greatest extent, of another its
/// extents along the wheel's axes (GemCad's way: an oval of flats has corners on them), and of one
/// that does not stand along those, its least width and the length across it.
pub fn wheel_size(outline: &[DVec2]) -> (f64, f64) {
    let (least, across) = calipers(outline);
    let greatest = greatest_extent(outline);
    if greatest <= ROUND * least {
        return (greatest, greatest);
    }
    let (x, y) = (extent_along(outline, DVec2::X), extent_along(outline, DVec2::Y));
    if x.min(y) <= ALONG_AXES * least { (x.min(y), x.max(y)) } else { (least, across) }
}

/// Extent of a horizontal face along the stone's width: corner to corner in a round stone, flat to
/// flat in a square one.
///
/// - `outline`: of the whole stone
pub fn flat_extent(solid: &Polyhedron, face: usize, outline: &[DVec2]) -> f64 {
    let corners: Vec<DVec2> = solid.polygon(face).map(|v| v.truncate()).collect();
    let widest = ROUND * calipers(outline).0;
    let (outside, inside) = (Hull::new(outline), Hull::new(&corners));
    let edges = (0..outline.len()).map(|i| (outline[(i + 1) % outline.len()] - outline[i]).perp());
    let across = corners.iter().enumerate().flat_map(|(i, a)| corners[..i].iter().map(move |b| *a - *b));
    edges.chain(across).filter_map(DVec2::try_normalize).map(|d| (inside.extent(d), d)).fold(
        0.0,
        |most, (extent, d)| {
            if extent > most && outside.extent(d) <= widest { extent } else { most }
        },
    )
}

fn extent_along(points: &[DVec2], direction: DVec2) -> f64 {
    let (lo, hi) = extent(points.iter().map(|p| p.dot(direction)));
    hi - lo
}

/// Greatest distance of two corners.
fn greatest_extent(outline: &[DVec2]) -> f64 {
    let pairs = outline.iter().enumerate().flat_map(|(i, a)| outline[..i].iter().map(|b| a.distance(*b)));
    pairs.fold(0.0, f64::max)
}

/// Height at which the edge of crown or pavilion with the girdle reaches farthest toward the middle
/// of the girdle; none without such an edge.
fn scallop(solid: &Polyhedron, zones: &[Zone], zone: Zone) -> Option<f64> {
    let corners = |zone| {
        zone_faces(zones, zone).flat_map(|f| &solid.faces[f].corners).copied().collect::<HashSet<usize>>()
    };
    let (side, girdle) = (corners(zone), corners(Zone::Girdle));
    let heights = side.intersection(&girdle).map(|&c| solid.vertices[c].z);
    if zone == Zone::Crown { heights.reduce(f64::min) } else { heights.reduce(f64::max) }
}

/// Parts by which heights, widths and cosines of azimuths may differ and still count as equal: above
/// the rounding of a mesh in `f32` and of a design file in four decimals, below what a cutter tells apart.
const ALIKE: f64 = 1e-3;

/// The angle that [`Proportions::crown_angle_deg`] defines; a function of the planes alone.
fn main_angle(solid: &Polyhedron, zones: &[Zone], zone: Zone, outline: &[DVec2]) -> Option<f64> {
    let height = |f: usize| {
        let (lo, hi) = extent(solid.polygon(f).map(|v| v.z));
        hi - lo
    };
    let greatest = zone_faces(zones, zone).map(height).reduce(f64::max)?;
    let mains: Vec<DVec3> = zone_faces(zones, zone)
        .filter(|&f| height(f) >= (1.0 - ALIKE) * greatest)
        .map(|f| solid.area_vector(f))
        .collect();
    let across = width_directions(outline, ALIKE);
    let facing = |n: &DVec3| {
        let plan = n.truncate().normalize_or_zero();
        across.iter().map(|d| plan.dot(*d).abs()).fold(0.0, f64::max)
    };
    let nearest = mains.iter().map(facing).fold(0.0, f64::max);
    let angle = |n: &DVec3| n.truncate().length().atan2(n.z.abs()).to_degrees();
    mains.iter().filter(|n| facing(n) >= nearest - ALIKE).map(angle).reduce(f64::max)
}
