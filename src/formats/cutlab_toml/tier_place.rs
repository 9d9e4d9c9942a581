//! A tier of a design file, and how it is written once its planes changed.

use crate::design::design_file::tiers_to_toml;
use crate::design::tiers::facet_normal;
use crate::design::{Facet, Gear, Tier};
use crate::formats::changed_design::{ChangedDesign, ChangedFacet, SAME, is_one_angle};
use crate::formats::cutting_table::{angle_as_stated, index_as_stated};
use crate::formats::numbers::decimals;
use crate::geometry::Plane;
use crate::storage::text_patch::TextPatch;
use std::ops::Range;
use toml::de::{DeArray, DeTable, DeValue};

/// How much of a tier stays as the file has it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Written {
    /// All of it.
    AsBefore,
    /// All but angle, distance, indices and explicit planes that changed.
    ByNumbers,
    /// As `ByNumbers`, by its distance instead of its rule.
    ByDistance,
    /// Nothing: its table is written anew.
    Anew,
}

impl Written {
    /// The next in which less stays.
    fn less_kept(self) -> Option<Written> {
        match self {
            Written::AsBefore => Some(Written::ByNumbers),
            Written::ByNumbers => Some(Written::ByDistance),
            Written::ByDistance => Some(Written::Anew),
            Written::Anew => None,
        }
    }
}

/// A tier's table, and the facets that it makes.
pub struct TierPlace<'a> {
    text: &'a str,
    table: &'a DeTable<'a>,
    /// From its header to its last value.
    part: Range<usize>,
    gear: Gear,
    before: Option<&'a Tier>,
    changed: Vec<ChangedFacet<'a>>,
    /// Numbers of its facets in the design; none for a guide.
    pub facets: Range<usize>,
    /// How it is written.
    pub how: Written,
}

impl<'a> TierPlace<'a> {
    /// All tiers of the file; none if it has another form than a design's.
    pub fn all(
        text: &'a str,
        root: &'a DeTable<'a>,
        changed: &'a ChangedDesign<'a>,
    ) -> Option<Vec<TierPlace<'a>>> {
        let mut tiers = changed.before.tiers.iter();
        let facets = changed.facets();
        let mut number = 0;
        let mut places = Vec::new();
        for entry in root.get("tier")?.get_ref().as_array()?.iter() {
            let table = entry.get_ref().as_table()?;
            let guide = table.get("guide").and_then(|v| v.get_ref().as_bool()).unwrap_or(false);
            let before = if guide { None } else { Some(tiers.next()?) };
            let range = number..number + before.map_or(0, |t| t.facets.len());
            number = range.end;
            let of_tier = facets.get(range.clone())?.to_vec();
            let moves = of_tier.iter().any(ChangedFacet::is_changed);
            places.push(TierPlace {
                text,
                table,
                part: entry.span().start..end_of(entry.get_ref(), entry.span().end),
                gear: changed.gear(),
                before,
                changed: of_tier,
                facets: range,
                how: if moves { Written::ByNumbers } else { Written::AsBefore },
            });
        }
        Some(places)
    }

    /// Lets less of it stay; none if that cannot be, as of a guide, which has no facets in the design.
    pub fn keep_less(&mut self) -> Option<()> {
        self.before?;
        self.how = self.how.less_kept()?;
        Some(())
    }

    /// What of the tier could not be kept.
    pub fn remark(&self) -> Option<String> {
        let name = self.before.map_or("", |t| &t.name);
        match self.how {
            _ if self.is_anew() => {
                Some(format!("tier '{name}' is written anew, without its rule and its comments"))
            }
            Written::ByDistance => {
                Some(format!("tier '{name}': its rule gives other planes; written by distance"))
            }
            _ => None,
        }
    }

    /// How many tables it is written as.
    pub fn tables(&self) -> usize {
        if self.is_anew() { parts(self.gear, self.before, &self.changed).len() } else { 1 }
    }

    /// Its facets by angle and index, and those by their planes.
    fn by_index_and_plane(&self) -> (&[ChangedFacet<'a>], &[ChangedFacet<'a>]) {
        let explicit = array(self.table, "facet").map_or(0, |facets| facets.iter().count());
        self.changed.split_at(self.changed.len().saturating_sub(explicit))
    }

    /// Whether its table is written anew: because that is asked for, or because it came apart, or because it has
    /// other indices and does not list them one by one.
    fn is_anew(&self) -> bool {
        let (by_index, _) = self.by_index_and_plane();
        let parts = parts(self.gear, self.before, by_index);
        let holds =
            |part: &Tier| part.facets.iter().zip(by_index).all(|(new, f)| new.index == f.before.index);
        let listed = array(self.table, "indices").map_or(0, |indices| indices.iter().count());
        match &parts[..] {
            [] => self.how == Written::Anew,
            [part] => self.how == Written::Anew || !(holds(part) || listed == by_index.len()),
            _ => true,
        }
    }

    /// Puts the tier into the file; none if it has no room there.
    pub fn write(&self, patch: &mut TextPatch) -> Option<()> {
        if self.is_anew() {
            let text = tiers_to_toml(&parts(self.gear, self.before, &self.changed), self.gear);
            patch.replace(self.part.clone(), text.trim_end());
            return Some(());
        }
        let (by_index, by_plane) = self.by_index_and_plane();
        if let Some(facet) = by_index.first() {
            let parts = parts(self.gear, self.before, by_index);
            let tier = parts.first()?;
            let angle = decimals(tier.angle_deg?, 1);
            self.set(patch, "angle", &angle);
            if self.how == Written::ByDistance && !self.table.contains_key("distance") {
                self.by_distance(patch, &angle, facet.after.plane.distance, by_index)?;
            } else if facet.is_moved() {
                self.set(patch, "distance", &decimals(facet.after.plane.distance, 1));
            }
            self.indices(patch, &tier.facets)?;
        }
        for (facet, entry) in
            by_plane.iter().zip(array(self.table, "facet").into_iter().flat_map(|f| f.iter()))
        {
            let table = entry.get_ref().as_table()?;
            let plane = facet.after.plane;
            if facet.is_turned() {
                let normal = array(table, "normal")?;
                for (value, new) in normal.iter().zip(plane.normal.to_array()) {
                    patch.replace(value.span(), decimals(new, 1));
                }
                if let (Some(index), Some(new)) = (table.get("index"), facet.after.index) {
                    patch.replace(index.span(), decimals(new, 1));
                }
            }
            if facet.is_moved() {
                patch.replace(table.get("distance")?.span(), decimals(plane.distance, 1));
            }
        }
        Some(())
    }

    /// Gives a key that the table has another number; one that is meant stays as it is written.
    fn set(&self, patch: &mut TextPatch, key: &str, value: &str) {
        let Some(old) = self.table.get(key) else { return };
        if number(self.text, &old.span()) != value.parse().ok() {
            patch.replace(old.span(), value);
        }
    }

    /// Puts the distance into the place of the rule.
    fn by_distance(
        &self,
        patch: &mut TextPatch,
        angle: &str,
        distance: f64,
        facets: &[ChangedFacet],
    ) -> Option<()> {
        let of_rule =
            |(key, value): (&'a toml::Spanned<toml::de::DeString<'a>>, &'a toml::Spanned<DeValue<'a>>)| {
                let is_rule = ["meets", "girdle", "width", "table"].contains(&&**key.get_ref());
                is_rule.then(|| key.span().start..value.span().end)
            };
        let mut rule: Vec<Range<usize>> = self.table.iter().filter_map(of_rule).collect();
        rule.sort_by_key(|part| part.start);
        let mut parts = rule.into_iter();
        let mut lines = format!("distance = {}", decimals(distance, 1));
        if !self.table.contains_key("angle") {
            lines = format!("angle = {angle}\n{lines}");
        }
        // without a rule facets have no names of their own
        let numbered = ["names", "repeat", "mirror"].iter().any(|key| self.table.contains_key(*key));
        if !numbered {
            let names: Vec<_> = facets.iter().map(|f| toml::Value::from(f.before.name.clone())).collect();
            lines += &format!("\nnames = {}", toml::Value::Array(names));
        }
        patch.replace(parts.next()?, lines);
        for part in parts {
            // the line too, if nothing else stands in it
            let rest = &self.text[part.end..];
            let line = rest.find('\n').map_or(rest.len(), |end| end + 1);
            let end = if rest[..line].trim().is_empty() { part.end + line } else { part.end };
            patch.replace(part.start..end, "");
        }
        Some(())
    }

    /// The indices that changed, where the file lists them one by one.
    fn indices(&self, patch: &mut TextPatch, facets: &[Facet]) -> Option<()> {
        let stated = array(self.table, "indices").into_iter().flat_map(|indices| indices.iter());
        for ((value, new), old) in stated.zip(facets).zip(&self.changed) {
            if new.index != old.before.index {
                patch.replace(value.span(), decimals(new.index?, 1));
            }
        }
        Some(())
    }
}

/// The facets of a tier as changed, in as many parts as it came apart into; the instructions stand in the last.
fn parts(gear: Gear, before: Option<&Tier>, facets: &[ChangedFacet]) -> Vec<Tier> {
    let Some(before) = before else { return Vec::new() };
    let mut parts: Vec<Tier> = Vec::new();
    for facet in facets {
        let stated: Vec<f64> = facet.angle_before.into_iter().chain(facet.angle_stated).collect();
        let plane = facet.after.plane;
        let angle = angle_as_stated(&stated, plane.normal);
        let same = |t: &&mut Tier| {
            let distance = t.facets.first().map_or(f64::NAN, |f| f.plane.distance);
            t.angle_deg.is_some_and(|a| is_one_angle(a, angle))
                && facet.is_one_distance(distance, plane.distance)
        };
        let start = |parts: &mut Vec<Tier>| {
            let (name, instructions) = (before.name.clone(), String::new());
            parts.push(Tier { name, angle_deg: Some(angle), instructions, facets: Vec::new() });
        };
        if parts.last_mut().filter(same).is_none() {
            start(&mut parts);
        }
        let Some(part) = parts.last_mut() else { continue };
        let angle = part.angle_deg.unwrap_or(angle);
        let indices: Vec<f64> = facet.before.index.into_iter().chain(facet.after.index).collect();
        let index = index_as_stated(gear, &indices, angle, plane.normal);
        let made = facet_normal(gear, angle, index);
        let normal = if made.distance(plane.normal) <= SAME { made } else { plane.normal };
        let distance = part.facets.first().map_or(plane.distance, |f| f.plane.distance);
        let plane = Plane { normal, distance };
        part.facets.push(Facet { name: facet.before.name.clone(), index: Some(index), plane });
    }
    if let Some(last) = parts.last_mut() {
        last.instructions.clone_from(&before.instructions);
    }
    parts
}

fn array<'t>(table: &'t DeTable<'t>, key: &str) -> Option<&'t DeArray<'t>> {
    table.get(key).and_then(|v| v.get_ref().as_array())
}

/// Where the last value of a table or array ends, or what is there ends itself.
fn end_of(value: &DeValue, own: usize) -> usize {
    match value {
        DeValue::Table(table) => {
            table.values().map(|v| end_of(v.get_ref(), v.span().end)).fold(own, usize::max)
        }
        DeValue::Array(array) => {
            array.iter().map(|v| end_of(v.get_ref(), v.span().end)).fold(own, usize::max)
        }
        _ => own,
    }
}

fn number(text: &str, at: &Range<usize>) -> Option<f64> {
    text.get(at.clone())?.replace('_', "").parse().ok()
}
