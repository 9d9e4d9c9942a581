//! The shape of a stone's outline, by the name that cutters give it.

use crate::geometry::Polyhedron;
use crate::geometry::measure::centroid;
use crate::parse;
use glam::DVec2;
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::fmt;
use std::str::FromStr;

/// The shape of a stone's outline, seen from above: a function of the convex hull of its corners alone.
///
/// With the outline's reach r(φ) from its centre of area in the direction φ, its width (the least distance of two
/// parallel lines around it), its length (across the width), its sides, those that are long (an eighth of the
/// perimeter or more) and its points (corners that turn by 45° or more), the first that holds:
///
/// | shape | rule |
/// |---|---|
/// | round | r is the same within 4.5 % everywhere: twelve sides and more |
/// | triangle, pentagon, hexagon, octagon, polygon | turned by 1/3, 1/5, 1/6, 1/8, or another part of a circle down to 1/12 but 1/2 and 1/4, it falls upon itself; straight sides or bent |
/// | square | turned by 1/4 it falls upon itself, and its four long sides make half of the perimeter: cut corners or not |
/// | cushion | turned by 1/4 it falls upon itself, and its sides are bent |
/// | rectangle | turned by 1/2 it falls upon itself, long sides make 60 % of the perimeter, and it fills 85 % of length × width: cut corners or not |
/// | marquise | turned by 1/2 it falls upon itself, has two points and fills less than 78 % of length × width |
/// | hexagon, octagon | turned by 1/2 it falls upon itself, six long sides of six, four long ones of eight |
/// | cushion | turned by 1/2 it falls upon itself and fills 84 % of length × width |
/// | oval | turned by 1/2 it falls upon itself and has six sides or more; or without points, and its ends differ by less than 1 % of its length |
/// | pear | the same on both sides of a line, with at most one point and two long sides: eggs and drops too |
/// | triangle | three points, and three long sides make 60 % of the perimeter |
/// | other | shields, kites, lozenges and what has no symmetry |
///
/// It falls upon itself where r differs by no more than 2 % of the width. Checked in `tests/library/outlines.rs`
/// against the classes that the GemCad design catalogue gives 300 designs.
///
/// ```
/// use cutlab::Stone;
/// use cutlab::advanced::design::outline_shape::OutlineShape;
///
/// let stone = Stone::parse("marquise")?;
/// assert_eq!(OutlineShape::of(stone.solid().unwrap()), OutlineShape::Marquise);
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum OutlineShape {
    /// A circle of flats.
    Round,
    /// Rounded ends, longer than wide.
    Oval,
    /// One end narrower than the other.
    Pear,
    /// Two pointed ends.
    Marquise,
    /// Four straight sides, as long as wide.
    Square,
    /// Straight sides, longer than wide.
    Rectangle,
    /// Bent sides and rounded corners.
    Cushion,
    /// Three sides, straight or bent.
    Triangle,
    /// Five sides.
    Pentagon,
    /// Six sides.
    Hexagon,
    /// Eight sides.
    Octagon,
    /// Another regular polygon.
    Polygon,
    /// None of these.
    Other,
}

/// Directions in which the outline's reach is taken: at the teeth of a wheel of 96, 120 or 80, and halfway between them.
const DIRECTIONS: usize = 960;

/// What the reach may differ by in parts of the width, where an outline falls upon itself.
const SAME: f64 = 0.02;

/// The finest turn that is tried, as one over so many: an outline of dozens of sides falls upon itself nearly enough
/// by any turn of one side.
const FINEST: usize = 12;

/// The reach of a round outline is the same to this part: sides of a twelve-gon reach 3.5 % less than its corners.
const ROUND: f64 = 1.045;

/// A side shorter than this part of the perimeter is what the rounding of a file leaves between corners.
const SHORT: f64 = 1e-3;

/// A corner that turns by less, in degrees, lies on a side: of a facet that reaches the outline between two others.
const STRAIGHT_DEG: f64 = 0.2;

/// A side is long from this part of the perimeter on: below that of an octagon.
const LONG: f64 = 0.12;

/// A corner is a point from this turn on, in degrees: that of an octagon's.
const POINT_DEG: f64 = 45.0 - 1e-6;

/// A convex outline about its centre of area, counter-clockwise.
struct Outline {
    corners: Vec<DVec2>,
    /// Its reach in evenly spaced directions.
    reach: Vec<f64>,
    width: f64,
    length: f64,
}

impl OutlineShape {
    /// Every shape.
    pub const ALL: [OutlineShape; 13] = [
        OutlineShape::Round,
        OutlineShape::Oval,
        OutlineShape::Pear,
        OutlineShape::Marquise,
        OutlineShape::Square,
        OutlineShape::Rectangle,
        OutlineShape::Cushion,
        OutlineShape::Triangle,
        OutlineShape::Pentagon,
        OutlineShape::Hexagon,
        OutlineShape::Octagon,
        OutlineShape::Polygon,
        OutlineShape::Other,
    ];

    /// The shape of a stone's outline.
    pub fn of(stone: &Polyhedron) -> OutlineShape {
        let outline = Outline::new(stone.outline());
        let sides = outline.corners.len();
        if sides < 3 {
            return OutlineShape::Other;
        }
        let (long, straight) = outline.long_sides();
        let (points, fill) = (outline.points(), outline.area() / (outline.length * outline.width));
        let mirrored = outline.mirror();
        let is_even = mirrored.is_some_and(|ends| ends < 0.01 * outline.length) && points == 0;
        match outline.order() {
            _ if outline.roundness() <= ROUND => OutlineShape::Round,
            3 => OutlineShape::Triangle,
            5 => OutlineShape::Pentagon,
            6 => OutlineShape::Hexagon,
            8 => OutlineShape::Octagon,
            7.. => OutlineShape::Polygon,
            4 if long == 4 && straight >= 0.5 => OutlineShape::Square,
            4 => OutlineShape::Cushion,
            order if order == 2 || is_even => match (sides, points) {
                _ if long >= 2 && straight >= 0.6 && fill >= 0.85 => OutlineShape::Rectangle,
                (6.., 2) if fill < 0.78 => OutlineShape::Marquise,
                (6, _) if long == 6 => OutlineShape::Hexagon,
                (8, _) if long >= 4 => OutlineShape::Octagon,
                (..6, _) => OutlineShape::Other,
                _ if fill >= 0.84 => OutlineShape::Cushion,
                _ => OutlineShape::Oval,
            },
            _ if mirrored.is_some() && points <= 1 && long <= 2 => OutlineShape::Pear,
            _ if points == 3 && long == 3 && straight >= 0.6 => OutlineShape::Triangle,
            _ => OutlineShape::Other,
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            OutlineShape::Round => "round",
            OutlineShape::Oval => "oval",
            OutlineShape::Pear => "pear",
            OutlineShape::Marquise => "marquise",
            OutlineShape::Square => "square",
            OutlineShape::Rectangle => "rectangle",
            OutlineShape::Cushion => "cushion",
            OutlineShape::Triangle => "triangle",
            OutlineShape::Pentagon => "pentagon",
            OutlineShape::Hexagon => "hexagon",
            OutlineShape::Octagon => "octagon",
            OutlineShape::Polygon => "polygon",
            OutlineShape::Other => "other",
        }
    }
}

impl fmt::Display for OutlineShape {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A name that no shape of an outline has.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("no outline is called '{name}': {all}", all = OutlineShape::ALL.map(OutlineShape::name).join(", "))]
pub struct NoSuchOutline {
    name: String,
}

impl FromStr for OutlineShape {
    type Err = NoSuchOutline;

    fn from_str(text: &str) -> Result<OutlineShape, NoSuchOutline> {
        let found = OutlineShape::ALL.into_iter().find(|shape| parse::is_name(shape.name(), text));
        found.ok_or_else(|| NoSuchOutline { name: text.trim().into() })
    }
}

impl Outline {
    /// - `hull`: the outline's corners, counter-clockwise
    fn new(hull: Vec<DVec2>) -> Outline {
        let centre = centroid(&hull);
        let perimeter: f64 = sides(&hull).map(DVec2::length).sum();
        let is_side = |(_, side): &(&DVec2, DVec2)| side.length() >= SHORT * perimeter;
        let apart: Vec<DVec2> =
            hull.iter().zip(sides(&hull)).filter(is_side).map(|(corner, _)| *corner - centre).collect();
        let turns = turns_deg(&apart);
        let corners =
            apart.iter().zip(turns).filter(|(_, turn)| *turn >= STRAIGHT_DEG).map(|(c, _)| *c).collect();
        let mut outline = Outline { corners, reach: Vec::new(), width: 0.0, length: 0.0 };
        outline.reach = (0..DIRECTIONS).map(|i| outline.reach(TAU * i as f64 / DIRECTIONS as f64)).collect();
        let extent = |angle: f64| outline.reach(angle) + outline.reach(angle + PI);
        let across = outline.sides().map(|side| side.to_angle() - FRAC_PI_2);
        let least = across.map(|angle| (extent(angle), angle)).min_by(|a, b| a.0.total_cmp(&b.0));
        let (width, angle) = least.unwrap_or_default();
        (outline.width, outline.length) = (width, extent(angle + FRAC_PI_2));
        outline
    }

    /// The farthest that it reaches from its centre in a direction, an angle from +x.
    fn reach(&self, angle: f64) -> f64 {
        let direction = DVec2::from_angle(angle);
        self.corners.iter().map(|corner| corner.dot(direction)).fold(0.0, f64::max)
    }

    /// Its sides as vectors, the one after each corner.
    fn sides(&self) -> impl Iterator<Item = DVec2> + '_ {
        sides(&self.corners)
    }

    fn area(&self) -> f64 {
        let n = self.corners.len();
        (0..n).map(|i| 0.5 * self.corners[i].perp_dot(self.corners[(i + 1) % n])).sum()
    }

    /// Greatest reach over the least.
    fn roundness(&self) -> f64 {
        let most = self.reach.iter().copied().fold(0.0, f64::max);
        most / self.reach.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// The finest part of a circle by which it can be turned upon itself, as one over so many: as many as its sides
    /// can be divided by, and no more than [`FINEST`].
    fn order(&self) -> usize {
        let falls = |parts: &usize| {
            let by = TAU / *parts as f64;
            let turned = |i: usize| self.reach(TAU * i as f64 / DIRECTIONS as f64 + by);
            (0..DIRECTIONS).all(|i| (turned(i) - self.reach[i]).abs() <= SAME * self.width)
        };
        let sides = self.corners.len();
        (2..=sides.min(FINEST)).rev().filter(|parts| sides.is_multiple_of(*parts)).find(falls).unwrap_or(1)
    }

    /// By how much the ends of its best line of symmetry differ in their reach; none of an outline without one.
    fn mirror(&self) -> Option<f64> {
        let at = |i: usize| self.reach[i % DIRECTIONS];
        let strays = |axis: usize| {
            let pairs = (1..DIRECTIONS / 2).map(|i| at(axis + i) - at(axis + DIRECTIONS - i));
            pairs.map(f64::abs).fold(0.0, f64::max)
        };
        let axes = (0..DIRECTIONS / 2).map(|axis| (strays(axis), axis));
        let (off, axis) = axes.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (off <= SAME * self.width).then(|| (at(axis) - at(axis + DIRECTIONS / 2)).abs())
    }

    /// How many of its sides are long, and which part of the perimeter they are.
    fn long_sides(&self) -> (usize, f64) {
        let perimeter: f64 = self.sides().map(DVec2::length).sum();
        let long: Vec<f64> =
            self.sides().map(|s| s.length() / perimeter).filter(|part| *part >= LONG).collect();
        (long.len(), long.iter().sum())
    }

    /// How many of its corners are points.
    fn points(&self) -> usize {
        turns_deg(&self.corners).iter().filter(|turn| **turn >= POINT_DEG).count()
    }
}

/// The sides of a polygon as vectors, the one after each corner.
fn sides(corners: &[DVec2]) -> impl Iterator<Item = DVec2> + '_ {
    let n = corners.len();
    (0..n).map(move |i| corners[(i + 1) % n] - corners[i])
}

/// By how much the sides of a polygon turn at each corner, in degrees.
fn turns_deg(corners: &[DVec2]) -> Vec<f64> {
    let sides: Vec<DVec2> = sides(corners).collect();
    let before = |i: usize| sides[(i + sides.len() - 1) % sides.len()];
    (0..sides.len()).map(|i| before(i).angle_to(sides[i]).to_degrees()).collect()
}
