//! Writing a changed design back into its GemCad text file: angles, distances and indices that changed are
//! replaced word by word, and all else stays as it is.

use super::parser::parse;
use super::tier_line::{AscIndex, TierLine};
use crate::design::Gear;
use crate::formats::changed_design::{ChangedDesign, ChangedFacet, is_one_angle};
use crate::formats::cutting_table::{angle_as_stated, index_as_stated};
use crate::formats::error::FormatError;
use crate::formats::input::Input;
use crate::formats::numbers::decimals;
use crate::storage::text_patch::TextPatch;

/// Most bytes of a line that got longer, as GemCad breaks its own.
const WIDTH: usize = 79;

/// The bytes of the file with the changed design in it.
///
/// Facets of one tier that now differ in angle or distance become tiers of their own, in their order: the name
/// of the tier stands in each, and what follows the last index (the instructions) in the last.
pub fn rewrite(
    source: &Input,
    changed: &ChangedDesign,
    remarks: &mut Vec<String>,
) -> Result<Vec<u8>, FormatError> {
    let changed = &changed.with_origin_inside(remarks)?;
    let patch = TextPatch::new(source.bytes);
    let text = patch.text().to_owned();
    let file = parse(source, &text)?;
    let line_end = ["\r\n", "\n", "\r"].into_iter().find(|end| text.contains(end)).unwrap_or("\r\n");
    let mut page = Page { text: &text, line_end, patch, line: 0, growth: 0 };
    let facets = changed.facets();
    let mut rest = &facets[..];
    for tier in &file.tiers {
        let (of_tier, others) = rest.split_at(tier.indices.len().min(rest.len()));
        page.tier(tier, tier.gear.unwrap_or(changed.gear()), changed.gear(), of_tier);
        rest = others;
    }
    if let Some(index) = changed.refractive_index() {
        let index = decimals(index, 2);
        match (file.refractive_index_at, file.tiers.first()) {
            (Some(at), _) => page.patch.replace(at, index),
            (None, Some(tier)) => page.line_before(tier.start, &format!("I {index}")),
            (None, None) => {}
        }
    }
    Ok(page.patch.finish())
}

/// A facet's angle in degrees and distance, as its tier is to state them.
#[derive(Clone, Copy)]
struct Cut {
    angle_deg: f64,
    distance: f64,
}

impl Cut {
    /// Those of a facet, as the tier states them where these are meant.
    fn new(tier: &TierLine, facet: &ChangedFacet) -> Cut {
        let stated: Vec<f64> = facet.angle_before.into_iter().chain(facet.angle_stated).collect();
        let plane = facet.after.plane;
        let is_stated = facet.is_one_distance(plane.distance, tier.rho.abs());
        Cut {
            angle_deg: angle_as_stated(&stated, plane.normal),
            distance: if is_stated { tier.rho.abs() } else { plane.distance },
        }
    }

    /// The distance as written: for flat facets its sign tells table from culet.
    fn rho(self) -> f64 {
        let is_culet = self.angle_deg == 0.0 && self.angle_deg.is_sign_negative();
        if is_culet { -self.distance } else { self.distance }
    }
}

/// The file's text and its changes.
struct Page<'t, 'b> {
    text: &'t str,
    line_end: &'static str,
    patch: TextPatch<'b>,
    /// Where the line begins whose indices are written.
    line: usize,
    /// By how much it has grown.
    growth: usize,
}

impl Page<'_, '_> {
    /// - `own`: the wheel that the tier's indices count on
    /// - `gear`: the design's
    fn tier(&mut self, tier: &TierLine, own: Gear, gear: Gear, facets: &[ChangedFacet]) {
        let mut row: Option<Cut> = None;
        for (i, (index, facet)) in tier.indices.iter().zip(facets).enumerate() {
            let cut = Cut::new(tier, facet);
            let is_same = |row: &Cut| {
                is_one_angle(row.angle_deg, cut.angle_deg)
                    && facet.is_one_distance(row.distance, cut.distance)
            };
            let cut = match row.filter(is_same) {
                Some(row) => row,
                None if i == 0 => {
                    self.angle_and_distance(tier, cut, facet.angle_before);
                    cut
                }
                None => {
                    let ends = tier.indices[i..].iter().zip(&facets[i..]);
                    let alike = |(_, f): &(&AscIndex, &ChangedFacet)| {
                        let other = Cut::new(tier, f);
                        is_one_angle(other.angle_deg, cut.angle_deg)
                            && f.is_one_distance(other.distance, cut.distance)
                    };
                    let is_named = ends.take_while(alike).any(|(index, _)| !index.name.is_empty());
                    self.new_row(index, cut, if is_named { "" } else { &tier.name });
                    cut
                }
            };
            row = Some(cut);
            self.index(tier, index, own, gear, cut, facet);
        }
    }

    /// The angle and the distance where the tier begins, if they changed.
    fn angle_and_distance(&mut self, tier: &TierLine, cut: Cut, before: Option<f64>) {
        let keeps_angle = before.is_some_and(|a| a.to_bits() == cut.angle_deg.to_bits());
        if !keeps_angle {
            self.patch.replace(tier.angle_at.clone(), decimals(cut.angle_deg, 6));
        }
        let keeps_sign = keeps_angle || (cut.angle_deg != 0.0 && tier.angle_deg != 0.0);
        let rho = if keeps_sign { cut.distance.copysign(tier.rho) } else { cut.rho() };
        if rho != tier.rho {
            self.patch.replace(tier.rho_at.clone(), decimals(rho, 8));
        }
    }

    /// A tier of its own from this index on.
    fn new_row(&mut self, index: &AscIndex, cut: Cut, name: &str) {
        let Some(at) = index.at.clone() else { return };
        let begins = format!("{}a {} {} ", self.line_end, decimals(cut.angle_deg, 6), decimals(cut.rho(), 8));
        (self.line, self.growth) = (at.start, begins.len());
        self.patch.replace(self.text[..at.start].trim_end().len()..at.start, begins);
        if !name.is_empty() {
            self.patch.replace(at.end..at.end, format!(" n {name}"));
        }
    }

    /// The index, if another is meant; in a line of its own where it would make its line too long.
    fn index(
        &mut self,
        tier: &TierLine,
        index: &AscIndex,
        own: Gear,
        gear: Gear,
        cut: Cut,
        facet: &ChangedFacet,
    ) {
        let stated: Vec<f64> =
            [index.value].into_iter().chain(facet.after.index.filter(|_| own == gear)).collect();
        let wanted = index_as_stated(own, &stated, cut.angle_deg, facet.after.plane.normal);
        let is_missing = index.at.is_none() && cut.angle_deg != 0.0;
        if wanted == index.value && !is_missing {
            return;
        }
        let said = decimals(wanted, 0);
        let Some(at) = index.at.clone() else {
            return self.patch.replace(tier.rho_at.end..tier.rho_at.end, format!(" {said}"));
        };
        let line = self.text[..at.start].rfind(['\r', '\n']).map_or(0, |end| end + 1);
        if line > self.line {
            (self.line, self.growth) = (line, 0);
        }
        let growth = (self.growth + said.len()).saturating_sub(at.len());
        let is_first = self.text[line..at.start].trim().is_empty();
        if at.end - self.line + growth > WIDTH && said.len() > at.len() && !is_first && at.start > self.line {
            let gap = self.text[..at.start].trim_end().len()..at.start;
            self.patch.replace(gap, format!("{}  ", self.line_end));
            (self.line, self.growth) = (at.start, 2 + said.len() - at.len());
        } else {
            self.growth = growth;
        }
        self.patch.replace(at, said);
    }

    /// A line before the one that begins at a place, or words before that place if other words come first.
    fn line_before(&mut self, at: usize, words: &str) {
        let line = self.text[..at].rfind(['\r', '\n']).map_or(0, |end| end + 1);
        match self.text[line..at].trim().is_empty() {
            true => self.patch.replace(line..line, format!("{words}{}", self.line_end)),
            false => self.patch.replace(at..at, format!("{words} ")),
        }
    }
}
