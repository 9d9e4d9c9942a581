//! The meet network in words and figures: which tiers meet where, what is free, and what holds outline, girdle,
//! table and culet.

use super::editor::Editor;
use super::flat_size::Size;
use super::setting::{EditTarget, Keep, Setting};
use super::tier_list::EditableTier;
use crate::design::meet_network::Corner;
use crate::design::tiers::Zone;
use serde::Serialize;

/// What decides how deep a tier is cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum DepthRule {
    /// A meet, or the girdle.
    Meets,
    /// Nothing: a cutter may choose.
    Free,
    /// It is the outline.
    Outline,
}

/// What becomes of other tiers when a tier's angle changes by a little.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum AngleRule {
    /// They follow by distance alone.
    Free,
    /// Their angles follow, or the change is impossible.
    Bound,
    /// The angle says what the facet is: table, culet, girdle.
    Fixed,
}

/// A tier in the network.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TierMeets {
    /// Its place: `P1`, `C2`, `G1`.
    pub place: String,
    /// Its name; empty if it has none.
    pub name: String,
    /// Where its facets are.
    pub zone: &'static str,
    /// Angle from the girdle plane in degrees, without sign.
    pub angle_deg: f64,
    /// Number of its facets.
    pub facets: usize,
    /// What decides its depth.
    pub depth: DepthRule,
    /// Whether its angle can change alone.
    pub angle: AngleRule,
}

/// Facets of a tier in a corner.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MetTier {
    /// The tier's name, else its place.
    pub tier: String,
    /// How many of its facets meet there.
    pub facets: usize,
}

/// Corners in which more than three facets meet, alike in tiers, height and distance from the axis.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Meet {
    /// What meets there, in cutting order.
    pub tiers: Vec<MetTier>,
    /// How many such corners there are.
    pub corners: usize,
    /// Height above the lowest point, in percent of the width.
    pub height_percent: f64,
    /// Distance from the axis, in percent of the width.
    pub radius_percent: f64,
}

/// The meet network of a design.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct MeetReport {
    /// The tiers, in cutting order.
    pub tiers: Vec<TierMeets>,
    /// The meets, the lowest first.
    pub meets: Vec<Meet>,
    /// What holds the outline when something changes.
    pub outline: String,
    /// What holds the girdle.
    pub girdle: String,
    /// What holds the table.
    pub table: String,
    /// What holds the culet.
    pub culet: String,
}

/// Heights and distances from the axis, in percent of the width, that are one.
const ALIKE: f64 = 0.01;

/// Degrees by which an angle is tried.
const TRIED: f64 = 0.1;

impl MeetReport {
    /// The network of an editor's design.
    pub fn new(editor: &Editor) -> MeetReport {
        let free = editor.network.free_parts();
        let tier = |tier: &EditableTier| TierMeets {
            place: tier.place.clone(),
            name: tier.name.clone(),
            zone: tier.zone.name(),
            angle_deg: editor.angle_deg(tier),
            facets: tier.facets.len(),
            depth: match tier.zone {
                Zone::Girdle => DepthRule::Outline,
                _ if tier.parts.iter().any(|p| free.contains(p)) => DepthRule::Free,
                _ => DepthRule::Meets,
            },
            angle: angle_rule(editor, tier),
        };
        let [outline, girdle] = held(editor);
        MeetReport {
            tiers: editor.tiers.tiers.iter().map(tier).collect(),
            meets: meets(editor),
            outline,
            girdle,
            table: flat(editor, Zone::Table, &free),
            culet: flat(editor, Zone::Culet, &free),
        }
    }
}

fn angle_rule(editor: &Editor, tier: &EditableTier) -> AngleRule {
    if !matches!(tier.zone, Zone::Crown | Zone::Pavilion) {
        return AngleRule::Fixed;
    }
    // the tier by its place, which is its own
    let turned =
        |value: f64| Setting { target: EditTarget::Angle(tier.place.clone()), is_added: true, value };
    let goes = |value: f64| editor.edit(&[turned(value)], Keep::Angles).is_ok();
    if goes(TRIED) && goes(-TRIED) { AngleRule::Free } else { AngleRule::Bound }
}

/// The tiers of a corner's facets, in cutting order.
fn met_tiers(editor: &Editor, corner: &Corner) -> Vec<MetTier> {
    let count = |tier: &EditableTier| corner.facets.iter().filter(|f| tier.facets.contains(f)).count();
    let met = editor.tiers.tiers.iter().map(|t| MetTier { tier: t.label().into(), facets: count(t) });
    met.filter(|m| m.facets > 0).collect()
}

/// Height above the lowest point, and distance from the axis, in percent of the width.
fn place(editor: &Editor, corner: &Corner) -> (f64, f64) {
    let lowest = editor.solid.bounds().0.z;
    let at = editor.network.position(corner);
    let middle = editor.network.middle();
    let percent = |x: f64| 100.0 * x / editor.network.width;
    (percent(at.z - lowest), percent((at - middle).truncate().length()))
}

fn meets(editor: &Editor) -> Vec<Meet> {
    let mut meets: Vec<Meet> = Vec::new();
    for corner in editor.network.corners.iter().filter(|c| c.facets.len() > 3) {
        let tiers = met_tiers(editor, corner);
        let (height_percent, radius_percent) = place(editor, corner);
        let near = |a: f64, b: f64| (a - b).abs() < ALIKE;
        let same = |m: &&mut Meet| {
            near(m.height_percent, height_percent)
                && near(m.radius_percent, radius_percent)
                && m.tiers == tiers
        };
        match meets.iter_mut().find(same) {
            Some(known) => known.corners += 1,
            None => meets.push(Meet { tiers, corners: 1, height_percent, radius_percent }),
        }
    }
    meets.sort_by(|a, b| {
        let near = (a.height_percent - b.height_percent).abs() < ALIKE;
        let by_height = a.height_percent.total_cmp(&b.height_percent);
        let by_radius = a.radius_percent.total_cmp(&b.radius_percent);
        if near { by_radius } else { by_height }
    });
    meets
}

/// `P1 ×2, G1 ×2`
pub fn listed(tiers: &[MetTier]) -> String {
    let one = |t: &MetTier| match t.facets {
        1 => t.tier.clone(),
        n => format!("{} ×{n}", t.tier),
    };
    tiers.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// What holds the outline, and what the girdle.
fn held(editor: &Editor) -> [String; 2] {
    let of_zone = |zone: Zone| {
        let tiers = editor.tiers.tiers.iter().filter(|t| t.zone == zone);
        let mut names: Vec<&str> = tiers.map(EditableTier::label).collect();
        names.dedup();
        names.join(", ")
    };
    let at = |corner: &Corner| listed(&met_tiers(editor, corner));
    let thick = Size::Girdle.percent(&editor.solid).unwrap_or_default();
    match (editor.network.girdle_corners(), editor.network.outline_corner()) {
        (Some([top, bottom]), _) => [
            format!("{} stays where it is", of_zone(Zone::Girdle)),
            format!("{thick:.2} % thick, between the corners of {} and of {}", at(top), at(bottom)),
        ],
        (None, Some(corner)) => [
            format!("the corner of {} stays where it is: the farthest from the axis", at(corner)),
            "no girdle facets between crown and pavilion".into(),
        ],
        (None, None) => ["nothing".into(), "no girdle facets".into()],
    }
}

/// What holds the table or the culet.
fn flat(editor: &Editor, zone: Zone, free: &[usize]) -> String {
    let size = if zone == Zone::Table { Size::Table } else { Size::Culet };
    let Some(tier) = editor.tiers.tiers.iter().find(|t| t.zone == zone) else {
        return match zone {
            Zone::Culet => lowest(editor),
            _ => "none".into(),
        };
    };
    let percent = size.percent(&editor.solid).unwrap_or_default();
    let is_free = tier.parts.iter().any(|p| free.contains(p));
    let how = if is_free { "free: it keeps its size" } else { "set by the meets" };
    format!("{}, {percent:.2} %, {how}", tier.label())
}

/// The stone's lowest corner, where it has no culet.
fn lowest(editor: &Editor) -> String {
    let height = |c: &&Corner| place(editor, c).0;
    let corner = editor.network.corners.iter().min_by(|a, b| height(a).total_cmp(&height(b)));
    corner.map_or("none".into(), |c| format!("none: a point of {}", listed(&met_tiers(editor, c))))
}
