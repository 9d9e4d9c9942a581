//! Names inside facets: the largest that fits, in the middle of the room there is for it.

use super::sheet::CAPITAL;
use crate::report::raster::text_width;
use glam::DVec2;

/// Largest and least size of a name in mm, about 8 and 4 points; the least of one that would
/// otherwise stand nowhere.
const SIZES: (f64, f64) = (2.8, 1.4);
const LAST: f64 = 1.0;

/// Facets that take a name of this part of the largest size are named alike, smaller ones smaller.
const ALIKE: f64 = 0.7;

/// Space kept to the edges, in units of the font size.
const CLEAR: f64 = 0.16;

/// A name that has found its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Label {
    /// Number of the polygon it stands in.
    pub polygon: usize,
    /// Middle of the text.
    pub at: DVec2,
    /// Font size.
    pub size: f64,
    /// Direction of its line; to the right if it is level.
    pub along: DVec2,
}

/// Half the box of a text of font size 1.
pub fn half_box(text: &str) -> DVec2 {
    DVec2::new(0.5 * text_width(text, false), 0.5 * CAPITAL)
}

/// Places one text in as many of the polygons as have room for it. Large facets have it at one size,
/// small ones at another.
///
/// - `polygons`: convex, either way round, in mm
/// - `pressed`: what fits nowhere level is placed along the longest edges, and if not even so, once
///   in small print
pub fn place(text: &str, polygons: &[&[DVec2]], pressed: bool) -> Vec<Label> {
    let half = half_box(text) + CLEAR;
    let level = |_: &[DVec2]| DVec2::X;
    let mut fits = all_fits(polygons, half, SIZES.1, level);
    if fits.is_empty() && pressed {
        fits = all_fits(polygons, half, SIZES.1, longest_edge);
    }
    if fits.is_empty() && pressed {
        fits = all_fits(polygons, half, LAST, longest_edge);
        fits.sort_by(|a, b| b.size.total_cmp(&a.size));
        fits.truncate(1);
    }
    let largest = fits.iter().map(|f| f.size).fold(0.0, f64::max);
    let alike = |size: f64| size >= ALIKE * largest;
    let least = |group: bool| {
        let sizes = fits.iter().map(|f| f.size).filter(|s| alike(*s) == group);
        sizes.fold(SIZES.0, f64::min)
    };
    let sizes = (least(true), least(false));
    fits.iter()
        .map(|fit| {
            let size = if alike(fit.size) { sizes.0 } else { sizes.1 };
            let turned = turned(polygons[fit.polygon], fit.along);
            let at = middle(&room(&turned, half * size)).rotate(fit.along);
            Label { at, size, ..*fit }
        })
        .filter(|label| label.at.is_finite())
        .collect()
}

/// In which polygons a box of half size `half` at size 1 fits, and how large.
fn all_fits(polygons: &[&[DVec2]], half: DVec2, least: f64, line: fn(&[DVec2]) -> DVec2) -> Vec<Label> {
    let fit = |(polygon, corners): (usize, &&[DVec2])| {
        let along = line(corners);
        let size = largest(&turned(corners, along), half, least)?;
        Some(Label { polygon, at: DVec2::ZERO, size, along })
    };
    polygons.iter().enumerate().filter_map(fit).collect()
}

/// The polygon turned so that `along` comes to lie level.
fn turned(polygon: &[DVec2], along: DVec2) -> Vec<DVec2> {
    polygon.iter().map(|p| DVec2::new(along.x, -along.y).rotate(*p)).collect()
}

/// Direction of the longest edge, so that what stands along it is not read upside down.
fn longest_edge(polygon: &[DVec2]) -> DVec2 {
    let edges = (0..polygon.len()).map(|i| polygon[(i + 1) % polygon.len()] - polygon[i]);
    let longest = edges.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
    let along = longest.unwrap_or(DVec2::X).normalize_or(DVec2::X);
    if along.x < -1e-9 || (along.x < 1e-9 && along.y > 0.0) { -along } else { along }
}

/// The largest size at which a box fits; none below `least`.
fn largest(polygon: &[DVec2], half: DVec2, least: f64) -> Option<f64> {
    let fits = |size: f64| !room(polygon, half * size).is_empty();
    if fits(SIZES.0) {
        return Some(SIZES.0);
    }
    if !fits(least) {
        return None;
    }
    let (mut low, mut high) = (least, SIZES.0);
    for _ in 0..12 {
        let size = 0.5 * (low + high);
        if fits(size) { low = size } else { high = size }
    }
    Some(low)
}

/// Where the middle of a box may stand so that the box lies in the polygon: the polygon with every
/// edge moved inwards by the box's half extent across it. Empty if there is no such place.
fn room(polygon: &[DVec2], half: DVec2) -> Vec<DVec2> {
    let turn = (0..polygon.len()).map(|i| polygon[i].perp_dot(polygon[(i + 1) % polygon.len()])).sum::<f64>();
    let mut left = polygon.to_vec();
    for (i, &a) in polygon.iter().enumerate() {
        let Some(along) = (polygon[(i + 1) % polygon.len()] - a).try_normalize() else { continue };
        let inward = along.perp() * turn.signum();
        let least = inward.dot(a) + inward.abs().dot(half);
        let inside = |p: DVec2| inward.dot(p) - least;
        let corners = std::mem::take(&mut left);
        for (j, &p) in corners.iter().enumerate() {
            let q = corners[(j + 1) % corners.len()];
            let (hp, hq) = (inside(p), inside(q));
            if hp >= 0.0 {
                left.push(p);
            }
            if hp * hq < 0.0 {
                left.push(p + (q - p) * (hp / (hp - hq)));
            }
        }
    }
    left
}

/// Centre of area; of a room without area the mean of its corners.
fn middle(polygon: &[DVec2]) -> DVec2 {
    let mean = polygon.iter().sum::<DVec2>() / polygon.len() as f64;
    let (mut area, mut moment) = (0.0, DVec2::ZERO);
    for (i, &p) in polygon.iter().enumerate() {
        let (p, q) = (p - mean, polygon[(i + 1) % polygon.len()] - mean);
        area += p.perp_dot(q);
        moment += (p + q) * p.perp_dot(q) / 3.0;
    }
    if area.abs() < 1e-9 { mean } else { mean + moment / area }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_stands_in_the_middle_of_a_square_and_is_as_large_as_fits() {
        let square = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)].map(|(x, y)| DVec2::new(x, y));
        let label = place("P1", &[&square], true)[0];
        assert!((label.at - DVec2::splat(4.5)).length() < 1e-9 && label.size == SIZES.0);
        let mut small = square.map(|p| p * 0.25);
        small.reverse();
        let label = place("P1", &[&small], true)[0];
        let width = 2.0 * label.size * (half_box("P1").x + CLEAR);
        assert!((width - 2.25).abs() < 1e-3, "{width}");
        // one too small for it is left out
        let tiny = square.map(|p| p * 0.1);
        let labels = place("P1", &[&square, &tiny, &small], true);
        assert_eq!(labels.iter().map(|l| l.polygon).collect::<Vec<_>>(), [0, 2]);
        assert!(labels.iter().all(|l| l.along == DVec2::X));
    }

    #[test]
    fn a_name_too_wide_for_a_sliver_stands_along_it_and_last_of_all_once() {
        let corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 20.0), (0.0, 20.0)].map(|(x, y)| DVec2::new(x, y));
        let label = place("P12", &[&corners], true)[0];
        assert!((label.along - DVec2::NEG_Y).length() < 1e-12, "{label:?}"); // upwards on the page
        assert!((label.at - DVec2::new(1.0, 10.0)).length() < 1e-9);
        let thin = corners.map(|p| p * DVec2::new(0.6, 1.0));
        let labels = place("P12", &[&thin, &thin], true);
        assert!(labels.len() == 1 && labels[0].size < SIZES.1);
        assert!(place("P12", &[&corners], false).is_empty());
    }
}
