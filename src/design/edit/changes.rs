//! What a change did to a design: tiers and proportions before and after, as tables and other programs show them.

use super::editor::{Edited, Editor};
use super::tier_list::{EditableTier, TierList};
use crate::design::meet_network::MeetNetwork;
use crate::design::proportion_catalogue::{NamedProportion, PROPORTIONS};
use crate::design::proportions;
use crate::design::tiers::Design;
use crate::geometry::{Plane, Polyhedron};
use serde::Serialize;

/// A value before and after a change.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BeforeAfter<T> {
    /// As it was.
    pub before: T,
    /// As it is.
    pub after: T,
}

/// A tier's setting: what its facets have in common.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TierState {
    /// Angle from the girdle plane in degrees, without sign.
    pub angle_deg: f64,
    /// Least distance of its facets from the middle, in percent of the width.
    pub depth_percent: f64,
    /// Greatest of these distances: of a fancy girdle they differ.
    pub most_depth_percent: f64,
    /// Number of its facets.
    pub facets: usize,
}

/// A tier before and after a change.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TierChange {
    /// Its place: `P1`, `C2`, `G1`.
    pub place: String,
    /// Its name; empty if it has none.
    pub name: String,
    /// Where its facets are.
    pub zone: &'static str,
    /// None before of a tier that is new, and after of one that is gone.
    #[serde(flatten)]
    pub state: BeforeAfter<Option<TierState>>,
    /// Teeth by which it was turned about the axis.
    pub index_shift: f64,
    /// Whether its angle changed though no setting asked for it, so that what met still meets.
    pub followed: bool,
}

/// A proportion before and after a change; none where the stone has no such measure.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MeasureChange {
    /// Its name ([`NamedProportion::short`]).
    pub name: &'static str,
    /// Its unit; empty for a ratio.
    pub unit: &'static str,
    /// The values.
    #[serde(flatten)]
    pub value: BeforeAfter<Option<f64>>,
}

/// What a change did to a design.
#[derive(Debug, Clone, Serialize)]
pub struct DesignChanges {
    /// The tiers in cutting order. A tier whose facets no longer have one angle stands several times.
    pub tiers: Vec<TierChange>,
    /// The proportions.
    pub measures: Vec<MeasureChange>,
    /// Whether the outline changed though no setting asked for it.
    pub is_outline_changed: bool,
}

/// Angles and distances (in percent) that differ by less are shown as the same.
const SAME: f64 = 5e-7;

impl<T> BeforeAfter<T> {
    /// Of two values.
    pub fn new(before: T, after: T) -> BeforeAfter<T> {
        BeforeAfter { before, after }
    }
}

impl TierChange {
    /// What it is called: its name, else its place.
    pub fn label(&self) -> &str {
        if self.name.is_empty() { &self.place } else { &self.name }
    }

    /// Whether anything about it changed.
    pub fn is_changed(&self) -> bool {
        match (self.state.before, self.state.after) {
            (Some(was), Some(is)) => was.differs(&is) || self.index_shift != 0.0,
            _ => true,
        }
    }
}

impl TierState {
    fn of(planes: &[Plane], facets: &[usize], network: &MeetNetwork, width: f64) -> Option<TierState> {
        let depth = |f: &usize| 100.0 * network.distance_from_middle(&planes[*f]) / width;
        Some(TierState {
            angle_deg: angle_deg(&planes[*facets.first()?]),
            depth_percent: facets.iter().map(depth).reduce(f64::min)?,
            most_depth_percent: facets.iter().map(depth).reduce(f64::max)?,
            facets: facets.len(),
        })
    }

    fn differs(&self, other: &TierState) -> bool {
        let far = |a: f64, b: f64| (a - b).abs() > SAME;
        far(self.angle_deg, other.angle_deg)
            || far(self.depth_percent, other.depth_percent)
            || far(self.most_depth_percent, other.most_depth_percent)
            || self.facets != other.facets
    }
}

impl MeasureChange {
    /// Whether it changed.
    pub fn is_changed(&self) -> bool {
        match (self.value.before, self.value.after) {
            (Some(was), Some(is)) => (was - is).abs() > SAME,
            (was, is) => was.is_some() != is.is_some(),
        }
    }
}

impl DesignChanges {
    /// What became of the editor's design.
    pub fn new(editor: &Editor, edited: &Edited) -> DesignChanges {
        DesignChanges {
            tiers: tiers(editor, edited),
            measures: measures(&editor.solid, &edited.solid),
            is_outline_changed: edited.is_outline_changed,
        }
    }

    /// Whether nothing changed.
    pub fn is_empty(&self) -> bool {
        !self.tiers.iter().any(TierChange::is_changed) && !self.measures.iter().any(MeasureChange::is_changed)
    }

    /// The tiers whose angles followed, by name.
    pub fn followed(&self) -> Vec<&str> {
        let mut names: Vec<&str> = self.tiers.iter().filter(|t| t.followed).map(TierChange::label).collect();
        names.dedup();
        names
    }
}

fn angle_deg(plane: &Plane) -> f64 {
    plane.normal.truncate().length().atan2(plane.normal.z.abs()).to_degrees()
}

fn tiers(editor: &Editor, edited: &Edited) -> Vec<TierChange> {
    let (before, after) = (editor.design.planes(), edited.design.planes());
    let widths = (editor.network.width, edited.solid.width());
    if !has_same_facets(&editor.design, &edited.design) {
        return rebuilt(editor, edited, widths);
    }
    let state =
        |planes: &[Plane], facets: &[usize], width| TierState::of(planes, facets, &editor.network, width);
    let indices = |design: &Design| design.facets().map(|f| f.index).collect::<Vec<_>>();
    let (index_before, index_after) = (indices(&editor.design), indices(&edited.design));
    let teeth = editor.design.gear.teeth.abs();
    let shift = |facet: usize| match (index_before[facet], index_after[facet]) {
        (Some(was), Some(is)) => nearest_turn(is - was, teeth),
        _ => 0.0,
    };
    let mut rows = Vec::new();
    for tier in &editor.tiers.tiers {
        let mut pieces: Vec<(f64, Vec<usize>)> = Vec::new();
        for &facet in &tier.facets {
            let angle = angle_deg(&after[facet]);
            match pieces.iter_mut().find(|(of, _)| (of - angle).abs() < 2e-3) {
                Some((_, piece)) => piece.push(facet),
                None => pieces.push((angle, vec![facet])),
            }
        }
        let followed = edited.followed.iter().any(|name| name == tier.label());
        rows.extend(pieces.iter().map(|(_, facets)| TierChange {
            state: BeforeAfter::new(state(&before, facets, widths.0), state(&after, facets, widths.1)),
            index_shift: shift(facets[0]),
            followed,
            ..named(tier)
        }));
    }
    rows
}

/// The tiers of a family that was built anew with other facets: each with the one of its name.
fn rebuilt(editor: &Editor, edited: &Edited, (was, is): (f64, f64)) -> Vec<TierChange> {
    let network = MeetNetwork::recover(&edited.design, &edited.solid);
    let new = TierList::of_design(&edited.design, &network).tiers;
    let (before, after) = (editor.design.planes(), edited.design.planes());
    let state_before = |t: &EditableTier| TierState::of(&before, &t.facets, &editor.network, was);
    let state_after = |t: &EditableTier| TierState::of(&after, &t.facets, &network, is);
    let same = |a: &EditableTier, b: &EditableTier| a.zone == b.zone && a.label() == b.label();
    let old = &editor.tiers.tiers;
    let kept = old.iter().map(|t| TierChange {
        state: BeforeAfter::new(state_before(t), new.iter().find(|n| same(n, t)).and_then(state_after)),
        ..named(t)
    });
    let added = new.iter().filter(|n| !old.iter().any(|t| same(n, t)));
    let added = added.map(|t| TierChange { state: BeforeAfter::new(None, state_after(t)), ..named(t) });
    kept.chain(added).collect()
}

fn named(tier: &EditableTier) -> TierChange {
    TierChange {
        place: tier.place.clone(),
        name: tier.name.clone(),
        zone: tier.zone.name(),
        state: BeforeAfter::new(None, None),
        index_shift: 0.0,
        followed: false,
    }
}

/// Whether facets stand for each other, one by one.
fn has_same_facets(a: &Design, b: &Design) -> bool {
    let names = |d: &Design| d.facets().map(|f| f.name.clone()).collect::<Vec<_>>();
    names(a) == names(b)
}

/// A difference of indices, the short way around the wheel and without rounding.
fn nearest_turn(shift: f64, teeth: f64) -> f64 {
    let around = shift - (shift / teeth).round() * teeth;
    (around * 1e9).round() / 1e9
}

fn measures(before: &Polyhedron, after: &Polyhedron) -> Vec<MeasureChange> {
    let (was, is) = (proportions::measure(before), proportions::measure(after));
    let change = |proportion: &NamedProportion| MeasureChange {
        name: proportion.short,
        unit: proportion.unit,
        value: BeforeAfter::new((proportion.of)(&was), (proportion.of)(&is)),
    };
    PROPORTIONS.iter().map(change).collect()
}
