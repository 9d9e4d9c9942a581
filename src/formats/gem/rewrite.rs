//! Writing a changed design back into its GemCad binary file: planes and polygons that changed are replaced,
//! and all else is copied.

use super::records::{ByteReader, RawFacet};
use super::tiers::{GroupedFacets, is_one_tier};
use crate::formats::changed_design::{ChangedDesign, ChangedFacet};
use crate::formats::changed_polygon::ChangedPolygons;
use crate::formats::cutting_table::angle_deg;
use crate::formats::error::FormatError;
use crate::formats::gem_write::point;
use crate::formats::input::Input;
use glam::DVec3;
use std::collections::BTreeSet;
use std::ops::Range;

/// The bytes of the file with the changed design in it.
///
/// Of a tier whose facets now differ in angle or distance, the first keep its key and the others get keys of
/// their own; names and instructions stay with their facets.
pub fn rewrite(
    source: &Input,
    changed: &ChangedDesign,
    remarks: &mut Vec<String>,
) -> Result<Vec<u8>, FormatError> {
    let changed = &changed.with_origin_inside(remarks)?;
    let raw = ByteReader::new(source).design()?;
    let grouped = GroupedFacets::new(&raw.facets, changed.gear());
    let polygons = ChangedPolygons::new(source.name, changed)?;
    let facets = changed.facets();
    let keys = keys(&grouped, &raw.facets, &facets);
    let mut edits: Vec<(Range<usize>, Vec<u8>)> = Vec::new();
    for (number, (&record, facet)) in grouped.records.iter().zip(&facets).enumerate() {
        let Some(raw) = raw.facets.get(record) else { continue };
        if facet.is_changed() {
            let plane = facet.after.plane;
            edits.push((raw.at..raw.at + 24, point(plane.normal / plane.distance).collect()));
        }
        if let Some(key) = keys.get(number).filter(|key| **key != raw.tier) {
            edits.push((raw.at + 24..raw.at + 28, key.to_le_bytes().to_vec()));
        }
        if let Some(new) = polygons.changed(number) {
            let corner = |c: &DVec3| 1i32.to_le_bytes().into_iter().chain(point(*c)).collect::<Vec<u8>>();
            let mut polygon: Vec<u8> = new.iter().flat_map(corner).collect();
            polygon.extend(0i32.to_le_bytes());
            edits.push((raw.polygon_at.clone(), polygon));
        }
    }
    match (changed.refractive_index(), raw.refractive_index_at) {
        (Some(index), Some(at)) => edits.push((at..at + 8, index.to_le_bytes().to_vec())),
        (Some(_), None) => remarks
            .push("the file ends before its index of refraction would stand: the new one is left out".into()),
        (None, _) => {}
    }
    edits.sort_by_key(|(part, _)| part.start);
    let (mut out, mut copied) = (Vec::with_capacity(source.bytes.len()), 0);
    for (part, new) in edits {
        out.extend(source.bytes.get(copied..part.start).unwrap_or_default());
        out.extend(new);
        copied = part.end;
    }
    out.extend(source.bytes.get(copied..).unwrap_or_default());
    Ok(out)
}

/// The key of each facet's tier, in the order of the design's facets. Files that give all facets one key keep it.
fn keys(grouped: &GroupedFacets, raw: &[RawFacet], facets: &[ChangedFacet]) -> Vec<i32> {
    let mut keys: Vec<i32> = grouped.records.iter().filter_map(|r| raw.get(*r)).map(|f| f.tier).collect();
    let used: BTreeSet<i32> = keys.iter().copied().collect();
    if used.len() < 2 && grouped.tiers.len() > 1 {
        return keys;
    }
    let mut last = used.last().copied().unwrap_or_default();
    let mut number = 0;
    for tier in &grouped.tiers {
        let mut parts: Vec<((f64, f64), i32)> = Vec::new();
        for _ in &tier.facets {
            let (Some(facet), Some(key)) = (facets.get(number), keys.get_mut(number)) else { return keys };
            let plane = facet.after.plane;
            let cut = (angle_deg(plane.normal), plane.distance);
            *key = match parts.iter().find(|(other, _)| is_one_tier(*other, cut)) {
                Some((_, key)) => *key,
                None => {
                    if !parts.is_empty() {
                        last = last.saturating_add(1);
                    }
                    let key = if parts.is_empty() { *key } else { last };
                    parts.push((cut, key));
                    key
                }
            };
            number += 1;
        }
    }
    keys
}
