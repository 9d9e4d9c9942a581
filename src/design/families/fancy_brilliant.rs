//! The brilliant over any outline: what oval, cushion, marquise and pear have in common.
//!
//! Eight mains touch the outline and run to the culet; the table is the outline's own shape made
//! smaller about the axis. Every facet of the round brilliant has its counterpart, so that a round
//! outline gives the round brilliant again, and an ellipse its affine image (`tests/library/fancy.rs`).

use super::{CutError, Parameter, ParameterValues, check_every_facet_stands, whole_number};
use crate::design::tiers::{Design, Facet, Gear, LengthUnit, Tier};
use crate::geometry::Plane;
use glam::{DVec2, DVec3};

/// A closed convex outline: the point and the outward normal at u in 0..1, counter-clockwise, of a
/// stone of width 2 (x in −1..1, except for the pear's tip all of it about the axis).
pub struct GirdleOutline {
    /// The mains touch at u = i/8.
    pub point: Box<dyn Fn(f64) -> (DVec2, DVec2)>,
    /// Girdle flats stand at u = (k + `first_flat`)/n: ½ where u = 0 is a point, which no flat can
    /// touch along an edge.
    pub first_flat: f64,
    /// Number of mirror planes through the axis.
    pub symmetry: u32,
}

/// The parameters of a fancy brilliant with that length to width.
pub const fn parameters(length_to_width: f64, longest: f64, pavilion: f64, girdle: f64) -> [Parameter; 10] {
    const fn p(
        key: &'static str,
        default: f64,
        range: (f64, f64),
        unit: &'static str,
        about: &'static str,
    ) -> Parameter {
        Parameter { key, default, range, unit, about }
    }
    [
        p("length-to-width", length_to_width, (1.0, longest), "", "length of the outline over its width"),
        p("table", 56.0, (20.0, 90.0), "%", "table along the width"),
        p("crown-angle", 35.0, (5.0, 70.0), "°", "angle of the crown mains across the width"),
        p("pavilion-angle", pavilion, (5.0, 80.0), "°", "angle of the pavilion mains across the width"),
        p("star", 50.0, (1.0, 99.0), "%", "star length, from table edge to girdle in plan"),
        p("lower-half", 75.0, (1.0, 99.0), "%", "lower half length, from girdle to culet in plan"),
        p("girdle", girdle, (0.0, 50.0), "%", "girdle thickness at its thick places"),
        p("culet", 0.0, (0.0, 30.0), "%", "culet along the width; 0 is a sharp point"),
        p("girdle-facets", 64.0, (16.0, 960.0), "", "number of girdle flats, a multiple of 16"),
        p("size", 6.5, (1e-3, 1e3), " mm", "girdle width"),
    ]
}

/// Builds the brilliant over `outline`.
pub fn build(v: &ParameterValues, name: &str, outline: &GirdleOutline) -> Result<Design, CutError> {
    let radius = v.get("size") / 2.0;
    let [table, star, lower, girdle] = ["table", "star", "lower-half", "girdle"].map(|k| v.get(k) / 100.0);
    let flats = whole_number("girdle-facets", v.get("girdle-facets"))?;
    if flats % 16 != 0 {
        return Err(CutError::Impossible {
            problem: "girdle flats must pair with the halves",
            bound: format!("girdle-facets = {flats} is not a multiple of 16"),
        });
    }
    let (rise, fall) = (v.get("crown-angle").to_radians().tan(), v.get("pavilion-angle").to_radians().tan());
    let table_height = girdle + (1.0 - table) * rise;
    let mains: Vec<(DVec2, DVec2)> = (0..8).map(|i| (outline.point)(i as f64 / 8.0)).collect();
    let mut cut = Pieces::default();
    for i in 0..8 {
        let (p, n) = mains[i];
        let (p_next, n_next) = mains[(i + 1) % 8];
        // where the tangents of neighbouring mains cross, and the outline on the way there
        let cross = crossing(p, n, p_next, n_next);
        let q = on_ray(outline, i, cross);
        let edge = cross * (table * table_reach(p, p_next, cross));
        let star_point = edge + (q - edge) * star;
        let down = star_point.length() / cross.length();
        let star_point = star_point.extend(girdle + (1.0 - down) / (1.0 - table) * (table_height - girdle));
        let lower_point = q * (1.0 - lower);
        let lower_point = lower_point.extend(-girdle - fall * (1.0 - lower_point.length() / cross.length()));

        cut.push(
            "pavilion main",
            [p.extend(-girdle), (p + n.perp()).extend(-girdle), DVec3::Z * (-girdle - fall)],
        );
        cut.push("lower half", [p.extend(-girdle), q.extend(-girdle), lower_point]);
        cut.push("lower half", [q.extend(-girdle), p_next.extend(-girdle), lower_point]);
        cut.push("upper half", [p.extend(girdle), q.extend(girdle), star_point]);
        cut.push("upper half", [q.extend(girdle), p_next.extend(girdle), star_point]);
        let inner = p * table;
        cut.push("crown main", [p.extend(girdle), (p + n.perp()).extend(girdle), inner.extend(table_height)]);
        cut.push("star", [inner.extend(table_height), (p_next * table).extend(table_height), star_point]);
    }
    for k in 0..flats {
        let (p, n) = (outline.point)((k as f64 + outline.first_flat) / flats as f64);
        cut.pieces.push(("girdle", Plane::new(n.extend(0.0), p.dot(n.normalize()))));
    }
    let culet = v.get("culet") / 100.0;
    if culet > 0.0 {
        cut.pieces.push(("culet", Plane { normal: -DVec3::Z, distance: girdle + (1.0 - culet) * fall }));
    }
    cut.pieces.push(("table", Plane { normal: DVec3::Z, distance: table_height }));

    let mut design = Design::new(name);
    design.symmetry = Some((outline.symmetry, true));
    design.unit = LengthUnit::Millimetre;
    for tier in
        ["pavilion main", "lower half", "culet", "girdle", "table", "upper half", "crown main", "star"]
    {
        let planes = cut.pieces.iter().filter(|(t, _)| *t == tier).map(|(_, p)| p.scaled(radius));
        design.tiers.extend(tiers_of(tier, design.gear, planes.collect()));
    }
    check_every_facet_stands(&design)?;
    Ok(design)
}

/// Facets as they are found, by tier.
#[derive(Default)]
struct Pieces {
    pieces: Vec<(&'static str, Plane)>,
}

impl Pieces {
    /// The plane through three points, facing away from the middle of the stone.
    fn push(&mut self, tier: &'static str, [a, b, c]: [DVec3; 3]) {
        let mut normal = (b - a).cross(c - a).normalize_or(DVec3::Z);
        if normal.dot(a) < 0.0 {
            normal = -normal;
        }
        self.pieces.push((tier, Plane { normal, distance: normal.dot(a) }));
    }
}

/// Tiers of facets of one angle and distance each, indices read off the planes. Facets are
/// `name 1`, `name 2` … through all tiers of that name.
pub fn tiers_of(name: &str, gear: Gear, planes: Vec<Plane>) -> Vec<Tier> {
    let mut tiers: Vec<Tier> = Vec::new();
    let single = planes.len() == 1;
    for (i, plane) in planes.into_iter().enumerate() {
        let across = plane.normal.truncate();
        let angle = across.length().atan2(plane.normal.z.abs()).to_degrees();
        let angle = if plane.normal.z < 0.0 { -angle } else { angle };
        let level = across.length() < 1e-12;
        let turns = if level { 0.0 } else { across.x.atan2(-across.y) / std::f64::consts::TAU };
        let teeth = gear.teeth.abs();
        let index = (turns * gear.teeth + gear.offset).rem_euclid(teeth);
        let index = if (index - index.round()).abs() < 1e-9 { index.round() % teeth } else { index };
        let facet = Facet {
            name: if single { name.into() } else { format!("{name} {}", i + 1) },
            index: Some(index),
            plane,
        };
        let alike = |t: &Tier| {
            let near = |a: f64, b: f64, scale: f64| (a - b).abs() < 1e-9 * scale;
            t.angle_deg.is_some_and(|a| near(a, angle, 90.0))
                && t.facets
                    .first()
                    .is_some_and(|f| near(f.plane.distance, plane.distance, plane.distance.abs()))
        };
        match tiers.iter_mut().find(|t| alike(t)) {
            Some(tier) => tier.facets.push(facet),
            None => tiers.push(Tier {
                name: name.into(),
                angle_deg: Some(angle),
                instructions: String::new(),
                facets: vec![facet],
            }),
        }
    }
    tiers
}

/// Where the tangents at `p` and `q` with normals `m` and `n` cross.
fn crossing(p: DVec2, m: DVec2, q: DVec2, n: DVec2) -> DVec2 {
    let (a, b, det) = (p.dot(m), q.dot(n), m.perp_dot(n));
    DVec2::new(a * n.y - b * m.y, b * m.x - a * n.x) / det
}

/// The outline's point between mains `i` and `i + 1` on the ray from the axis toward `toward`.
fn on_ray(outline: &GirdleOutline, i: usize, toward: DVec2) -> DVec2 {
    let at = |u: f64| (outline.point)((i as f64 + u) / 8.0).0;
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if at(middle).perp_dot(toward) > 0.0 { low = middle } else { high = middle }
    }
    at(0.5 * (low + high))
}

/// Where the ray to `cross` passes the chord from `p` to `q`, as a part of the ray.
fn table_reach(p: DVec2, q: DVec2, cross: DVec2) -> f64 {
    let chord = q - p;
    p.perp_dot(chord) / cross.perp_dot(chord)
}
