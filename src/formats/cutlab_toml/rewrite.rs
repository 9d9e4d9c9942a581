//! Writing a changed design back into its design file: values that changed are replaced, and comments, rules and
//! parameters stay where they still hold.

use super::tier_place::{TierPlace, Written};
use crate::design::Design;
use crate::design::design_file::{DesignFile, DocumentError};
use crate::design::scaling::LENGTH_TO_WIDTH;
use crate::formats::changed_design::{ChangedDesign, size};
use crate::formats::error::FormatError;
use crate::formats::input::Input;
use crate::formats::numbers::decimals;
use crate::limits::Limits;
use crate::storage::text;
use crate::storage::text_patch::TextPatch;
use std::collections::BTreeMap;
use toml::de::DeTable;

/// Planes that rules give again agree with the changed ones to this, in parts of the stone's size: as corners are
/// found where facets meet.
pub const RULES_AGREE: f64 = 1e-9;

/// The bytes of the file with the changed design in it.
///
/// - A family gets the new parameters; other planes than these give cannot be held by it.
/// - A tier gets its new angle, and distance if it states one. A rule (`meets`, `width`, `table`) stays if it gives
///   the new planes (1e-9 of the stone's size), else the tier is written by distance.
/// - A tier whose facets came apart is written anew, as several.
///
/// Whatever does not fit is written anew without the file's comments, which is remarked.
pub fn rewrite(
    source: &Input,
    changed: &ChangedDesign,
    remarks: &mut Vec<String>,
) -> Result<Vec<u8>, FormatError> {
    let text = TextPatch::new(source.bytes).text().to_owned();
    let root = DeTable::parse(&text).ok();
    let file = root.as_ref().map(|root| File { source, text: &text, root: root.get_ref(), changed });
    if let Some((bytes, said)) = file.and_then(|file| file.rewritten()) {
        remarks.extend(said);
        return Ok(bytes);
    }
    remarks.push("the design file cannot hold this by its family or its rules: written anew as tiers".into());
    let about = DesignFile::parse(&text).map_or_else(|_| String::new(), |file| file.about);
    Ok(DesignFile { about, ..DesignFile::from_design(&changed.after) }.to_toml().into_bytes())
}

/// The file and what is to become of it.
struct File<'a> {
    source: &'a Input<'a>,
    text: &'a str,
    root: &'a DeTable<'a>,
    changed: &'a ChangedDesign<'a>,
}

impl File<'_> {
    /// The bytes, and what could not be kept; none if the file has no room for the change.
    fn rewritten(&self) -> Option<(Vec<u8>, Vec<String>)> {
        let mut remarks = Vec::new();
        if self.root.contains_key("expect") {
            remarks.push("the proportions under [expect] stay as they were".into());
        }
        let parameters = self.root.get("parameters").and_then(|p| p.get_ref().as_table());
        let scaled = parameters.is_some_and(|p| p.contains_key(LENGTH_TO_WIDTH));
        let moves = self.changed.facets().iter().any(|f| f.is_changed());
        if !moves || !self.changed.parameters.is_empty() {
            let bytes = self.patched(&[])?;
            let holds = self.design(&bytes, self.source.limits).is_ok_and(|d| self.first_off(&d).is_none());
            return holds.then_some((bytes, remarks));
        }
        if self.root.contains_key("family") || scaled {
            return None;
        }
        let mut places = TierPlace::all(self.text, self.root, self.changed)?;
        // each round writes one tier with less of its own form, until all planes are right
        loop {
            let bytes = self.patched(&places)?;
            let wrong = match self.design(&bytes, self.source.limits) {
                Ok(design) => match self.first_off(&design) {
                    None => {
                        remarks.extend(places.iter().filter_map(TierPlace::remark));
                        return Some((bytes, remarks));
                    }
                    Some(facet) => places.iter_mut().find(|p| p.facets.contains(&facet))?,
                },
                Err(DocumentError::Meet { number, .. } | DocumentError::Tier { number, .. }) => {
                    let mut before = 0;
                    places.iter_mut().find(|place| {
                        before += place.tables();
                        before >= number
                    })?
                }
                Err(_) => return None,
            };
            wrong.keep_less()?;
        }
    }

    /// The file's bytes with these tiers, the index of refraction and the parameters.
    fn patched(&self, places: &[TierPlace]) -> Option<Vec<u8>> {
        let mut patch = TextPatch::new(self.source.bytes);
        for place in places.iter().filter(|p| p.how != Written::AsBefore) {
            place.write(&mut patch)?;
        }
        if let Some(index) = self.changed.refractive_index() {
            let index = decimals(index, 1);
            match self.root.get("refractive-index") {
                Some(value) => patch.replace(value.span(), index),
                None => {
                    let first = self.root.keys().map(|k| k.span().start).min().unwrap_or(0);
                    let line = self.text[..first].rfind('\n').map_or(0, |end| end + 1);
                    patch.replace(line..line, format!("refractive-index = {index}\n"));
                }
            }
        }
        let table = self.root.get("parameters");
        let known = table.and_then(|t| t.get_ref().as_table());
        let mut new = String::new();
        for (key, value) in self.changed.parameters {
            let value = decimals(*value, 0);
            match known.and_then(|known| known.get(key.as_str())) {
                Some(old) => patch.replace(old.span(), value),
                None => new += &format!("\n{key} = {value}"),
            }
        }
        match table.map(|t| t.span().end) {
            _ if new.is_empty() => {}
            Some(header) => patch.replace(header..header, new),
            None => patch.replace(self.text.len()..self.text.len(), format!("\n[parameters]{new}\n")),
        }
        Some(patch.finish())
    }

    fn design(&self, bytes: &[u8], limits: Limits) -> Result<Design, DocumentError> {
        DesignFile::parse(&text::decode_lines(bytes))?.design_within(&BTreeMap::new(), limits)
    }

    /// The first facet whose plane is not the changed one.
    fn first_off(&self, design: &Design) -> Option<usize> {
        let near = RULES_AGREE * size(self.changed.before);
        let (found, wanted) = (design.planes(), self.changed.after.planes());
        if found.len() != wanted.len() {
            return Some(0);
        }
        found.iter().zip(&wanted).position(|(a, b)| {
            a.normal.distance(b.normal) > RULES_AGREE || (a.distance - b.distance).abs() > near
        })
    }
}
