//! Volume, surface, centre, outline and width of a solid.

use super::polyhedron::Polyhedron;
use glam::{DVec2, DVec3};

impl Polyhedron {
    /// Volume and centre of mass, in the design's unit (cubed).
    pub fn volume_and_centre(&self) -> (f64, DVec3) {
        let origin = self.vertices.iter().sum::<DVec3>() / self.vertices.len() as f64;
        let (mut volume, mut moment) = (0.0, DVec3::ZERO);
        for f in 0..self.faces.len() {
            let mut corners = self.polygon(f).map(|v| v - origin);
            let Some(a) = corners.next() else { continue };
            let rest: Vec<_> = corners.collect();
            for pair in rest.windows(2) {
                let v = a.dot(pair[0].cross(pair[1])) / 6.0;
                volume += v;
                moment += (a + pair[0] + pair[1]) * (v / 4.0);
            }
        }
        (volume, origin + moment / volume)
    }

    /// Volume, in the design's unit cubed.
    pub fn volume(&self) -> f64 {
        self.volume_and_centre().0
    }

    /// The area of a face as a vector along its outward normal.
    pub fn area_vector(&self, face: usize) -> DVec3 {
        let corners: Vec<_> = self.polygon(face).collect();
        let mut sum = DVec3::ZERO;
        for i in 1..corners.len().saturating_sub(1) {
            sum += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
        }
        sum * 0.5
    }

    /// Area of a face, in the design's unit squared.
    pub fn area(&self, face: usize) -> f64 {
        self.area_vector(face).length()
    }

    /// Surface area, in the design's unit squared.
    pub fn surface(&self) -> f64 {
        (0..self.faces.len()).map(|f| self.area(f)).sum()
    }

    /// Smallest and largest coordinates.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        self.vertices
            .iter()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(lo, hi), &v| (lo.min(v), hi.max(v)))
    }

    /// The convex hull of the corners seen from above, counter-clockwise: what extents are measured on. They
    /// change with the corners' roundings by no more than these.
    pub fn hull(&self) -> Vec<DVec2> {
        convex_hull(self.vertices.iter().map(|v| v.truncate()).collect())
    }

    /// The outline seen from above: [`Polyhedron::hull`] by its edges, for what asks where these are and
    /// which way they run.
    ///
    /// They are longer than a hundred-thousandth of its extent: the upper and lower end of a girdle
    /// edge differ by rounding, and an edge from one to the other would have any direction at all.
    pub fn outline(&self) -> Vec<DVec2> {
        const SHORTEST: f64 = 1e-5;
        let hull = self.hull();
        let (low, high) = self.bounds();
        let near = SHORTEST * (high - low).truncate().max_element();
        let mut corners: Vec<DVec2> = Vec::with_capacity(hull.len());
        for corner in hull {
            if corners.last().is_none_or(|last| last.distance(corner) > near) {
                corners.push(corner);
            }
        }
        while corners.len() > 1 && corners[0].distance(corners[corners.len() - 1]) <= near {
            corners.pop();
        }
        corners
    }

    /// Girdle width: the least distance between two parallel lines that hold the outline. For a
    /// round stone the diameter measured flat to flat, for an oval its short axis.
    pub fn width(&self) -> f64 {
        calipers(&self.hull()).0
    }

    /// Girdle length: the extent of the outline across its width.
    pub fn length(&self) -> f64 {
        calipers(&self.hull()).1
    }

    /// A sphere that holds the stone: centre of the box, and the farthest corner's distance.
    pub fn bounding_sphere(&self) -> (DVec3, f64) {
        let (lo, hi) = self.bounds();
        let centre = (lo + hi) * 0.5;
        (centre, self.vertices.iter().map(|v| v.distance(centre)).fold(0.0, f64::max))
    }
}

/// Middle of a polygon by area.
pub fn centroid(p: &[DVec2]) -> DVec2 {
    let Some(&first) = p.first() else { return DVec2::ZERO };
    let (mut sum, mut area) = (DVec2::ZERO, 0.0);
    for pair in p.windows(2) {
        let (a, b) = (pair[0] - first, pair[1] - first);
        let twice = a.perp_dot(b);
        sum += (a + b) * twice;
        area += 3.0 * twice;
    }
    if area == 0.0 { first } else { first + sum / area }
}

/// Area of a polygon given counter-clockwise.
pub fn polygon_area(p: &[DVec2]) -> f64 {
    (0..p.len()).map(|i| p[i].perp_dot(p[(i + 1) % p.len()])).sum::<f64>() * 0.5
}

/// Convex hull of points, counter-clockwise, by Andrew's monotone chain.
pub fn convex_hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let half = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut hull: Vec<DVec2> = Vec::new();
        for p in points {
            while hull.len() > 1
                && (hull[hull.len() - 1] - hull[hull.len() - 2]).perp_dot(p - hull[hull.len() - 1]) <= 0.0
            {
                hull.pop();
            }
            hull.push(p);
        }
        hull.pop();
        hull
    };
    let mut hull = half(&mut points.iter().copied());
    hull.extend(half(&mut points.iter().rev().copied()));
    hull
}

/// Directions across which the hull has its least width, or more than that by at most the part `slack`:
/// one for an oval, two for a square, many for a polygon that stands for a circle.
pub fn width_directions(hull: &[DVec2], slack: f64) -> Vec<DVec2> {
    let most = calipers(hull).0 * (1.0 + slack);
    let across = |i: usize| (hull[(i + 1) % hull.len()] - hull[i]).perp().try_normalize();
    let extent = |d: &DVec2| {
        let reach = |sign: f64| hull.iter().map(|p| sign * p.dot(*d)).fold(f64::NEG_INFINITY, f64::max);
        reach(1.0) + reach(-1.0)
    };
    (0..hull.len()).filter_map(across).filter(|d| extent(d) <= most).collect()
}

/// Least width over all directions, and the extent across it: of several directions of the least width the
/// greatest. The least width has one side of the hull flush with a caliper.
///
/// Both follow the corners without a jump: an edge that rounding makes between two corners that are one has
/// some direction, and no direction has less than the least width.
pub fn calipers(hull: &[DVec2]) -> (f64, f64) {
    /// Widths that differ by less than this part are one. Directions whose widths do are so near, or the shape
    /// so regular, that the extents across them are one too.
    const ONE_WIDTH: f64 = 1e-9;
    let extent = |d: DVec2| {
        let (lo, hi) = hull
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), p| (lo.min(p.dot(d)), hi.max(p.dot(d))));
        hi - lo
    };
    let along = (0..hull.len()).filter_map(|i| (hull[(i + 1) % hull.len()] - hull[i]).try_normalize());
    let sizes: Vec<(f64, f64)> = along.map(|along| (extent(along.perp()), extent(along))).collect();
    let Some(least) = sizes.iter().map(|s| s.0).reduce(f64::min) else { return (0.0, 0.0) };
    let across = sizes.iter().filter(|s| s.0 <= least * (1.0 + ONE_WIDTH)).map(|s| s.1);
    (least, across.fold(0.0, f64::max))
}
