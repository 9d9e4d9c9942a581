//! Names inside facets: the largest that fits, in the middle of the room there is for it.

use crate::report::raster::text_width;
use glam::DVec2;

/// Height of capitals and figures in the fonts of the binary, in units of the font size.
pub const CAPITAL: f64 = 0.729;

/// Largest and least size of a name, in mm: about 8 and 4 points.
const SIZES: (f64, f64) = (2.8, 1.4);

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
}

/// Half the box of a text of font size 1.
pub fn half_box(text: &str) -> DVec2 {
    DVec2::new(0.5 * text_width(text, false), 0.5 * CAPITAL)
}

/// Places one text in as many of the polygons as have room for it, at one size: the largest that all
/// of them take.
///
/// - `polygons`: convex, either way round, in mm
pub fn place(text: &str, polygons: &[&[DVec2]]) -> Vec<Label> {
    let half = half_box(text) + CLEAR;
    let fits: Vec<(usize, f64)> =
        polygons.iter().enumerate().filter_map(|(i, p)| Some((i, largest(p, half)?))).collect();
    let size = fits.iter().map(|(_, size)| *size).fold(SIZES.0, f64::min);
    fits.iter()
        .filter_map(|&(polygon, _)| {
            Some(Label { polygon, at: middle(&room(polygons[polygon], half * size)), size })
                .filter(|label| label.at.is_finite())
        })
        .collect()
}

/// The largest size at which a box of half size `half` at size 1 fits; none below the least.
fn largest(polygon: &[DVec2], half: DVec2) -> Option<f64> {
    let fits = |size: f64| !room(polygon, half * size).is_empty();
    if fits(SIZES.0) {
        return Some(SIZES.0);
    }
    if !fits(SIZES.1) {
        return None;
    }
    let (mut low, mut high) = SIZES;
    std::mem::swap(&mut low, &mut high);
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
        let label = place("P1", &[&square])[0];
        assert!((label.at - DVec2::splat(4.5)).length() < 1e-9 && label.size == SIZES.0);
        let mut small = square.map(|p| p * 0.25);
        small.reverse();
        let label = place("P1", &[&small])[0];
        let width = 2.0 * label.size * (half_box("P1").x + CLEAR);
        assert!((width - 2.25).abs() < 1e-3, "{width}");
        // one too small for it is left out, the others share the least size
        let tiny = square.map(|p| p * 0.1);
        let labels = place("P1", &[&square, &tiny, &small]);
        assert_eq!(labels.iter().map(|l| l.polygon).collect::<Vec<_>>(), [0, 2]);
        assert!(labels.iter().all(|l| l.size == label.size));
    }
}
