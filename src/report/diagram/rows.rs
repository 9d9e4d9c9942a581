//! The tiers as a cutter reads them: a short name for the drawings, angle, indices, what to do.

use super::wheel::index_name;
use crate::design::edit;
use crate::design::proportions::SLIVER;
use crate::design::tiers::same_cutting_row;
use crate::design::{Design, Gear, Tier, Zone};
use crate::geometry::Polyhedron;
use crate::geometry::polyhedron::PlaneStatus;
use glam::DVec3;
use std::f64::consts::TAU;

/// One line of the table of tiers.
#[derive(Debug, Clone)]
pub struct DiagramRow {
    /// What stands in the drawings: P1, G1, C2, T, or the design's own name if it is short.
    pub code: String,
    /// Its place in its part of the stone, by which `cutlab edit` finds it: P1, C2.
    pub place: String,
    /// Where its facets are, as its first one lies.
    pub zone: Zone,
    /// Angle from the girdle plane in degrees, 0 to 90.
    pub angle_deg: f64,
    /// Indices on the wheel, from 0 up.
    pub indices: Vec<f64>,
    /// How many facets are cut.
    pub count: usize,
    /// Faces of the solid that are left of them.
    pub faces: Vec<usize>,
    /// Whether some index lies between teeth, so that the machine's cheater is needed.
    pub cheater: bool,
    /// The tier's own name where the code is not it, instructions, what needs care.
    pub notes: String,
}

/// Longest name, in letters, that stands in the drawings as it is.
const SHORT: usize = 3;

/// More indices than this in equal steps are written as a range.
pub const LISTED: usize = 32;

/// A facet as the rows need it: its number in the design's order, its unit normal and distance.
struct RowFacet<'a> {
    number: usize,
    name: &'a str,
    index: Option<f64>,
    normal: DVec3,
    distance: f64,
}

/// The rows of a design, in cutting order. Tiers of a mesh, which has neither angles nor indices,
/// are made up of facets of one angle and distance, pavilion first, and their indices measured on
/// the wheel.
pub fn rows(design: &Design, solid: &Polyhedron) -> Vec<DiagramRow> {
    let mut rows = Vec::new();
    let mut number = 0;
    let mut places = edit::places_of_tiers(design).into_iter();
    let alike = |a: &Tier, b: &Tier| same_cutting_row((&a.name, a.angle_deg), (&b.name, b.angle_deg));
    for tiers in design.tiers.chunk_by(alike) {
        let mut cuts: Vec<RowFacet> = Vec::new();
        for facet in tiers.iter().flat_map(|t| &t.facets) {
            let (normal, distance) = (facet.plane.normal, facet.plane.distance);
            cuts.push(RowFacet { number, name: &facet.name, index: facet.index, normal, distance });
            number += 1;
        }
        let place = places.next().unwrap_or_default();
        tiers[1..].iter().for_each(|_| drop(places.next()));
        match tiers[0].angle_deg {
            Some(angle) => {
                let row = row(design, solid, tiers, angle.abs(), &cuts);
                rows.extend(row.map(|row| DiagramRow { place, ..row }));
            }
            None => rows.extend(measured(design, solid, tiers, cuts)),
        }
    }
    if is_measured(design) {
        let place = |zone| match zone {
            Zone::Pavilion | Zone::Culet => 0,
            Zone::Girdle => 1,
            Zone::Crown | Zone::Table => 2,
        };
        rows.sort_by(|a, b| place(a.zone).cmp(&place(b.zone)).then(b.angle_deg.total_cmp(&a.angle_deg)));
        let zones: Vec<(Zone, &str)> = rows.iter().map(|row| (row.zone, "")).collect();
        let places = edit::places(&zones);
        rows.iter_mut().zip(places).for_each(|(row, place)| row.place = place);
    }
    name(&mut rows);
    rows
}

/// Whether the design is a mesh's, so that angles and indices are measured.
pub fn is_measured(design: &Design) -> bool {
    design.tiers.iter().all(|t| t.angle_deg.is_none())
}

fn tilt_deg(n: DVec3) -> f64 {
    n.truncate().length().atan2(n.z.abs()).to_degrees()
}

/// Facets of one angle (within 0.02°) and distance (within a part in a thousand) as rows.
fn measured(design: &Design, solid: &Polyhedron, tiers: &[Tier], mut cuts: Vec<RowFacet>) -> Vec<DiagramRow> {
    let middle = solid.volume_and_centre().1;
    let height = |c: &RowFacet| c.distance - c.normal.dot(middle);
    let size = solid.bounding_sphere().1;
    let alike = |a: &RowFacet, b: &RowFacet| {
        (tilt_deg(a.normal) - tilt_deg(b.normal)).abs() < 0.02 && (height(a) - height(b)).abs() < 1e-3 * size
    };
    let mut rows = Vec::new();
    while let Some(first) = cuts.pop() {
        let (mut same, rest): (Vec<RowFacet>, Vec<RowFacet>) =
            cuts.into_iter().partition(|c| alike(c, &first));
        cuts = rest;
        same.push(first);
        let angle = same.iter().map(|c| tilt_deg(c.normal)).sum::<f64>() / same.len() as f64;
        rows.extend(row(design, solid, tiers, angle, &same));
    }
    rows
}

fn row(
    design: &Design,
    solid: &Polyhedron,
    tiers: &[Tier],
    angle_deg: f64,
    cuts: &[RowFacet],
) -> Option<DiagramRow> {
    let gear = design.gear;
    let turns = |n: DVec3| n.x.atan2(-n.y) / TAU;
    let level = angle_deg < 0.005;
    let index = |c: &RowFacet| c.index.unwrap_or(gear.offset + gear.teeth * turns(c.normal));
    let mut indices: Vec<f64> = cuts.iter().map(|c| on_wheel(index(c), gear)).collect();
    indices.sort_by(f64::total_cmp);
    let mut faces: Vec<usize> = Vec::new();
    let mut left = 0;
    let sliver = SLIVER * solid.width().powi(2);
    for fate in cuts.iter().filter_map(|c| solid.plane_status.get(c.number)) {
        match fate {
            PlaneStatus::Facet(face) if solid.area(*face) <= sliver => continue,
            PlaneStatus::Facet(face) => faces.push(*face),
            PlaneStatus::Duplicate(_) => (),
            PlaneStatus::Redundant => continue,
        }
        left += 1;
    }
    let own = [tiers[0].name.trim(), cuts.first()?.name.trim()];
    // the names in a mesh are of no use to a cutter
    let own = own.into_iter().find(|name| !name.is_empty() && tiers[0].angle_deg.is_some());
    let mut notes: Vec<String> = Vec::new();
    for said in tiers.iter().map(|t| t.instructions.trim()).filter(|said| !said.is_empty()) {
        if !notes.iter().any(|n| n == said) {
            notes.push(said.into());
        }
    }
    let between = |i: &f64| (i - i.round()).abs() > 0.005;
    let cheater = !level && tiers[0].angle_deg.is_some() && indices.iter().any(between);
    if cheater {
        notes.push("cheater".into());
    }
    if left < cuts.len() {
        let some =
            if left == 0 { String::new() } else { format!("{} of {} ", cuts.len() - left, cuts.len()) };
        notes.push(format!("{some}cut away later"));
    }
    Some(DiagramRow {
        code: own.unwrap_or_default().into(), // until `name` has seen them all
        place: String::new(),
        zone: Zone::from_normal(cuts.first()?.normal),
        angle_deg,
        indices: if level { Vec::new() } else { indices },
        count: cuts.len(),
        faces,
        cheater,
        notes: notes.join("; "),
    })
}

/// An index from 0 up to the number of teeth; one a rounding below the last tooth is the first.
fn on_wheel(index: f64, gear: Gear) -> f64 {
    let teeth = gear.teeth.abs();
    let index = index.rem_euclid(teeth);
    if teeth - index < 0.005 { 0.0 } else { index }
}

/// Gives every row whose name is long or missing its place for a code; the only table is T, the only culet K.
fn name(rows: &mut [DiagramRow]) {
    let short =
        |name: &str| (1..=SHORT).contains(&name.chars().count()) && !name.contains(char::is_whitespace);
    let is_alone = |zone: Zone| rows.iter().filter(|r| r.zone == zone).count() == 1;
    let alone = [(Zone::Table, "T"), (Zone::Culet, "K")].map(|(zone, letter)| {
        let is_free = !rows.iter().any(|r| r.code == letter);
        (is_alone(zone) && is_free).then_some((zone, letter))
    });
    for row in rows.iter_mut().filter(|r| !short(&r.code)) {
        let letter = alone.iter().flatten().find(|(zone, _)| *zone == row.zone);
        let code = letter.map_or_else(|| row.place.clone(), |(_, letter)| letter.to_string());
        let said = std::mem::replace(&mut row.code, code);
        let parts = [said, std::mem::take(&mut row.notes)];
        row.notes = parts.into_iter().filter(|p| !p.is_empty()).collect::<Vec<_>>().join(": ");
    }
}

impl DiagramRow {
    /// The indices as text: a list with hyphens, or a range if there are many in equal steps.
    pub fn index_text(&self, gear: Gear) -> String {
        let named = |i: &f64| index_name(*i, gear);
        let n = self.indices.len();
        if n == 0 {
            return "–".into();
        }
        let step = gear.teeth.abs() / n as f64;
        let even = self.indices.windows(2).all(|w| (w[1] - w[0] - step).abs() < 0.005);
        if n <= LISTED || !even {
            return self.indices.iter().map(named).collect::<Vec<_>>().join("-");
        }
        // the tooth at 0 is the last
        let from = self.indices.iter().find(|i| **i >= 0.005).map(named).unwrap_or_default();
        let to = if self.indices[0] < 0.005 { named(&0.0) } else { named(&self.indices[n - 1]) };
        if (step - 1.0).abs() < 0.005 {
            return format!("{from} to {to}, every tooth");
        }
        format!(
            "{from} to {to}, every {} teeth",
            format!("{step:.2}").trim_end_matches('0').trim_end_matches('.')
        )
    }
}
