//! Facets as a cutter reads them, by angle, distance and index: for the formats that store planes,
//! and for writing designs whose facets were never cut by index.

use crate::design::tiers::facet_normal;
use crate::design::{Design, Facet, Gear, Tier};
use crate::geometry::Plane;
use glam::DVec3;

/// Angles in degrees and indices in teeth nearer than this to six decimals are meant so: above the
/// rounding of `f64` in a stored normal, far below what a faceter can set.
const MEANT: f64 = 1e-11;

/// A normal and a distance (in parts of itself) that differ by less than this are the same.
const SAME: f64 = 1e-13;

/// Facets of one tier at one angle and distance.
#[derive(Debug)]
pub struct CuttingRow<'d> {
    /// The tier they are part of.
    pub tier: &'d Tier,
    /// Angle from the girdle plane in degrees; its sign (also of 0) tells crown from pavilion.
    pub angle_deg: f64,
    /// Distance from the origin.
    pub distance: f64,
    /// The facets, in cutting order.
    pub facets: Vec<CutFacet<'d>>,
}

/// One facet of a [`CuttingRow`].
#[derive(Debug)]
pub struct CutFacet<'d> {
    /// Its number in [`Design::facets`].
    pub number: usize,
    /// Its index, whole or not, from above 0 to the number of teeth: no faceting file has a tooth 0.
    pub index: f64,
    /// Its name; of a tier's facets `main 1`, `main 2` … the first is called `main`, the rest have none.
    pub name: &'d str,
    /// Its plane.
    pub plane: Plane,
}

/// The cutting table: every tier as one row, or as several if its facets differ.
///
/// A facet keeps the angle and index it is stated with if they give its very plane (1e-13);
/// otherwise both are computed from its normal. Checked in `tests/library/formats.rs`.
pub fn rows(design: &Design) -> Vec<CuttingRow<'_>> {
    let mut rows: Vec<CuttingRow> = Vec::new();
    let mut number = 0;
    for tier in &design.tiers {
        let first = rows.len();
        let numbered = |name: &str| {
            let number = name.strip_prefix(&*tier.name).and_then(|n| n.strip_prefix(' '));
            number.is_some_and(|n| n.parse::<usize>().is_ok())
        };
        let has_own_name = tier.facets.iter().any(|f| f.name == tier.name);
        for facet in &tier.facets {
            let (angle_deg, index) = cut_facet(design.gear, tier, facet);
            let name = if numbered(&facet.name) { "" } else { &*facet.name };
            let index = on_wheel(design.gear, index);
            let cut = CutFacet { number, index, name, plane: facet.plane };
            number += 1;
            let distance = facet.plane.distance;
            let same = |r: &&mut CuttingRow| {
                (r.angle_deg == angle_deg && r.angle_deg.is_sign_negative() == angle_deg.is_sign_negative())
                    && (r.distance - distance).abs() <= SAME * distance.abs()
            };
            match rows[first..].last_mut().filter(same) {
                Some(row) => row.facets.push(cut),
                None => {
                    let name = if cut.name.is_empty() && !has_own_name { &*tier.name } else { cut.name };
                    rows.push(CuttingRow {
                        tier,
                        angle_deg,
                        distance,
                        facets: vec![CutFacet { name, ..cut }],
                    });
                }
            }
        }
    }
    rows
}

/// Angle and index that give the facet's plane: as stated, to six decimals, or as computed.
fn cut_facet(gear: Gear, tier: &Tier, facet: &Facet) -> (f64, f64) {
    let normal = facet.plane.normal;
    let (angle, index) = (exact_angle(normal), exact_index(gear, normal));
    let stated = (tier.angle_deg.unwrap_or_else(|| angle_of_mesh(normal)), facet.index.unwrap_or(index));
    let gives = |(angle, index): (f64, f64)| {
        let made = facet_normal(gear, angle, index);
        made.distance(normal) <= SAME && (normal.z == 0.0 || made.z != 0.0 || angle.abs() == 90.0)
    };
    [stated, (angle_deg(normal), index_of(gear, normal)), (angle, index_of(gear, normal))]
        .into_iter()
        .find(|c| gives(*c))
        .unwrap_or((angle, index))
}

/// The angle in degrees of a facet with that normal: the first of those `stated` that gives it (1e-13), else as
/// computed.
pub fn angle_as_stated(stated: &[f64], normal: DVec3) -> f64 {
    let gives = |angle: &f64| {
        let made = facet_normal(Gear::default(), *angle, 0.0);
        (made.truncate().length() - normal.truncate().length()).hypot(made.z - normal.z) <= SAME
    };
    let computed = [angle_deg(normal), exact_angle(normal)];
    stated.iter().chain(&computed).copied().find(gives).unwrap_or(computed[1])
}

/// The index of a facet with that normal, cut at `angle_deg`: the first of those `stated` that gives it (1e-13),
/// else as computed.
pub fn index_as_stated(gear: Gear, stated: &[f64], angle_deg: f64, normal: DVec3) -> f64 {
    let gives = |index: &f64| facet_normal(gear, angle_deg, *index).distance(normal) <= SAME;
    stated.iter().copied().find(gives).unwrap_or_else(|| index_of(gear, normal))
}

/// The angle of a facet from the girdle plane in degrees, with the sign (also of 0) of the normal's
/// z, to six decimals if that is meant.
pub fn angle_deg(normal: DVec3) -> f64 {
    round_to_meant(exact_angle(normal))
}

/// As [`angle_deg`], but always -90 for the girdle, as most faceters have it.
pub fn angle_of_mesh(normal: DVec3) -> f64 {
    match angle_deg(normal) {
        90.0 => -90.0,
        angle => angle,
    }
}

/// The index of a facet on the wheel, above 0 and up to the number of teeth, to six decimals if
/// that is meant.
pub fn index_of(gear: Gear, normal: DVec3) -> f64 {
    on_wheel(gear, round_to_meant(exact_index(gear, normal)))
}

/// The index as faceting files have it: above 0 and up to the number of teeth.
fn on_wheel(gear: Gear, index: f64) -> f64 {
    let teeth = gear.teeth.abs();
    match index.rem_euclid(teeth) {
        0.0 => teeth,
        index => index,
    }
}

fn exact_angle(normal: DVec3) -> f64 {
    let angle = normal.truncate().length().atan2(normal.z.abs()).to_degrees();
    if normal.z.is_sign_negative() { -angle } else { angle }
}

/// The inverse of [`facet_normal`]; for a horizontal facet the index at −y.
fn exact_index(gear: Gear, normal: DVec3) -> f64 {
    let turns = if normal.x == 0.0 && normal.y == 0.0 {
        0.0
    } else {
        normal.x.atan2(-normal.y) / std::f64::consts::TAU
    };
    let index = (turns * gear.teeth + gear.offset).rem_euclid(gear.teeth.abs());
    if index == 0.0 { gear.teeth.abs() } else { index }
}

fn round_to_meant(x: f64) -> f64 {
    let rounded = (x * 1e6).round() / 1e6;
    if (x - rounded).abs() < MEANT { rounded } else { x }
}

/// The header or footer lines as at most `most`: what is over is joined to the last.
pub fn at_most(most: usize, lines: &[String]) -> Vec<String> {
    let lines = unblank(lines);
    let (kept, over) = lines.split_at(lines.len().min(most));
    let mut kept: Vec<String> = kept.iter().map(|l| one_line(l)).collect();
    if let Some(end) = kept.last_mut() {
        over.iter().for_each(|l| *end = format!("{end} {}", one_line(l)));
    }
    kept
}

/// The lines up to the last that is not blank.
pub fn unblank(lines: &[String]) -> &[String] {
    &lines[..lines.iter().rposition(|l| !l.trim().is_empty()).map_or(0, |i| i + 1)]
}

/// The header lines, or the design's name if it has none.
pub fn headers(design: &Design) -> Vec<String> {
    if design.headers.iter().any(|h| !h.trim().is_empty()) {
        design.headers.clone()
    } else {
        vec![design.name.clone()]
    }
}

/// The footnotes, or the source of the proportions if there are none.
pub fn footers(design: &Design) -> Vec<String> {
    if design.footers.is_empty() { vec![design.source.clone()] } else { design.footers.clone() }
}

/// The text with control characters as spaces.
pub fn one_line(text: &str) -> String {
    text.replace(char::is_control, " ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angle_and_index_are_the_inverse_of_the_normal() {
        for gear in [(96.0, 0.0), (-96.0, 48.0), (80.0, 40.0), (77.0, 0.5)] {
            let gear = Gear { teeth: gear.0, offset: gear.1 };
            for (angle, index) in [(34.5, 3.0), (-41.25, 12.345), (-90.0, 77.0), (89.9, 0.25), (-0.01, 50.0)]
            {
                let normal = facet_normal(gear, angle, index);
                assert!((angle_deg(normal) - angle).abs() < 1e-11, "{gear:?} {angle}");
                assert_eq!(index_of(gear, normal), index, "{gear:?} {angle}");
            }
        }
        assert!(angle_deg(DVec3::NEG_Z).is_sign_negative() && angle_deg(DVec3::Z).is_sign_positive());
        assert_eq!((angle_deg(DVec3::X), angle_of_mesh(DVec3::X)), (90.0, -90.0));
    }

    #[test]
    fn headers_over_the_limit_are_joined() {
        let lines = ["a", "b", "c\n", "d", "e", ""].map(String::from);
        assert_eq!(at_most(4, &lines), ["a", "b", "c ", "d e"]);
        assert_eq!(at_most(4, &lines[..1]), ["a"]);
        assert!(at_most(4, &["".into()]).is_empty());
    }
}
